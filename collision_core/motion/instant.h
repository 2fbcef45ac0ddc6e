// Points in time, exact to the nanosecond.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

#include "collision_core/numeric/interval.h"

namespace collision {

/// A point in time: nanoseconds since the epoch of the world's clock (1970 for a wall clock, the
/// run's start for a simulated one). `Never()` is later than every other instant.
class Instant {
 public:
  constexpr Instant() = default;
  static constexpr Instant FromNanoseconds(std::int64_t ns) { return Instant(ns); }
  static constexpr Instant Never() { return Instant(std::numeric_limits<std::int64_t>::max()); }
  /// Earlier than every other instant.
  static constexpr Instant Always() { return Instant(std::numeric_limits<std::int64_t>::min()); }

  constexpr std::int64_t nanoseconds() const { return ns_; }
  constexpr bool is_never() const { return *this == Never(); }
  friend constexpr auto operator<=>(Instant, Instant) = default;

 private:
  constexpr explicit Instant(std::int64_t ns) : ns_(ns) {}
  std::int64_t ns_ = 0;
};

/// The seconds from `from` to `to`, as an interval that contains the exact quotient ns / 1e9.
/// Neither may be `Never()` or `Always()`.
Interval SecondsBetween(Instant from, Instant to);

/// The last nanosecond not later than `from + seconds` (a lower bound stays one). +infinity, and
/// anything past the range, gives `Never()`. `seconds` must not be NaN.
Instant AddRoundedDown(Instant from, double seconds);

/// The first nanosecond not earlier than `from + seconds`; saturates at `Never()`.
Instant AddRoundedUp(Instant from, double seconds);

}  // namespace collision
