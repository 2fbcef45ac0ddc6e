#include "server/recording/recording.h"

#include <fcntl.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "idl/recording_format.h"
#include "server/config/config.h"
#include "server/process/version.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

/// A state is some 250 bytes, so that all states of 100,000 agents are below this; a length beyond
/// it is something else read as one.
constexpr std::uint64_t kEntryBytesMax = 64 << 20;

/// Of an entry, beside its inputs; and of each input in it: its tag and length.
constexpr std::uint64_t kEntryOverhead = 64;
constexpr std::uint64_t kInputOverhead = 8;

/// A varint of a length that may be: at most 7 bits each.
constexpr int kLengthBytesMax = 5;

}  // namespace

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
                                 const ClaimOptions& claim)
    : path_(path) {
  file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) throw std::runtime_error(path + ": cannot be written: " + CauseOf(errno));
  v1::RecordingEntry entry;
  entry.mutable_header()->set_format(wire::kRecordingFormat);
  entry.mutable_header()->set_version(Version());
  *entry.mutable_header()->mutable_config() = config;
  v1::ServiceClaim& claimed = *entry.mutable_header()->mutable_claim();
  claimed.set_instance(claim.instance);
  claimed.set_term_before(claim.term_before);
  claimed.set_wait_ns(claim.wait_ns);
  claimed.set_heard_for_ns(claim.heard_for_ns);
  claimed.set_stands_by(claim.stands_by);
  claimed.set_waking_ns(claim.waking_ns);
  for (const JournalledSimulator& simulator : claim.roster) {
    v1::RosterEntry& entry_of_roster = *claimed.add_roster();
    entry_of_roster.set_id(simulator.id);
    entry_of_roster.set_run(simulator.run);
    entry_of_roster.set_name(simulator.name);
    if (simulator.granted) entry_of_roster.set_granted_ns(simulator.granted->nanoseconds());
  }
  if (Write(entry)) return;
  close(file_);
  throw std::runtime_error(error_);
}

RecordingWriter::~RecordingWriter() { close(file_); }

bool RecordingWriter::Record(const v1::RecordedBatch& batch) {
  if (!error_.empty()) return false;
  const std::lock_guard lock(writing_);
  const std::uint64_t begin = offset_;
  if (WriteParts(batch)) return true;
  if (ftruncate(file_, static_cast<off_t>(begin)) != 0) {
    error_ += "; the file ends in the middle of a batch";
  }
  return false;
}

bool RecordingWriter::WriteParts(const v1::RecordedBatch& batch) {
  v1::RecordingEntry entry;
  std::uint64_t bytes = kEntryOverhead;
  const auto begin_part = [&] {
    v1::RecordedBatch& part = *entry.mutable_batch();
    part.Clear();
    part.set_wall_ns(batch.wall_ns());
    part.set_monotonic_ns(batch.monotonic_ns());
    part.set_wall_was_set(batch.wall_was_set());
    part.set_earliest_readers(batch.earliest_readers());
    bytes = kEntryOverhead;
  };
  begin_part();
  for (const v1::Input& input : batch.inputs()) {
    const std::uint64_t more = input.ByteSizeLong() + kInputOverhead;
    if (bytes + more > kEntryBytesMax && entry.batch().inputs_size() > 0) {
      entry.mutable_batch()->set_continued(true);
      if (!Write(entry)) return false;
      begin_part();
    }
    *entry.mutable_batch()->add_inputs() = input;
    bytes += more;
  }
  return Write(entry);
}

bool RecordingWriter::Write(const v1::RecordingEntry& entry) {
  const std::string where = path_ + ": byte " + std::to_string(offset_) + ": ";
  if (entry.ByteSizeLong() > kEntryBytesMax) {
    error_ = where + "an input of more than " + std::to_string(kEntryBytesMax) + " bytes";
    return false;
  }
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::util::SerializeDelimitedToZeroCopyStream(entry, &stream);
  }
  if (const int error_number = WriteAll(file_, bytes)) {
    error_ = where + "cannot be written: " + CauseOf(error_number);
    return false;
  }
  offset_ += bytes.size();
  return true;
}

RecordingReader::RecordingReader(const std::string& path)
    : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw std::runtime_error(path + ": cannot be read: " + CauseOf(errno));
  v1::RecordingEntry entry;
  if (!ReadEntry(&entry)) {
    throw std::runtime_error(error_.empty() ? path + ": byte 0: empty, not a recording" : error_);
  }
  if (!entry.has_header())
    throw std::runtime_error(path + ": byte 0: not a recording: it has no header");
  if (const std::string refusal = wire::RefusalOfFormat(entry.header()); !refusal.empty()) {
    throw std::runtime_error(path + ": byte 0: " + refusal);
  }
  if (!entry.header().has_config()) {
    throw std::runtime_error(path + ": byte 0: the configuration is missing");
  }
  // A field that an older version did not know has its default, but for the builder that it had. A
  // method that is no longer there (FACE_SWEEP) changed the cost only.
  config_ = std::move(*entry.mutable_header()->mutable_config());
  if (!v1::Config::BroadPhase_IsValid(config_.broad_phase())) config_.clear_broad_phase();
  if (!config_.has_tree_builder()) config_.set_tree_builder(v1::Config::OCTREE);
  config_ = CompleteConfig(std::move(config_));
  if (!entry.header().has_claim()) return;
  const v1::ServiceClaim& claimed = entry.header().claim();
  claim_ = {.instance = claimed.instance(),
            .term_before = claimed.term_before(),
            .wait_ns = claimed.wait_ns(),
            .heard_for_ns = claimed.heard_for_ns(),
            .stands_by = claimed.stands_by(),
            .waking_ns = claimed.waking_ns(),
            .roster = {}};
  for (const v1::RosterEntry& of_roster : claimed.roster()) {
    JournalledSimulator& simulator = claim_.roster.emplace_back();
    simulator.id = of_roster.id();
    simulator.run = of_roster.run();
    simulator.name = of_roster.name();
    if (of_roster.has_granted_ns()) {
      simulator.granted = Instant::FromNanoseconds(of_roster.granted_ns());
    }
  }
}

std::optional<v1::RecordedBatch> RecordingReader::Next() {
  std::optional<v1::RecordedBatch> batch = NextPart();
  while (batch && batch->continued()) {
    std::optional<v1::RecordedBatch> part = NextPart();
    if (!part) {
      if (error_.empty()) Fail("cut off");
      return {};
    }
    for (v1::Input& input : *part->mutable_inputs()) *batch->add_inputs() = std::move(input);
    batch->set_continued(part->continued());
  }
  return batch;
}

std::optional<v1::RecordedBatch> RecordingReader::NextPart() {
  v1::RecordingEntry entry;
  const std::uint64_t begin = offset_;
  if (!error_.empty() || !ReadEntry(&entry)) return {};
  if (!entry.has_batch()) {
    offset_ = begin;
    Fail("damaged: not a batch");
    return {};
  }
  return std::move(*entry.mutable_batch());
}

bool RecordingReader::ReadEntry(v1::RecordingEntry* entry) {
  std::uint64_t length = 0;
  if (file_.peek() == std::ifstream::traits_type::eof() && !file_.bad()) return false;
  if (!ReadLength(&length)) return false;
  std::string bytes(length, '\0');
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(length))) return Fail("cut off");
  const google::protobuf::LogSilencer silent;  // the error below reports it
  if (!entry->ParseFromString(bytes)) {
    return Fail(offset_ == 0 ? "not a recording" : "damaged: not a recording entry");
  }
  offset_ = static_cast<std::uint64_t>(file_.tellg());
  return true;
}

bool RecordingReader::ReadLength(std::uint64_t* length) {
  for (int i = 0; i < kLengthBytesMax; ++i) {
    const int byte = file_.get();
    if (byte == std::ifstream::traits_type::eof()) return Fail("cut off");
    *length |= static_cast<std::uint64_t>(byte & 0x7f) << (7 * i);
    if ((byte & 0x80) == 0) {
      return *length <= kEntryBytesMax ||
             Fail("damaged: an entry of " + std::to_string(*length) + " bytes");
    }
  }
  return Fail("damaged: not a valid entry length");
}

bool RecordingReader::Fail(const std::string& what) {
  error_ = path_ + ": byte " + std::to_string(offset_) + ": " + what;
  return false;
}

}  // namespace collision::server
