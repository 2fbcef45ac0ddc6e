#include "server/recording/replay/segment_chain.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "idl/recording/kept_files.h"
#include "idl/recording/utc.h"

namespace collision::server {
namespace {

/// The segments of a folder. Throws std::runtime_error if there are none, or of several worlds.
std::vector<wire::KeptFile> SegmentsIn(const std::string& folder) {
  std::vector<wire::KeptFile> files = wire::KeptFilesIn(folder, wire::kRecordingSuffix);
  if (files.empty()) {
    files = wire::KeptFilesIn(folder + "/" + wire::kRecordingsFolder, wire::kRecordingSuffix);
  }
  for (const std::string& listed : {folder, folder + "/" + wire::kRecordingsFolder}) {
    const std::string failure = wire::ListingFailure(listed);
    if (files.empty() && !failure.empty()) throw std::runtime_error(listed + ": " + failure);
  }
  if (files.empty()) {
    throw std::runtime_error(folder + ": no recording is in it (WORLD.DOMAIN.TIME" +
                             wire::kRecordingSuffix + ")");
  }
  std::set<std::string> places;
  for (const wire::KeptFile& file : files) places.insert(file.place());
  if (places.size() > 1) {
    throw std::runtime_error(folder + ": recordings of several worlds are in it (" +
                             *places.begin() + ", " + *places.rbegin() + "); name a segment");
  }
  return files;
}

/// The wall time of its last batch.
std::int64_t EndOf(const std::string& path) {
  std::int64_t end_ns = std::numeric_limits<std::int64_t>::min();
  RecordingReader reader(path);
  while (const auto batch = reader.Next()) end_ns = batch->wall_ns();
  return end_ns;
}

void RequireFrom(const std::string& path, const ReplayRange& range, std::int64_t begin_ns) {
  const auto require = [&](const char* option, std::optional<std::int64_t> time_ns) {
    if (!time_ns || *time_ns >= begin_ns) return;
    throw std::runtime_error(path + ": " + option + " " + wire::UtcText(*time_ns) +
                             " is before all that is recorded; allowed: from " +
                             wire::UtcText(begin_ns) + " on");
  };
  require("--from", range.from_ns);
  require("--until", range.until_ns);
}

[[noreturn]] void ThrowBehind(const std::string& path, std::int64_t from_ns) {
  throw std::runtime_error(path + ": --from " + wire::UtcText(from_ns) +
                           " is after the end of all that is recorded");
}

void RequireInFile(const std::string& path, const ReplayRange& range) {
  RecordingReader reader(path);
  const auto first = reader.Next();
  if (!first) return;
  RequireFrom(path, range, first->wall_ns());
  if (range.from_ns && EndOf(path) < *range.from_ns) ThrowBehind(path, *range.from_ns);
}

}  // namespace

SegmentChain::SegmentChain(const std::string& path, const ReplayRange& range) : range_(range) {
  std::error_code failed;
  if (!std::filesystem::is_directory(path, failed)) {
    segments_.push_back({.path = path});
    if (range.from_ns || range.until_ns) RequireInFile(path, range);
    return;
  }
  const std::vector<wire::KeptFile> files = SegmentsIn(path);
  RequireFrom(path, range, files.front().begin_ns);
  for (const wire::KeptFile& file : files) segments_.push_back(HeaderOf(file.path, file.begin_ns));
  SortByStart();
  if (!range.from_ns) return;
  next_ = FirstFrom(*range.from_ns);
  if (next_ == segments_.size()) ThrowBehind(path, *range.from_ns);
}

SegmentChain::Segment SegmentChain::HeaderOf(const std::string& path, std::int64_t begin_ns) {
  Segment segment{.path = path, .begin_ns = begin_ns};
  try {
    const RecordingReader reader(path);
    segment.start = reader.claim().instance;
    segment.number = reader.segment();
  } catch (const std::runtime_error&) {
    // NextRun() says why.
  }
  return segment;
}

/// One that cannot be opened stands for itself.
void SegmentChain::SortByStart() {
  std::map<std::uint64_t, std::int64_t> began;
  for (const Segment& one : segments_) {
    const auto known = began.try_emplace(one.start, one.begin_ns).first;
    known->second = std::min(known->second, one.begin_ns);
  }
  for (Segment& one : segments_)
    one.start_began_ns = one.number == 0 ? one.begin_ns : began.at(one.start);
  std::ranges::sort(segments_, {}, [](const Segment& one) {
    return std::tuple(one.start_began_ns, one.start, one.number, one.begin_ns);
  });
}

/// The first segment that goes on beyond the time.
std::size_t SegmentChain::FirstFrom(std::int64_t from_ns) const {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& one = segments_[i];
    if (one.number == 0 && one.begin_ns < from_ns) continue;
    if (one.begin_ns >= from_ns) return i;
    const bool is_last = i + 1 == segments_.size() || segments_[i + 1].start != one.start;
    if (is_last ? EndOf(one.path) >= from_ns : segments_[i + 1].begin_ns > from_ns) return i;
  }
  return segments_.size();
}

bool SegmentChain::NextRun(const std::function<void(const std::string& cause)>& skipped) {
  while (next_ < segments_.size()) {
    const Segment& one = segments_[next_++];
    if (range_.until_ns && one.begin_ns > *range_.until_ns) continue;
    try {
      is_first_run_ = reader_ == nullptr;
      reader_ = std::make_unique<RecordingReader>(one.path);
      skips_opening_ = false;
      return true;
    } catch (const std::runtime_error& error) {
      skipped(error.what());
    }
  }
  return false;
}

std::optional<v1::RecordedBatch> SegmentChain::Next() {
  for (;;) {
    std::optional<v1::RecordedBatch> batch = reader_->Next();
    if (!batch) {
      if (!GoOn()) return {};
      continue;
    }
    if (batch->opening() && skips_opening_) continue;
    if (range_.until_ns && batch->wall_ns() > *range_.until_ns) return {};
    return batch;
  }
}

/// Opens the next segment if it goes on where this one ends.
bool SegmentChain::GoOn() {
  if (!reader_->continues() || next_ == segments_.size()) return false;
  const Segment& next = segments_[next_];
  if (next.start != reader_->claim().instance || next.number != reader_->segment() + 1)
    return false;
  try {
    reader_ = std::make_unique<RecordingReader>(next.path);
  } catch (const std::runtime_error&) {
    return false;  // NextRun() says why
  }
  ++next_;
  skips_opening_ = true;
  return true;
}

}  // namespace collision::server
