#include "collision_core/motion/moving_rotation.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::motion {
namespace {

// π, rounded up.
constexpr double kHalfTurn = 0x1.921fb54442d19p+1;

// θ with σ = start + slope δ.
numeric::Cubic OffAngle(const SpaceTimeBound& bound, numeric::Interval start, double slope) {
  const double alpha = bound.limits.angular_acceleration_max;
  if (alpha < 0) return {kHalfTurn, 0, 0};
  const numeric::Interval half = numeric::Interval(0.5) * alpha;
  const numeric::Interval step = bound.limits.time_step;
  const numeric::Interval still =
      bound.skew > 0 ? numeric::Norm(numeric::IntervalVector(bound.state.w_WB)) * bound.skew
                     : numeric::Interval(0);
  return {bound.state.rotation_error + still + half * start * (start + step),
          half * slope * (numeric::Interval(2) * start + step), half};
}

}  // namespace

MovingRotation ForwardRotation(const SpaceTimeBound& bound, Instant base) {
  CORE_CHECK(base >= bound.state.stamp, "a forward rotation starts at its stamp",
             base.nanoseconds(), bound.state.stamp.nanoseconds());
  const numeric::Interval since = numeric::SecondsBetween(bound.state.stamp, base);
  return {bound.state.q_WB, bound.state.w_WB, since, OffAngle(bound, since + bound.skew, 1)};
}

MovingRotation BackwardRotation(const SpaceTimeBound& bound, Instant base) {
  CORE_CHECK(base <= bound.state.stamp, "a backward rotation ends at its stamp", base.nanoseconds(),
             bound.state.stamp.nanoseconds());
  const numeric::Interval since = numeric::SecondsBetween(bound.state.stamp, base);
  return {bound.state.q_WB, bound.state.w_WB, since, OffAngle(bound, -since + bound.skew, -1)};
}

}  // namespace collision::motion
