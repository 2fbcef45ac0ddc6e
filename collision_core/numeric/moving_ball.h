// A ball that moves along a line or a parabola and grows: in intervals, and in plain doubles.
//
// The space-time bound of an agent is such a ball, and so is the relative motion of two of them: A
// and B can touch when the ball about c_B − c_A, with the velocity v_B − v_A and the radius ρ_A +
// ρ_B, contains the origin. Three precisions exist, each with one type:
//
//   MovingBall   intervals; contains the exact ball. The certified routines compute with it.
//   QuickBall    doubles; reaches outward as far as its centre and reach may be off. The quick root
//                finder, the filter of one pair and the sweep of two nodes compute with it.
//   PlacedBall   floats (broad_phase/filter/placement_frame.h); the filter in wide vectors.
//
// Each is made where its reader is, with the argument for its rounding. Intervals and doubles come
// from the bound itself: ForwardBall() and BackwardBall() in motion/space_time_bound.cc;
// QuickHornPair() in intersection/quick_horn_pair.cc, and HornTable, which makes and keeps rows
// (Fill() in broad_phase/filter/horn_table.cc) and moves them to an instant (At()). Floats come
// from doubles: PlacementFrame in broad_phase/filter/placement_frame.h; what positions lose there
// is added in broad_phase/filter/placed_balls.h and by the stores that fill it.
//
// Four other forms exist beside these, each for one reader:
//
//   ReachPoint            a PlacedBall for one window, with its reach at the window's end: the grid
//                         compares numbers, not functions. PlacementFrame::HalfWay() makes it, by
//                         the same argument as a PlacedBall (broad_phase/filter/placement_frame.h).
//   ClearanceFilter::Row  the terms of a bound as declared: its reader adds one allowance for both
//                         agents (detection/clearance/clearance_filter.h).
//   CappedBall            under a speed cap, from the instant at which the cap takes over: a centre
//                         that stands still (motion/speed_cap.h).
//   Estimate              the capped balls and boxes of a bound at one time, with no allowance: a
//                         wrong estimate costs work, never an answer
//                         (intersection/overlap_estimate.cc).
#pragma once

#include <cmath>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/cubic.h"
#include "collision_core/numeric/interval.h"

namespace collision::numeric {

/// A ball as functions of the seconds δ >= 0 after a base instant:
///
///   centre(δ) = anchor + shift + velocity δ + bend δ² [m],   radius(δ) = radius + u(δ) [m].
///
/// Each interval contains the exact coefficient. Anchor and shift are kept apart so that the
/// difference of two balls subtracts anchors first: a scene far from the origin loses only what its
/// inputs lost.
struct MovingBall {
  IntervalVector anchor;     ///< Where the motion was known: p_WA of a bound.
  IntervalVector shift;      ///< From there to the centre at δ = 0.
  IntervalVector velocity;   ///< [m/s]
  Interval radius;           ///< The constant part of the radius.
  Cubic u;                   ///< The growing part; convex wherever the ball is valid.
  bool bends = false;        ///< Whether `bend` may be other than zero.
  IntervalVector bend = {};  ///< Half the known acceleration [m/s²].

  /// The centre at δ = 0.
  IntervalVector centre() const { return anchor + shift; }
  /// The way from the centre at δ = 0 to the one at `delta`.
  IntervalVector PathTo(double delta) const {
    if (!bends) return Interval(delta) * velocity;
    return Interval(delta) * (velocity + Interval(delta) * bend);
  }
  /// The velocity of the centre at `delta`.
  IntervalVector VelocityAt(double delta) const {
    return bends ? velocity + Interval(2 * delta) * bend : velocity;
  }
  /// The whole radius.
  Cubic reach() const { return {radius + u.c0, u.c1, u.c2, u.c3}; }
};

/// The ball of the relative motion from A to B, larger by `margin` [m]: A and B come within the
/// margin of each other when it contains the origin. (B, A) gives the negated centre and the same
/// radius, bit for bit: negation is exact, and a + b is b + a.
inline MovingBall Difference(const MovingBall& a, const MovingBall& b, double margin) {
  MovingBall difference{b.anchor - a.anchor, b.shift - a.shift, b.velocity - a.velocity,
                        (a.radius + b.radius) + margin, a.u + b.u};
  difference.bends = a.bends || b.bends;
  if (difference.bends) difference.bend = b.bend - a.bend;
  return difference;
}

/// A ball in plain doubles: at δ >= 0 [s] within s0 + s1 δ + s2 δ² + s3 δ³ [m] of c + v δ + bend δ²
/// [m], where all s are >= 0. The rows of the filter include their own rounding in the reach.
/// Difference() and QuickHornPair() round to nearest and account for it where they are used.
struct QuickBall {
  double c[3];
  double v[3];
  double s0, s1, s2;
  double s3 = 0;
  double bend[3] = {0, 0, 0};  ///< Half the known acceleration [m/s²].

  bool bends() const { return s3 != 0 || bend[0] != 0 || bend[1] != 0 || bend[2] != 0; }
};

/// The same ball about a centre that keeps its velocity: its reach grows by what the bend takes the
/// centre off, rounded up.
inline QuickBall Straightened(QuickBall ball) {
  const double(&h)[3] = ball.bend;
  const double bend = std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  ball.s2 = kFewRoundingsUp * (ball.s2 + bend);
  ball.bend[0] = ball.bend[1] = ball.bend[2] = 0;
  return ball;
}

/// The ball of the relative motion from A to B, rounded to nearest: what that costs is part of the
/// argument at each use.
inline QuickBall Difference(const QuickBall& a, const QuickBall& b) {
  QuickBall difference;
  for (int axis = 0; axis < 3; ++axis) {
    difference.c[axis] = b.c[axis] - a.c[axis];
    difference.v[axis] = b.v[axis] - a.v[axis];
    difference.bend[axis] = b.bend[axis] - a.bend[axis];
  }
  difference.s0 = a.s0 + b.s0, difference.s1 = a.s1 + b.s1;
  difference.s2 = a.s2 + b.s2, difference.s3 = a.s3 + b.s3;
  return difference;
}

}  // namespace collision::numeric
