// What time it is in a world with a wall clock, whatever happens to that clock.
#pragma once

#include <cstdint>
#include <optional>

#include "collision_core/base/instant.h"
#include "server/bus/clock.h"

namespace collision::server {

/// Most that a clock may be slewed, by NTP or PTP: 500 ppm, the limit of the kernel.
inline constexpr std::int64_t kSlewPerSecondNs = 500'000;

/// The two clocks of a reading are read one after the other; they lie at most so far apart unless
/// the machine is so busy that every attempt was interrupted (SystemClock).
inline constexpr std::int64_t kReadingErrorNs = 100'000;

/// After a clock was set back by less than this, messages of the former time may still be on their
/// way when the new time reaches their stamps.
inline constexpr std::int64_t kInFlightNs = 1'000'000'000;

/// The wall clock was set.
struct ClockStep {
  std::int64_t by_ns = 0;  ///< > 0: forward.
  Instant to;              ///< What the clock shows after it.
  /// It is larger than the bound on skew: nothing that was told before counts any more.
  bool breaks = false;
};

/// Follows the wall clock. One thread; knows no clock itself.
///
/// Between two readings the wall clock and a steady clock that goes on while the machine sleeps
/// advance by the same time, but for slewing. So a suspended machine is no step, and a difference
/// of more than kSlewPerSecondNs of the time between them + kReadingErrorNs is one. (If the system
/// says that the clock was set, kReadingErrorNs alone is allowed.) Slewing is followed quietly.
///
/// A step of at most κ (`skew_max_s`) is followed, too: states are believed to be off by κ, so
/// those stamped before it hold. `now` never goes back; after a step back it stands still until the
/// clock has caught up, for κ at the longest.
///
/// A step of more than κ, in either direction, *breaks* the time: simulators of the same machine
/// have stepped, too, and the states of before and after it do not lie on one time scale. Such a
/// step needs a new epoch of the world, and `now` stands until Restart().
class WallTime {
 public:
  explicit WallTime(std::int64_t skew_max_ns) : skew_max_ns_(skew_max_ns) {}

  /// Takes in the clocks of this step. Returns the step of the clock, if there was one since the
  /// last reading.
  std::optional<ClockStep> Take(const ClockReading& reading);

  /// Begins the new epoch after a step that breaks: now is what the clock shows.
  void Restart();

  Instant now() const { return now_; }
  /// What the clock shows; earlier than now after a step back.
  Instant reading() const { return Instant::FromNanoseconds(wall_ns_); }

  /// A sender that echoes a `now` of this epoch which is later than this one has heard it since the
  /// last step.
  Instant echoes_after() const { return echoes_after_; }

  /// No state of this epoch is stamped earlier: it would be of the time before the step. Always()
  /// in the first epoch.
  Instant earliest_stamp() const { return earliest_stamp_; }

 private:
  const std::int64_t skew_max_ns_;
  bool started_ = false;
  std::int64_t wall_ns_ = 0;
  std::int64_t monotonic_ns_ = 0;
  Instant now_;
  Instant echoes_after_ = Instant::Always();
  Instant earliest_stamp_ = Instant::Always();
  std::optional<ClockStep> broken_;  ///< The step that waits for Restart(); the sum of several.
};

}  // namespace collision::server
