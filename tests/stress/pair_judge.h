// Judges the two queries about balls against exact arithmetic: when two horns may first meet, and
// when two balls touch.
//
// The condition of either query follows from its inputs: an answer counts as narrow where it is
// the exact answer of a problem whose lengths are off by K units in the last place of what they are
// compared with (|Δp|, |v τ|, r, u). So a grazing pair may be answered less narrowly than one head
// on, by just as much as its inputs force.
#pragma once

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/narrow_phase/contact/ball_contact.h"
#include "tests/stress/case.h"

namespace collision::stress {

/// A ball that moves with constant velocity, up to M.
motion::SpaceTimeBound Ball(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double radius,
                            double acceleration_max = 0);

/// K of the earliest possible intersection; beyond it 1e-9 of the time are allowed.
inline constexpr double kPairUnits = 4;

/// Likewise among the denormals, where a unit is 2^-1074. Sums are exact there; a product or
/// quotient is rounded outward by 1.5 units at most (numeric/rounding.h). In the gap at δ, seen
/// along n, which is not longer than √3 and has no component beyond 1 (first_approach.cc): three of
/// w δ, three of n·d and one of its division by |n| >= 1 make 10.5; of the reach both ½M, c1 δ, c2
/// δ and its product with δ make 7.5.
inline constexpr double kDenormalUnits = 18;

/// EarliestIntersection(): not late, K units early at most, the same for (B, A), finite or never.
void JudgePair(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant from,
               Outcome* outcome, double units_max = kPairUnits);

/// K of the brackets of a contact of two balls, counted in roundings, each a unit at most
/// (numeric/rounding.h), of |Δp| + |Δv δ| (P), r and u.
///
/// Freedom ends where the lower end of the gap is not positive (first_approach.cc). In it are: Δp,
/// Δv, δ Δv and its sum with Δp, those again where freedom is followed up anew, so 5 of P; three
/// products with n and two sums, 3 of P; |n|, 2.5, the quotient and the difference, 4.5; so 12.5 of
/// P, and of r and u no more. A step that is shorter than 2^-50 δ ends it too: then the gap is 4 of
/// |Δv δ|, or 8 of u, at most. 20.5 in all, where its 400 steps suffice.
///
/// Contact is certain where the lower end of the depth is not negative (ball_contact.cc): 3 of P
/// for d, 2.5 for its length, 1 for the difference, 3 of r and 7 of u, which counts up to 2 r:
/// beyond that they are apart by more than rounding can tell. That is 6.5 of P + 3 r, at the end of
/// the segment. The nearest time is off by 4.5 of P, in depth. The golden section takes a wrong
/// turn where two depths are as near each other as 6.5, which loses 0.382 / 0.236 times as much,
/// with 6.5 for what is looked at: 17.1. A bisection passes half the depth between two certain
/// times: 13.
inline constexpr double kContactUnits = 21;
/// Beside it, for where contact begins and ends, and where it is free afterwards: this share of the
/// segment.
inline constexpr double kContactResolution = 1.01e-13;

/// EvaluateBallSegment() over [stamp, stamp + duration]: ordered, free where it says so, touching
/// where it says so, and each end within K units. Requires equal stamps.
void JudgeContact(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, double duration,
                  Outcome* outcome);

/// The sentence for both: the number of queries, and the width of the widest answer.
void SayJudged(Outcome* outcome);

}  // namespace collision::stress
