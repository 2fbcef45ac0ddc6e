// Free, touching or undecided: two balls over one segment of time.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// What is certain about one ball over [base, base + duration]: every bound in `bounds` holds at
/// every instant of it (forward from the last known state, backward from the next). None: nothing
/// is known.
struct BallSegment {
  double radius = 0;
  std::vector<MovingBall> bounds;
};

/// Seconds after base; every claim holds for all motions within the bounds.
struct SegmentVerdict {
  /// Apart on [0, free_until). +infinity: on all of the segment, its end included; else less than
  /// its duration, and below 0 where a segment of duration 0 is not certified.
  double free_until = 0;
  /// Touching on [contact_from, contact_to]; empty if contact_from > contact_to.
  double contact_from = 1;
  double contact_to = 0;
  /// False: touching is certified at both ends but not throughout.
  bool contact_continuous = true;
  /// Apart on (free_from, duration]. −infinity: on all of it; `duration`: not certified at the end.
  double free_from = 0;
};

/// Apart is |Δc| > r_A + r_B + u_A + u_B, touching is |Δc| <= r_A + r_B − u_A − u_B, for any choice
/// of one bound of each. Times are rounded so that each claim is on the safe side. `duration` is
/// rounded up by the caller; claims at its end hold at the exact end too. Works with duration 0 (an
/// instant).
SegmentVerdict JudgeSegment(const BallSegment& a, const BallSegment& b, double duration);

/// What JudgeSegment() would tell, bit for bit, where a few operations in plain doubles show that
/// the two touch throughout; else nullopt. Bodies that rest in each other are judged again and
/// again.
std::optional<SegmentVerdict> ContactAtAGlance(const BallSegment& a, const BallSegment& b,
                                               double duration);

/// The distance of the two surfaces at δ after base, best over the bounds: [lower, upper]; <= 0
/// touching. lower > upper: the bounds contradict each other, so one of them was breached.
struct SeparationAt {
  Interval separation;
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  ///< Most likely centre of A [m].
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< Likewise of B.
  double error_A = 0, error_B = 0;                 ///< Within these of the true centres.
};
SeparationAt JudgeInstant(const BallSegment& a, const BallSegment& b, double delta);

}  // namespace collision
