// The operations of interval.h, inline: the certified routines spend nearly all their time in them.
#pragma once

#include <algorithm>

#include "collision_core/numeric/interval.h"
#include "collision_core/numeric/rounding.h"

namespace collision::numeric {

inline Interval operator+(Interval a, Interval b) {
  return {AddDown(a.lower, b.lower), AddUp(a.upper, b.upper)};
}

inline Interval operator-(Interval a) { return {-a.upper, -a.lower}; }

inline Interval operator-(Interval a, Interval b) { return a + -b; }

// Products are inlined by force: passed through memory they would cost four times as much.

/// s times b. The ends are picked without a branch: signs are as good as random.
[[gnu::always_inline]] inline Interval Scale(double s, Interval b) {
  const double ends[2] = {b.lower, b.upper};
  const bool turns = s < 0;
  return {MultiplyDown(s, ends[turns]), MultiplyUp(s, ends[!turns])};
}

/// Neither is a point. Out of line: it is rare, and would keep the operator from being inlined.
Interval MultiplyWide(const Interval& a, const Interval& b);

[[gnu::always_inline]] inline Interval operator*(Interval a, Interval b) {
  if (a.lower == a.upper) return Scale(a.lower, b);
  if (b.lower == b.upper) return Scale(b.lower, a);
  return MultiplyWide(a, b);
}

inline Interval operator/(Interval a, Interval b) {
  if (b.lower <= 0 && b.upper >= 0) return {-kInfinity, kInfinity};
  if (b.upper < 0) a = -a, b = -b;
  return {DivideDown(a.lower, a.lower >= 0 ? b.upper : b.lower),
          DivideUp(a.upper, a.upper >= 0 ? b.lower : b.upper)};
}

inline Interval Abs(Interval a) {
  if (a.lower >= 0) return a;
  if (a.upper <= 0) return -a;
  return {0, std::max(-a.lower, a.upper)};
}

inline Interval Square(Interval a) {
  a = Abs(a);
  return {MultiplyDown(a.lower, a.lower), MultiplyUp(a.upper, a.upper)};
}

inline Interval Sqrt(Interval a) { return {SqrtDown(a.lower), SqrtUp(a.upper)}; }

inline Interval Max(Interval a, Interval b) {
  return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
}

inline Interval Min(Interval a, Interval b) {
  return {std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
}

inline IntervalVector operator+(const IntervalVector& a, const IntervalVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline IntervalVector operator-(const IntervalVector& a, const IntervalVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline IntervalVector operator*(Interval s, const IntervalVector& v) {
  return {s * v.x, s * v.y, s * v.z};
}

inline Interval Dot(const IntervalVector& a, const IntervalVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Interval Norm(const IntervalVector& v) {
  const auto norm = [](const IntervalVector& u) {
    return Sqrt(Square(u.x) + Square(u.y) + Square(u.z));
  };
  // Between these, squares neither overflow nor lose their error; others are scaled by a power of
  // two.
  constexpr double kLargest = 0x1p+500, kSmallest = 0x1p-440, kScale = 0x1p+600;
  const double magnitude = std::max({Abs(v.x).upper, Abs(v.y).upper, Abs(v.z).upper});
  if (magnitude > kLargest) return Interval(kScale) * norm(Interval(1 / kScale) * v);
  if (magnitude < kSmallest) return Interval(1 / kScale) * norm(Interval(kScale) * v);
  return norm(v);
}

}  // namespace collision::numeric
