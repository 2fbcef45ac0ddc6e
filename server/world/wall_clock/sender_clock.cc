#include "server/world/wall_clock/sender_clock.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision_core/numeric/seconds.h"

namespace collision::server {
namespace {

constexpr double kMillisecondNs = 1e6;

/// How far a bound of this age has widened, rounded up.
std::int64_t Widened(std::int64_t age_ns) {
  constexpr std::int64_t kPerDrift = numeric::kNanosecondsPerSecond / kDriftPerSecondNs;
  return (std::max<std::int64_t>(age_ns, 0) + kPerDrift - 1) / kPerDrift;
}

std::int64_t Difference(Instant later, Instant earlier) {
  return later.nanoseconds() - earlier.nanoseconds();
}

}  // namespace

OffsetBracket ClockOffset::At(std::int64_t monotonic_ns) const {
  OffsetBracket offset = best_;
  if (offset.has_lower()) offset.lower_ns -= Widened(monotonic_ns - lower_at_ns_);
  if (offset.has_upper()) offset.upper_ns += Widened(monotonic_ns - upper_at_ns_);
  return offset;
}

void ClockOffset::Take(const RoundTrip& trip, std::int64_t monotonic_ns) {
  const OffsetBracket known = At(monotonic_ns);
  OffsetBracket told{.lower_ns = Difference(trip.answered, trip.arrived)};
  if (trip.asked) {
    // The upper end is of the moment at which the sender heard.
    told.upper_ns =
        Difference(trip.heard, *trip.asked) + Widened(Difference(trip.arrived, *trip.asked));
  }
  // The clock was set between the two instants of this trip: the later one counts.
  if (told.lower_ns > told.upper_ns) told.upper_ns = OffsetBracket::kNoUpper;
  const bool agrees = told.lower_ns <= known.upper_ns && known.lower_ns <= told.upper_ns;
  if (!agrees || told.lower_ns >= known.lower_ns) {
    best_.lower_ns = told.lower_ns;
    lower_at_ns_ = monotonic_ns;
  }
  if (!agrees || told.upper_ns <= known.upper_ns) {
    best_.upper_ns = told.upper_ns;
    upper_at_ns_ = monotonic_ns;
  }
}

SenderVerdict SenderClock::Take(const RoundTrip& trip, std::int64_t monotonic_ns,
                                std::int64_t skew_max_ns) {
  offset_.Take(trip, monotonic_ns);
  const OffsetBracket offset = offset_.At(monotonic_ns);
  if (trip.asked && offset.lower_ns >= -skew_max_ns && offset.upper_ns <= skew_max_ns) {
    within_until_ = std::max(within_until_, *trip.asked);
  }
  const bool behind = offset.upper_ns < -skew_max_ns;
  if (behind || offset.lower_ns > skew_max_ns) {
    behind_ = behind;
    return std::exchange(refused_, true) ? SenderVerdict::kUnchanged : SenderVerdict::kRefused;
  }
  if (!refused_ || !MayBeTaken(offset, skew_max_ns)) return SenderVerdict::kUnchanged;
  refused_ = false;
  return SenderVerdict::kTaken;
}

/// What is not known does not excuse the side on which it was refused.
bool SenderClock::MayBeTaken(const OffsetBracket& offset, std::int64_t skew_max_ns) const {
  const auto within = static_cast<std::int64_t>(kTakenWithin * static_cast<double>(skew_max_ns));
  if (behind_ && !offset.has_upper()) return false;
  return offset.lower_ns <= within && offset.upper_ns >= -within;
}

std::string OffsetText(const OffsetBracket& offset) {
  const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) / kMillisecondNs; };
  if (!offset.has_lower() && !offset.has_upper()) return "not known";
  if (!offset.has_upper() && offset.lower_ns > 0) {
    return fmt::format("at least {:.3f} ms ahead", ms(offset.lower_ns));
  }
  if (!offset.has_upper()) return fmt::format("at most {:.3f} ms behind", -ms(offset.lower_ns));
  if (offset.lower_ns > 0) {
    return fmt::format("{:.3f} to {:.3f} ms ahead", ms(offset.lower_ns), ms(offset.upper_ns));
  }
  if (offset.upper_ns < 0) {
    return fmt::format("{:.3f} to {:.3f} ms behind", -ms(offset.upper_ns), -ms(offset.lower_ns));
  }
  return fmt::format("{:.3f} ms behind to {:.3f} ms ahead", -ms(offset.lower_ns),
                     ms(offset.upper_ns));
}

double SufficientSkew(const OffsetBracket& offset) {
  double greatest_ns = 0;
  if (offset.has_lower()) greatest_ns = std::abs(static_cast<double>(offset.lower_ns));
  if (offset.has_upper()) {
    greatest_ns = std::max(greatest_ns, std::abs(static_cast<double>(offset.upper_ns)));
  }
  return std::ceil(greatest_ns / kMillisecondNs) / 1e3;
}

}  // namespace collision::server
