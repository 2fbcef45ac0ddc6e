// Seconds between instants, and instants some seconds later, with a stated rounding.
#pragma once

#include "collision_core/base/instant.h"
#include "collision_core/numeric/interval.h"

namespace collision::numeric {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// A nanosecond [s], to the nearest double: for times that need no certain rounding, or where the
/// relative 2^-52 of a product with it is counted.
inline constexpr double kNanosecond = 1e-9;

/// The seconds from `from` to `to`, as an interval that contains the exact quotient ns / 1e9.
/// Neither may be `Never()` or `Always()`.
Interval SecondsBetween(Instant from, Instant to);

/// The last nanosecond not later than `from + seconds`, so that a lower bound stays one. +infinity,
/// and anything past the range, gives `Never()`. Requires that `seconds` is not NaN.
Instant AddRoundedDown(Instant from, double seconds);

/// The first nanosecond not earlier than `from + seconds`; saturates at `Never()`.
Instant AddRoundedUp(Instant from, double seconds);

}  // namespace collision::numeric
