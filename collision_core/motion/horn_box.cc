#include "collision_core/motion/horn_box.h"

#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

/// How far a capped face has come from p_WA by t, less the radius; `horn_reach` if the cap has not
/// taken over before.
numeric::Interval ReachAt(const CappedFace& face, Instant t, numeric::Interval horn_reach) {
  return face.from < t ? face.shift + face.UFrom(t).c0 : horn_reach;
}

}  // namespace

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t) {
  const bool holds = DirectionHoldsFor(bound, t) >= 0;
  return BoxAt(bound, t, holds ? DirectionUse::kCounted : DirectionUse::kIgnored);
}

FaceBox BoxAt(const SpaceTimeBound& bound, Instant t, DirectionUse direction) {
  const numeric::Interval errors = ForwardErrors(bound, t).c0;
  const numeric::Interval deviation = ForwardDeviation(bound, t).c0;
  const numeric::Interval since = numeric::SecondsBetween(bound.state.stamp, t);
  const DirectionalReach reach =
      direction == DirectionUse::kCounted ? ReachOfDirection(bound.state) : DirectionalReach();
  const bool capped = HasSpeedCap(bound.limits);
  const numeric::Interval radius = bound.limits.radius;
  FaceBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const FaceNormal lower{axis, -1}, upper{axis, 1};
    const numeric::Interval shift = PathOfFace(bound.state, upper, since);
    numeric::Interval down = errors + reach.downward[axis] * deviation - shift;
    numeric::Interval up = errors + reach.upward[axis] * deviation + shift;
    if (capped) {
      down = ReachAt(CappedFaceOf(bound, lower, reach.downward[axis]), t, down);
      up = ReachAt(CappedFaceOf(bound, upper, reach.upward[axis]), t, up);
    }
    box.lower[axis] = numeric::Interval(bound.state.p_WA[axis]) - (radius + down);
    box.upper[axis] = numeric::Interval(bound.state.p_WA[axis]) + (radius + up);
  }
  return box;
}

}  // namespace collision::motion
