#include "server/recording/segment_chain.h"

#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

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

}  // namespace

SegmentChain::SegmentChain(const std::string& path, const ReplayRange& range) : range_(range) {
  std::error_code failed;
  if (!std::filesystem::is_directory(path, failed)) {
    files_ = {path};
  } else {
    const std::vector<wire::KeptFile> files = SegmentsIn(path);
    if (range.from_ns && *range.from_ns < files.front().begin_ns) {
      throw std::runtime_error(path + ": --from " + wire::UtcText(*range.from_ns) +
                               " is before all recordings; allowed: from " +
                               wire::UtcText(files.front().begin_ns) + " on");
    }
    for (const wire::KeptFile& file : files) {
      if (range.from_ns && file.begin_ns <= *range.from_ns) at_ = files_.size();
      files_.push_back(file.path);
      begins_ns_.push_back(file.begin_ns);
    }
  }
  reader_ = std::make_unique<RecordingReader>(files_[at_]);
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
  if (!reader_->continues() || at_ + 1 == files_.size()) return false;
  std::unique_ptr<RecordingReader> next;
  try {
    next = std::make_unique<RecordingReader>(files_[at_ + 1]);
  } catch (const std::runtime_error&) {
    return false;  // NextRun() says why
  }
  if (next->claim().instance != reader_->claim().instance) return false;
  if (next->segment() != reader_->segment() + 1) return false;
  ++at_;
  reader_ = std::move(next);
  skips_opening_ = true;
  return true;
}

bool SegmentChain::NextRun(const std::function<void(const std::string& cause)>& skipped) {
  while (at_ + 1 < begins_ns_.size()) {
    if (range_.until_ns && begins_ns_[at_ + 1] > *range_.until_ns) return false;
    ++at_;
    try {
      reader_ = std::make_unique<RecordingReader>(files_[at_]);
      skips_opening_ = false;
      return true;
    } catch (const std::runtime_error& error) {
      skipped(error.what());
    }
  }
  return false;
}

}  // namespace collision::server
