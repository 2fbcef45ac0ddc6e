// The files of the flight recorder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "idl/recording.pb.h"
#include "server/recording/newest_inputs.h"
#include "server/recording/rolling_files.h"

namespace collision::server {

struct SegmentLimits {
  std::uint64_t bytes = 0;  ///< Of a segment, at most; the batch that passes it is its last.
  std::int64_t age_ns = 0;  ///< Likewise, of monotonic time.
  std::int64_t retry_ns = 60'000'000'000;  ///< After a failure, until the next attempt.
  std::uint64_t queue_bytes = 64 << 20;    ///< Of batches that wait for the disk, about.
};

/// Writes a recording in **segments**. A segment is a recording of its own: its header holds the
/// complete configuration and what the service knew that no input says (Opening), its first batches
/// the newest input of every key, marked `opening`, and then come the batches of the steps. So a
/// replay can begin with any segment, and one that comes from the segment before skips the opening.
/// The first segment of a process has none: it begins where the service does.
///
/// A segment that is full asks for an Opening (wants_opening()); the batch that brings one is the
/// first of the next segment. Where newest inputs want a census, an Opening without a new segment
/// is one. Where the service can give none, since another one serves, the segment ends at twice its
/// size, and recording goes on when it serves. The last entry of a segment says whether the next
/// one follows without a gap; a process that was killed writes none.
///
/// A failure, as of a full disk of which nothing is ours to remove, ends the segment; failure()
/// says why, and after `retry_ns` an Opening is asked for to begin another one. Meanwhile the
/// newest inputs are kept in memory. Throws nothing. One thread.
class Segments {
 public:
  /// Begins the first segment. `config` is complete.
  Segments(RollingPlace place, SegmentLimits limits, const v1::Config& config,
           const ClaimOptions& claim, std::int64_t wall_ns);

  /// Takes the batch of a step; written with Flush(). `opening`: as the service was before it.
  void Take(const v1::RecordedBatch& batch, const std::optional<Opening>& opening);

  /// Batches that were not kept had these newest inputs. Ends the segment.
  void Miss(NewestInputs* newest);

  /// How much is kept from now on, and when a segment is full.
  void SetLimits(RollingLimits all, SegmentLimits segment);

  /// Hands what was taken to the operating system.
  void Flush();

  /// The service ends.
  void End();

  bool wants_opening() const { return wants_opening_; }
  bool wants_census() const { return newest_.wants_census(); }

  /// One line with path and cause, while nothing is recorded for that reason; else empty.
  const std::string& failure() const { return failure_; }

  const NewestInputs& newest() const { return newest_; }

 private:
  void Begin(const v1::RecordedBatch& batch, const Opening& opening);
  void TellWhatIsLeftOut();
  void AppendOpening(const v1::RecordedBatch& times, const Opening& opening);
  void AppendBatch(const v1::RecordedBatch& times, const std::string& inputs);
  void Append(const v1::RecordingEntry& entry);
  void Close(bool continues);
  void Fail();

  RollingFiles files_;
  SegmentLimits limits_;
  const v1::Config config_;
  NewestInputs newest_;
  std::string unwritten_;
  std::uint32_t number_ = 1;
  std::uint64_t left_out_told_ = 0;
  std::int64_t wall_ns_ = 0, monotonic_ns_ = 0;  ///< Of the newest batch.
  std::int64_t began_ns_ = 0;                    ///< Monotonic.
  std::int64_t retry_ns_ = 0;                    ///< Likewise: when to try again.
  bool wants_opening_ = false;
  std::string failure_;
};

}  // namespace collision::server
