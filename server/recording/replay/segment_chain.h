// Segments of the flight recorder, one after another, as one recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/recording/recording.h"

namespace collision::server {

/// What of the recordings is replayed.
struct ReplayRange {
  std::optional<std::int64_t> from_ns = {};   ///< Wall time; nullopt: from the first segment on.
  std::optional<std::int64_t> until_ns = {};  ///< Likewise; nullopt: to the end.
};

/// Reads runs one after the other. A run begins with a segment, with its opening, and goes on with
/// those that follow without a gap in the same start of the service. The first one begins with the
/// segment that contains `from_ns`. Which follows which, the headers say: names and times do not,
/// since a clock may be set, and a standby beside the service may write to the same folder. One
/// thread.
class SegmentChain final : public BatchSource {
 public:
  /// `path`: a recording or a segment, which is read alone; or a folder of segments, or one that
  /// holds such a folder (state_dir). Throws std::runtime_error with path and cause.
  SegmentChain(const std::string& path, const ReplayRange& range);

  /// Begins the next run, and before any other call the first one. Segments that cannot be opened
  /// are passed over, and told to `skipped`. False: there is none before `until_ns`.
  bool NextRun(const std::function<void(const std::string& cause)>& skipped);

  /// The run does not begin with a start of the service, though no `from_ns` asked for that.
  bool begins_behind_a_gap() const {
    return reader_->segment() > 1 && !(range_.from_ns && is_first_run_);
  }

  /// Of the first segment of the run.
  const v1::Config& config() const { return reader_->config(); }
  const ClaimOptions& claim() const { return reader_->claim(); }

  /// The file that it reads now.
  const std::string& path() const { return segments_[next_ - 1].path; }

  /// Nothing at the end of the run.
  std::optional<v1::RecordedBatch> Next() override;

  /// Why the last batch of a file was not its end; empty: it was.
  const std::string& error() const { return reader_->error(); }

 private:
  struct Segment {
    std::string path;
    std::int64_t begin_ns = 0;  ///< Wall time.
    std::uint64_t start = 0;    ///< Of the service: its instance.
    std::uint32_t number = 0;   ///< Within the start; 0: it cannot be opened.
    std::int64_t start_began_ns = 0;
  };

  static Segment HeaderOf(const std::string& path, std::int64_t begin_ns);
  void SortByStart();
  std::size_t FirstFrom(std::int64_t from_ns) const;
  bool GoOn();

  const ReplayRange range_;
  std::vector<Segment> segments_;  ///< Start after start, each in its order.
  std::size_t next_ = 0;           ///< Index of the segment behind the one that is read.
  std::unique_ptr<RecordingReader> reader_;
  bool skips_opening_ = false;
  bool is_first_run_ = false;
};

}  // namespace collision::server
