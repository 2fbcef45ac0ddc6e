// The acceleration that the states of a curve tell, and the bounds that the curve then keeps.
//
// The curve's acceleration x'' is linear on each piece and jumps at the knots between two pieces.
// With a_k the mean of its two limits at knot k, let ā(t) be the continuous, piecewise linear
// function through the a_k. (At both ends, where there is one limit only, a_k is what is nearest to
// its neighbour within D of that limit. Where a row declares a jump of the motion, one curve ends
// and another one begins.) A state at s tells ā(s). On each piece x'' − ā is linear, and at its
// ends half of a jump of x'', so nowhere longer than D, half of the greatest one; and ā changes by
// no more than J a second, its greatest slope. Hence for all s and t, in either order,
//
//   |x''(t) − ā(s)| <= |x''(t) − ā(t)| + |ā(t) − ā(s)| <= D + J |t − s|.
//
// That holds over the whole curve and not only up to the next state: states are sent on demand, so
// any of them may have to stand in for all that follow. Two states never differ by more than J for
// each second between them, so that a new bound lies inside the one before it (a *kept* state,
// collision_core/motion/contract.h).
//
// D cannot be less: whatever a state at a knot tells, one of the two limits is at least half of the
// jump away from it, at once, and J has had no time to work. With x'' itself for ā, D would be the
// whole jump.
#pragma once

#include <cstdint>
#include <vector>

#include "client/programs/simulators/player/trajectory.h"

namespace collision::client {

/// ½ D τ² + ⅙ J τ³ [m]: how far from what was known an agent can be after `seconds`.
double ReachAfter(double seconds, double deviation_max_m_s2, double jerk_max_m_s3);

/// What is known of the acceleration along a curve, and how well. Where the curve jumps it begins
/// anew: D and J say nothing across a jump.
class KnownAcceleration {
 public:
  explicit KnownAcceleration(const Trajectory& curve);

  /// What a state at `stamp_ns` tells; `stamp_ns` in [begin_ns, end_ns] of the curve.
  Vector3 At(std::int64_t stamp_ns) const;

  /// D and J, rounded up: at any two instants s and t of the curve its acceleration at t is within
  /// D + J |t − s| of At(s), if no jump lies between. The states taken from the curve keep them,
  /// too.
  double deviation_max_m_s2() const { return deviation_max_m_s2_; }
  double jerk_max_m_s3() const { return jerk_max_m_s3_; }

 private:
  std::vector<std::int64_t> knots_ns_;
  std::vector<Vector3> begins_m_s2_;  ///< At the knots, from there on.
  std::vector<Vector3> ends_m_s2_;    ///< At the ends of the pieces.
  double deviation_max_m_s2_ = 0;
  double jerk_max_m_s3_ = 0;
};

}  // namespace collision::client
