// Points in time, exact to the nanosecond.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace collision {

/// A point in time: whole nanoseconds since the epoch of the world's clock (1970 for a wall clock,
/// the start of the run for a simulated one). `Never()` is later than every other instant. Instants
/// are exact. The conversions to and from seconds (numeric/seconds.h) state their rounding.
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

}  // namespace collision
