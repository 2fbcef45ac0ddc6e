#include "collision_core/motion/hypertrapezoid.h"

#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/motion/horn_box.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// The part of the window, as fractions of it, on which a line from `start` to `end` is <= 0.
/// Rounded outward; empty if entry > exit.
struct Span {
  double entry = 0;
  double exit = 1;
};

Span NotPositive(numeric::Interval start, numeric::Interval end) {
  const bool at_start = start.lower <= 0, at_end = end.lower <= 0;
  if (at_start && at_end) return {};
  if (!at_start && !at_end) return {1, 0};
  // Exactly one is positive, so their difference cannot be zero.
  if (at_start) return {0, (-start.lower / (numeric::Interval(end.lower) - start.lower)).upper};
  return {(start.lower / (numeric::Interval(start.lower) - end.lower)).lower, 1};
}

}  // namespace

Hypertrapezoid MakeHypertrapezoid(const SpaceTimeBound& bound, Instant start, Instant end) {
  CORE_CHECK(start <= end, "a window does not end before it starts", start.nanoseconds(),
             end.nanoseconds());
  const DirectionUse direction =
      DirectionHoldsFor(bound, end) >= 0 ? DirectionUse::kCounted : DirectionUse::kIgnored;
  const FaceBox first = BoxAt(bound, start, direction);
  const FaceBox last = BoxAt(bound, end, direction);
  Hypertrapezoid h;
  h.start = start;
  const numeric::Interval duration = numeric::SecondsBetween(start, end);
  h.duration = duration.lower;
  for (int axis = 0; axis < 3; ++axis) {
    h.lower_start[axis] = first.lower[axis].lower;
    h.lower_end[axis] = last.lower[axis].lower;
    h.upper_start[axis] = first.upper[axis].upper;
    h.upper_end[axis] = last.upper[axis].upper;
    const double known = bound.state.a_WA[axis];
    if (known != 0) {
      const double bulge = (std::abs(known) / numeric::Interval(8) * Square(duration)).upper;
      double(&start_of)[3] = known > 0 ? h.lower_start : h.upper_start;
      double(&end_of)[3] = known > 0 ? h.lower_end : h.upper_end;
      const auto outward = [&](double face) {
        return known > 0 ? numeric::AddDown(face, -bulge) : numeric::AddUp(face, bulge);
      };
      start_of[axis] = outward(start_of[axis]);
      end_of[axis] = outward(end_of[axis]);
    }
  }
  return h;
}

double FirstOverlap(const Hypertrapezoid& a, const Hypertrapezoid& b) {
  CORE_CHECK(a.start == b.start && a.duration == b.duration, "both have the same window",
             a.duration, b.duration);
  Span overlap;
  const auto meet = [&overlap](const Hypertrapezoid& below, const Hypertrapezoid& above, int axis) {
    const Span span =
        NotPositive(numeric::Interval(above.lower_start[axis]) - below.upper_start[axis],
                    numeric::Interval(above.lower_end[axis]) - below.upper_end[axis]);
    overlap.entry = std::max(overlap.entry, span.entry);
    overlap.exit = std::min(overlap.exit, span.exit);
  };
  for (int axis = 0; axis < 3; ++axis) {
    meet(a, b, axis);
    meet(b, a, axis);
  }
  if (overlap.entry > overlap.exit) return numeric::kInfinity;
  return numeric::MultiplyDown(overlap.entry, std::min(a.duration, b.duration));
}

}  // namespace collision::motion
