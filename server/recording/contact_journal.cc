#include "server/recording/contact_journal.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <optional>
#include <utility>

#include "idl/recording/entries.h"
#include "idl/recording_format.h"
#include "server/process/version.h"

namespace collision::server {
namespace {

/// The oldest file to go is not the only one.
constexpr int kFilesLeast = 8;
/// More than an entry has: what a kill has left of the last one is shorter.
constexpr std::uint64_t kTailMax = 1 << 16;
constexpr std::int64_t kRetryAfter = 60'000'000'000;  // [ns]

}  // namespace

std::uint64_t ContactJournal::FileBytesMax() const {
  return files_.place().limits.bytes_max / kFilesLeast;
}

void ContactJournal::Start(std::int64_t wall_ns) {
  has_started_ = true;
  std::optional<wire::KeptFile> newest;
  const RollingPlace& place = files_.place();
  for (const wire::KeptFile& file : wire::KeptFilesIn(place.folder, place.suffix)) {
    if (file.place() == place.world_and_domain) newest = file;
  }
  if (newest && newest->bytes < FileBytesMax()) GoOn(*newest);
  if (!files_.is_open() && !Begin(wall_ns)) Fail(wall_ns);
}

/// With a former file, without what a kill has left of its last entry.
void ContactJournal::GoOn(const wire::KeptFile& file) {
  if (wire::IsInUse(file.path)) return;  // of the service beside which this one stands by
  try {
    wire::EntryReader reader(file.path);
    v1::RecordingEntry entry;
    while (reader.Next(&entry)) {
    }
    if (reader.offset() == 0) return;
    const bool is_whole = reader.error().empty();
    const bool is_tail = reader.is_cut_off() && file.bytes - reader.offset() < kTailMax;
    if (!is_whole && !is_tail) {
      return spdlog::warn("{}; it stays as it is, and another one begins", reader.error());
    }
    if (!is_whole) spdlog::warn("{}; that is taken off", reader.error());
    static_cast<void>(files_.Continue(file, reader.offset()));
  } catch (const std::exception& failure) {
    spdlog::warn("{}", failure.what());
  }
}

bool ContactJournal::Begin(std::int64_t wall_ns) {
  files_.Close();
  v1::RecordingEntry entry;
  entry.mutable_header()->set_format(wire::kRecordingFormat);
  entry.mutable_header()->set_version(Version());
  std::string bytes;
  wire::AppendEntry(entry, &bytes);
  return files_.Begin(wall_ns) && files_.Append(bytes, wall_ns);
}

void ContactJournal::Add(const v1::CollisionEvent& contact) { told_.push_back(contact); }

void ContactJournal::Write(std::int64_t wall_ns) {
  if (told_.empty() || !has_started_) return;
  std::string bytes;
  for (v1::CollisionEvent& contact : std::exchange(told_, {})) {
    v1::RecordingEntry entry;
    entry.mutable_contact()->set_wall_ns(wall_ns);
    *entry.mutable_contact()->mutable_event() = std::move(contact);
    wire::AppendEntry(entry, &bytes);
  }
  // A clock that was set back waits for no time that it has had.
  const bool waits = !failure_.empty() && wall_ns < retry_ns_ && wall_ns >= retry_ns_ - kRetryAfter;
  if (waits) return;
  const bool begins = !files_.is_open() || files_.is_removed() || files_.bytes() >= FileBytesMax();
  if ((begins && !Begin(wall_ns)) || !files_.Append(bytes, wall_ns)) return Fail(wall_ns);
  if (!std::exchange(failure_, {}).empty()) {
    spdlog::info("{}: contacts are kept again", files_.path());
  }
}

void ContactJournal::Fail(std::int64_t wall_ns) {
  if (failure_.empty()) {
    spdlog::error("{}; contacts are not kept, which is tried again in a minute", files_.error());
  }
  failure_ = files_.error();
  files_.Close();
  retry_ns_ = wall_ns + kRetryAfter;
}

}  // namespace collision::server
