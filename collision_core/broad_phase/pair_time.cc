#include "collision_core/broad_phase/pair_time.h"

#include <algorithm>

#include "collision_core/broad_phase/first_approach.h"

namespace collision {
namespace {

Interval Component(const IntervalVector& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Both agents seen from the base instant. Every operation gives the same bits (or the negated
/// ones) when A and B change places: negation is exact, and a + b is b + a.
struct Pair {
  const SpaceTimeBound& a;
  const SpaceTimeBound& b;
  Instant base;
  IntervalVector d0;  ///< From A's centre to B's.
  IntervalVector w;
  Quadratic u_A, u_B;
  Interval radii;

  Pair(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant base) : a(a), b(b), base(base) {
    const MovingBall ball_A = ForwardBall(a, base), ball_B = ForwardBall(b, base);
    // Positions first: a scene far from the origin loses only what its inputs lost.
    d0 = IntervalVector(b.state.p_WA) - IntervalVector(a.state.p_WA) +
         (SecondsBetween(b.state.stamp, base) * ball_B.velocity -
          SecondsBetween(a.state.stamp, base) * ball_A.velocity);
    w = ball_B.velocity - ball_A.velocity;
    u_A = ball_A.u();
    u_B = ball_B.u();
    radii = Interval(a.declaration.radius) + b.declaration.radius;
  }

  double BallTime(double limit) const {
    const Quadratic u = u_A + u_B;
    return FirstApproach({d0, w, radii + u.c0, u.c1, u.c2}, limit);
  }
};

/// One agent's part in the boxes' extents: what a direction takes away from the ball's.
struct Extent {
  Quadratic u;
  Quadratic deviation;
  DirectionalReach reach;

  /// u without the part that the direction forbids.
  Quadratic Towards(bool up, int axis) const {
    const Interval fraction = up ? reach.upward[axis] : reach.downward[axis];
    return u + (fraction - Interval(1)) * deviation;
  }
};

/// Six conditions, each a convex quadratic that must be >= 0 for the boxes to overlap; so each
/// fails on one interval of time at most.
struct BoxConditions {
  Quadratic overlap[6];

  BoxConditions(const Pair& pair, const Extent& extent_A, const Extent& extent_B) {
    for (int axis = 0; axis < 3; ++axis) {
      const Quadratic away{Component(pair.d0, axis), Component(pair.w, axis), 0};
      const Quadratic still{pair.radii, 0, 0};
      overlap[axis] = Interval(-1) * away + still +
                      (extent_A.Towards(true, axis) + extent_B.Towards(false, axis));
      overlap[axis + 3] =
          away + still + (extent_A.Towards(false, axis) + extent_B.Towards(true, axis));
    }
  }

  /// The first time from `start` on at which all may hold, rounded down; may be +infinity. A
  /// condition that has recovered never fails again, so six rounds find the end of the last
  /// failure.
  double FirstFrom(double start) const {
    double time = start;
    for (int round = 0; round < 6; ++round) {
      double next = time;
      for (const Quadratic& condition : overlap) {
        const Quadratic seen = condition.From(time);
        const double step = FirstZero(-seen.c0.upper, seen.c1.upper, std::max(0.0, seen.c2.upper));
        if (step == kInfinity) return kInfinity;
        next = std::max(next, AddDown(time, step));
      }
      if (next == time) return time;
      time = next;
    }
    return time;
  }
};

/// The first overlap of the two boxes, piece by piece between the ends of the directions.
double BoxTime(const Pair& pair, double limit) {
  const double end_A = DirectionHoldsFor(pair.a, pair.base);
  const double end_B = DirectionHoldsFor(pair.b, pair.base);
  Extent extent_A{pair.u_A, ForwardDeviation(pair.a, pair.base), {}};
  Extent extent_B{pair.u_B, ForwardDeviation(pair.b, pair.base), {}};
  double start = 0;
  while (start <= limit) {
    const bool A_holds = end_A > start, B_holds = end_B > start;
    extent_A.reach = A_holds ? ReachOfDirection(pair.a.state) : DirectionalReach();
    extent_B.reach = B_holds ? ReachOfDirection(pair.b.state) : DirectionalReach();
    const double end = std::min(A_holds ? end_A : kInfinity, B_holds ? end_B : kInfinity);
    const double time = BoxConditions(pair, extent_A, extent_B).FirstFrom(start);
    if (time < end || end == kInfinity) return time;
    start = end;
  }
  return kInfinity;
}

bool DirectionMatters(const SpaceTimeBound& bound, Instant base) {
  return bound.declaration.acceleration_max > 0 && DirectionHoldsFor(bound, base) > 0;
}

}  // namespace

PairTime EarliestIntersection(const SpaceTimeBound& a, const SpaceTimeBound& b, Instant from) {
  const Instant base = std::max({from, a.state.stamp, b.state.stamp});
  const Instant expiry = std::min(a.state.expiry, b.state.expiry);
  if (!CanMeet(a.declaration, b.declaration) || expiry <= base) return {base, kInfinity};
  const double limit = expiry.is_never() ? kInfinity : SecondsBetween(base, expiry).upper;
  const Pair pair(a, b, base);
  double time = pair.BallTime(limit);
  if (time < limit && (DirectionMatters(a, base) || DirectionMatters(b, base))) {
    time = std::max(time, BoxTime(pair, limit));
  }
  return {base, time < limit ? time : kInfinity};
}

}  // namespace collision
