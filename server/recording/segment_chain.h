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

/// Begins with the segment that contains `from_ns`, with its opening, and goes on with those behind
/// it, as long as each follows the one before without a gap, in the same start of the service. One
/// thread.
class SegmentChain final : public BatchSource {
 public:
  /// `path`: a recording or a segment, which is read alone; or a folder of segments, or one that
  /// holds such a folder (state_dir). Throws std::runtime_error with path and cause.
  SegmentChain(const std::string& path, const ReplayRange& range);

  /// Of the first segment.
  const v1::Config& config() const { return reader_->config(); }
  const ClaimOptions& claim() const { return reader_->claim(); }

  /// The file that it reads now.
  const std::string& path() const { return files_[at_]; }

  std::optional<v1::RecordedBatch> Next() override;

  /// Why the last batch of a file was not its end; empty: it was.
  const std::string& error() const { return reader_->error(); }

  /// After the last batch: begins anew with the next segment of the folder, which does not go on
  /// where this one ends: the service was started again, or a segment is missing or damaged. Those
  /// that cannot be opened are passed over, and told to `skipped`. False: there is none before
  /// `until_ns`.
  bool NextRun(const std::function<void(const std::string& cause)>& skipped);

 private:
  bool GoOn();

  const ReplayRange range_;
  std::vector<std::string> files_;
  std::vector<std::int64_t> begins_ns_;  ///< Of each; empty: it is one file.
  std::size_t at_ = 0;
  std::unique_ptr<RecordingReader> reader_;
  bool skips_opening_ = false;
};

}  // namespace collision::server
