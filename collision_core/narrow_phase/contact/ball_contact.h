// Free, touching or undecided: two balls over one segment of time.
//
// Contact. For one choice of bounds r − u_A − u_B − |Δc| is concave in t (u and |Δc| are convex),
// so certified contact at two instants is contact between them; with a known acceleration the path
// bends, and what is between is certified part by part. The deepest instant is found
// approximately, then certified; then both ends by bisection, keeping the certified side. The union
// over the choices is the answer; if its parts do not connect, contact is certified at both ends
// but not throughout.
//
// Freedom. The certified first approach (first_approach.h) forward from the start and, with time
// reversed, backward from the end. When one choice of bounds gives up, the others carry on from
// there.
//
// How narrow. Half-way between two exact states T apart u = M T²/8 for each agent, so a begin or an
// end is known to about ± (M_A + M_B) T²/8 over the closing speed, better near a state. Two
// satellites closing at 11.6 km/s with states 1 s apart (M = 7.9 m/s²): the begin within 0.14 ms,
// the end within 0.04 ms.
#pragma once

#include <optional>

#include "collision_core/narrow_phase/pose/ball_segment.h"

namespace collision::narrow_phase {

/// Seconds after base; every claim holds for all motions within the bounds.
struct SegmentResult {
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

/// Judges two balls over [0, duration] seconds after their base. Apart means |Δc| > r_A + r_B + u_A
/// + u_B, touching |Δc| <= r_A + r_B − u_A − u_B, for any choice of one bound of each. Times are
/// rounded so that each claim is on the safe side. The caller rounds `duration` up [s]; claims at
/// its end hold at the exact end too. Works with duration 0 (an instant).
SegmentResult EvaluateBallSegment(const BallSegment& a, const BallSegment& b, double duration);

/// The result of EvaluateBallSegment(), bit for bit, where a few operations in plain doubles show
/// that the two balls touch throughout; else nullopt. Balls that overlap deeply for long are
/// evaluated again and again: touching is certain at both ends and no choice of bounds starts free,
/// which is seen here with a margin derived beside the code, at a tenth of the cost.
std::optional<SegmentResult> QuickBallContact(const BallSegment& a, const BallSegment& b,
                                              double duration);

/// The distance of the two surfaces at δ after base, best over the bounds: [lower, upper]; <= 0
/// touching. lower > upper: the bounds contradict each other, so one of them was breached.
struct SeparationAt {
  numeric::Interval separation;
  Eigen::Vector3d p_WA =
      Eigen::Vector3d::Zero();  ///< Centre of A by its least uncertain bound [m].
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< Most likely centre of B [m].
  double error_A = 0, error_B = 0;  ///< The true centres lie within these of p_WA and p_WB [m].
};
/// Evaluates two balls at `delta` seconds after their base.
SeparationAt EvaluateBallsAt(const BallSegment& a, const BallSegment& b, double delta);

}  // namespace collision::narrow_phase
