#include "server/world/wall_clock/wall_time.h"

#include <algorithm>
#include <cstdlib>

#include "collision_core/numeric/seconds.h"

namespace collision::server {
namespace {

/// What slewing and two readings explain.
std::int64_t Explained(std::int64_t elapsed_ns, bool wall_was_set) {
  if (wall_was_set) return kReadingErrorNs;
  const std::int64_t per_slew = numeric::kNanosecondsPerSecond / kSlewPerSecondNs;
  return kReadingErrorNs + std::max<std::int64_t>(elapsed_ns, 0) / per_slew;
}

}  // namespace

std::optional<ClockStep> WallTime::Take(const ClockReading& reading) {
  const std::int64_t elapsed_ns = reading.monotonic_ns - monotonic_ns_;
  const std::int64_t by_ns = (reading.wall_ns - wall_ns_) - elapsed_ns;
  const Instant before = now_;
  wall_ns_ = reading.wall_ns;
  monotonic_ns_ = reading.monotonic_ns;
  if (!started_) {
    started_ = true;
    now_ = this->reading();
    return std::nullopt;
  }
  const bool stepped = std::abs(by_ns) > Explained(elapsed_ns, reading.wall_was_set);
  if (!stepped) {
    if (!broken_) now_ = std::max(now_, this->reading());
    return std::nullopt;
  }
  const ClockStep step{.by_ns = by_ns,
                       .to = this->reading(),
                       .breaks = broken_.has_value() || std::abs(by_ns) > skew_max_ns_};
  if (step.breaks) {
    if (broken_) broken_->by_ns += by_ns;
    if (!broken_) broken_ = step;
  } else {
    echoes_after_ = before;
    now_ = std::max(now_, this->reading());
  }
  return step;
}

void WallTime::Restart() {
  const std::int64_t by_ns = broken_ ? broken_->by_ns : 0;
  const bool just_back = by_ns < 0 && by_ns >= -kInFlightNs;
  // Stamps of the former time reach up to its end, which is the last `now`, + κ.
  const std::int64_t earliest_ns =
      just_back ? now_.nanoseconds() + skew_max_ns_ : wall_ns_ - skew_max_ns_;
  earliest_stamp_ = Instant::FromNanoseconds(earliest_ns);
  now_ = reading();
  // Samples of the new epoch are told from those of the former one by its number.
  echoes_after_ = Instant::Always();
  broken_.reset();
}

}  // namespace collision::server
