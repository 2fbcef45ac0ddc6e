// The flight recorder: every step of the service, kept in segments, without holding up any.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "idl/config.pb.h"
#include "idl/recording.pb.h"
#include "server/recording/newest_inputs.h"
#include "server/recording/segments.h"

namespace collision::server {

/// How long the end of the service waits for the disk; what is not written then is lost.
inline constexpr std::chrono::seconds kFlightEndPatience{2};

/// Takes the batch of each step, and never fails.
class FlightSink {
 public:
  virtual ~FlightSink() = default;

  /// Before the batch is applied; nobody changes it any more. `opening`: what the service knows
  /// before it, if that was wanted and can be said.
  virtual void Take(std::shared_ptr<const v1::RecordedBatch> batch,
                    std::optional<Opening> opening) = 0;

  /// A new segment is due: the next Take() should bring an Opening.
  virtual bool wants_opening() const = 0;

  /// The next Take() should bring an Opening that says what the service has; it begins no segment.
  virtual bool wants_census() const = 0;

  /// Why nothing is recorded at the moment, in one line; empty: it is.
  virtual std::string failure() const = 0;

  /// Waits until all that was taken is written, at most kFlightEndPatience. Any thread.
  virtual void WaitUntilWritten() {}
};

/// Hands the batches to a thread that writes them (Segments). The step shares its batch with that
/// thread and copies nothing; it waits for no disk, for no longer than it takes to put a pointer
/// into a queue. If the disk is so slow that the queue is full, batches are left out, the steps
/// themselves note what of them is newest (which costs them what a recording costs), and the next
/// segment begins when there is room. A crash of the service loses what is queued, mostly the last
/// milliseconds. Take() is for one thread, the rest for any.
class FlightRecorder final : public FlightSink {
 public:
  FlightRecorder(const RollingPlace& place, SegmentLimits limits, const v1::Config& config,
                 const ClaimOptions& claim, std::int64_t wall_ns);
  /// Waits until all is written, at most kFlightEndPatience.
  ~FlightRecorder() override;

  /// How much is kept from now on, and when a segment is full; not how much may wait. Any thread.
  void SetLimits(RollingLimits all, SegmentLimits segment);

  /// Begins to write what it has taken so far; before that no file is touched. Waits until a file
  /// is there or cannot be made, at most kFlightEndPatience. Any thread.
  void Start();
  FlightRecorder(const FlightRecorder&) = delete;
  FlightRecorder& operator=(const FlightRecorder&) = delete;

  void Take(std::shared_ptr<const v1::RecordedBatch> batch,
            std::optional<Opening> opening) override;
  bool wants_opening() const override;
  bool wants_census() const override;
  std::string failure() const override;
  void WaitUntilWritten() override;

 private:
  struct Shared;
  static void Write(const std::shared_ptr<Shared>& shared);
  static void GiveUp(const std::string& cause, Shared* shared);

  /// With the thread, which a disk that hangs keeps beyond the end of this.
  const std::shared_ptr<Shared> shared_;
};

}  // namespace collision::server
