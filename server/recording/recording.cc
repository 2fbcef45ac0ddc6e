#include "server/recording/recording.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "idl/recording_format.h"
#include "server/config/config.h"
#include "server/process/write_all.h"
#include "server/recording/recorded_claim.h"

namespace collision::server {
namespace {

/// Of an entry, beside its inputs; and of each input in it: its tag and length.
constexpr std::uint64_t kEntryOverhead = 128;
constexpr std::uint64_t kInputOverhead = 8;

}  // namespace

void CopyTimes(const v1::RecordedBatch& from, v1::RecordedBatch* to) {
  to->set_wall_ns(from.wall_ns());
  to->set_monotonic_ns(from.monotonic_ns());
  to->set_wall_was_set(from.wall_was_set());
  to->set_earliest_readers(from.earliest_readers());
  to->set_opening(from.opening());
  if (from.has_granted_ns()) to->set_granted_ns(from.granted_ns());
}

bool WriteInParts(const v1::RecordedBatch& batch,
                  const std::function<bool(const v1::RecordingEntry&)>& write) {
  v1::RecordingEntry entry;
  std::uint64_t bytes = kEntryOverhead;
  const auto begin_part = [&] {
    v1::RecordedBatch& part = *entry.mutable_batch();
    part.Clear();
    CopyTimes(batch, &part);
    bytes = kEntryOverhead;
  };
  begin_part();
  for (const v1::Input& input : batch.inputs()) {
    const std::uint64_t more = input.ByteSizeLong() + kInputOverhead;
    if (bytes + more > wire::kEntryBytesMax && entry.batch().inputs_size() > 0) {
      entry.mutable_batch()->set_continued(true);
      if (!write(entry)) return false;
      begin_part();
    }
    *entry.mutable_batch()->add_inputs() = input;
    bytes += more;
  }
  return write(entry);
}

void KeepFormerRecordings(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::is_empty(file, error)) {
    return;
  }
  const auto former = [&file](int number) {
    return number == 0 ? file : file + "." + std::to_string(number);
  };
  for (int number = kFormerRecordingsMax; number > 0; --number) {
    if (!std::filesystem::exists(former(number - 1), error)) continue;
    std::filesystem::rename(former(number - 1), former(number), error);
    if (error) {
      throw std::runtime_error(former(number) + ": cannot be written: " + error.message());
    }
  }
}

RecordingWriter::RecordingWriter(const std::string& path, const v1::Config& config,
                                 const ClaimOptions& claim, const std::string& name)
    : path_(name.empty() ? path : name) {
  file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) throw std::runtime_error(path_ + ": cannot be written: " + CauseOf(errno));
  if (Write(HeaderOf(config, claim, 0))) return;
  close(file_);
  throw std::runtime_error(error_);
}

RecordingWriter::~RecordingWriter() { close(file_); }

bool RecordingWriter::Record(const v1::RecordedBatch& batch) {
  if (!error_.empty()) return false;
  const std::lock_guard lock(writing_);
  const std::uint64_t begin = offset_;
  const auto write = [this](const v1::RecordingEntry& entry) { return Write(entry); };
  if (WriteInParts(batch, write)) return true;
  if (ftruncate(file_, static_cast<off_t>(begin)) != 0) {
    error_ += "; the file ends in the middle of a batch";
  }
  return false;
}

bool RecordingWriter::Write(const v1::RecordingEntry& entry) {
  const std::string where = path_ + ": byte " + std::to_string(offset_) + ": ";
  if (entry.ByteSizeLong() + kEntryOverhead > wire::kEntryBytesMax) {
    error_ = where + "an input of more than " + std::to_string(wire::kEntryBytesMax) + " bytes";
    return false;
  }
  std::string bytes;
  wire::AppendEntry(entry, &bytes);
  if (const int error_number = WriteAll(file_, bytes)) {
    error_ = where + "cannot be written: " + CauseOf(error_number);
    return false;
  }
  offset_ += bytes.size();
  return true;
}

RecordingReader::RecordingReader(const std::string& path) : entries_(path) {
  v1::RecordingEntry entry;
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(path + ": byte 0: " + what);
  };
  if (!entries_.Next(&entry)) {
    if (!entries_.error().empty()) throw std::runtime_error(entries_.error());
    refuse("empty, not a recording");
  }
  if (!entry.has_header()) refuse("not a recording: it has no header");
  v1::RecordingHeader& header = *entry.mutable_header();
  if (const std::string refusal = wire::RefusalOfFormat(header); !refusal.empty()) refuse(refusal);
  if (!header.has_config()) refuse("the configuration is missing");
  // A field that an older version did not know has its default, but for the builder that it had. A
  // method that is no longer there (FACE_SWEEP) changed the cost only.
  config_ = std::move(*header.mutable_config());
  if (!v1::Config::BroadPhase_IsValid(config_.broad_phase())) config_.clear_broad_phase();
  if (!config_.has_tree_builder()) config_.set_tree_builder(v1::Config::OCTREE);
  config_ = CompleteConfig(std::move(config_));
  if (header.has_claim()) claim_ = FromMessage(header.claim());
  segment_ = header.segment();
}

std::optional<v1::RecordedBatch> RecordingReader::Next() {
  std::optional<v1::RecordedBatch> batch = NextPart();
  while (batch && batch->continued()) {
    std::optional<v1::RecordedBatch> part = NextPart();
    if (!part) {
      if (error().empty()) error_ = EndsAt("cut off");
      return {};
    }
    for (v1::Input& input : *part->mutable_inputs()) *batch->add_inputs() = std::move(input);
    batch->set_continued(part->continued());
  }
  return batch;
}

std::optional<v1::RecordedBatch> RecordingReader::NextPart() {
  v1::RecordingEntry entry;
  if (end_ || !error().empty() || !entries_.Next(&entry)) return {};
  if (entry.has_end()) {
    end_ = entry.end();
    return {};
  }
  if (entry.has_batch()) return std::move(*entry.mutable_batch());
  entries_.Refuse("damaged: not a batch");
  return {};
}

std::string RecordingReader::EndsAt(const std::string& what) const {
  return entries_.path() + ": byte " + std::to_string(entries_.offset()) + ": " + what;
}

}  // namespace collision::server
