#include "collision_core/intersection/box_overlap.h"

#include <algorithm>
#include <array>

#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/seconds.h"

namespace collision::intersection {
namespace {

/// From p_WA along a normal to the face, less the radius: shift + velocity δ + bend δ² + u(δ), from
/// `start` on.
struct Reach {
  double start = 0;
  numeric::Interval shift, velocity, bend;
  numeric::Cubic u;
};

/// A face over time: the horn's, then the cap's.
struct Face {
  Reach horn, cap;

  const Reach& at(double delta) const { return delta < cap.start ? horn : cap; }
};

/// One agent seen from the base.
struct Agent {
  const motion::SpaceTimeBound& bound;
  Instant base;
  numeric::Interval since;
  numeric::Cubic errors, deviation;
  double direction_end;

  Agent(const motion::SpaceTimeBound& given, Instant seen_from)
      : bound(given),
        base(seen_from),
        since(numeric::SecondsBetween(given.state.stamp, seen_from)),
        errors(ForwardErrors(given, seen_from)),
        deviation(ForwardDeviation(given, seen_from)),
        direction_end(DirectionHoldsFor(given, seen_from)) {}

  /// The face with the normal `sign` times the axis; `fraction` of the deviation counts there.
  Face FaceOf(motion::FaceNormal normal, numeric::Interval fraction) const {
    Face face;
    numeric::Interval velocity = normal.Along(bound.state.v_WA);
    numeric::Interval bend = 0;
    const double known = normal.Along(bound.state.a_WA);
    if (known != 0) velocity = velocity + since * numeric::Interval(known), bend = 0.5 * known;
    face.horn = {0, PathOfFace(bound.state, normal, since), velocity, bend,
                 errors + fraction * deviation};
    face.cap.start = numeric::kInfinity;
    if (!HasSpeedCap(bound.limits)) return face;
    const motion::CappedFace cap = CappedFaceOf(bound, normal, fraction);
    if (cap.from.is_never()) return face;
    face.cap = {numeric::SecondsBetween(base, cap.from).lower, cap.shift, 0, 0, cap.UFrom(base)};
    return face;
  }
};

/// One of the six conditions: the face of one agent has reached that of the other. Without known
/// accelerations it is a convex function of time, in pieces, that must be >= 0; so it fails on one
/// interval of time at most.
class Condition {
 public:
  /// `along` leads from the agent of `face` to that of `other`, whose normal is the opposite.
  Condition(numeric::Interval along, numeric::Interval radii, const Face& face, const Face& other) {
    const double first = std::min(face.cap.start, other.cap.start);
    const double second = std::max(face.cap.start, other.cap.start);
    for (const double start : {-numeric::kInfinity, first, second}) {
      if (start == numeric::kInfinity || (pieces_ > 0 && start == start_[pieces_ - 1])) continue;
      const Reach &reach = face.at(start), &opposite = other.at(start);
      // Differences first, so that what both have in common cancels.
      const numeric::Cubic lines{radii + ((reach.shift + opposite.shift) - along),
                                 reach.velocity + opposite.velocity, reach.bend + opposite.bend};
      start_[pieces_] = start;
      value_[pieces_++] = lines + (reach.u + opposite.u);
    }
  }

  /// The first time from `time` on at which it may hold, rounded down.
  double FirstFrom(double time) const {
    for (int i = 0; i < pieces_; ++i) {
      const double end = i + 1 < pieces_ ? start_[i + 1] : numeric::kInfinity;
      if (end <= time) continue;
      const double zero = FirstOfPiece(value_[i], time);
      if (zero < end || end == numeric::kInfinity) return zero;
      time = end;
    }
    return time;
  }

 private:
  /// From `time` on, of one piece.
  static double FirstOfPiece(const numeric::Cubic& value, double time) {
    const numeric::Cubic seen = value.From(time);
    if (seen.c0.upper >= 0) return time;
    const double step = numeric::FirstZero(-seen.c0.upper, seen.c1.upper, seen.c2.upper,
                                           std::max(0.0, seen.c3.upper));
    return step == numeric::kInfinity ? numeric::kInfinity : numeric::AddDown(time, step);
  }

  int pieces_ = 0;
  double start_[3];
  numeric::Cubic value_[3];
};

/// Rounds at most. A condition that is convex and has recovered never fails again, so six rounds
/// find the end of the last failure. With known accelerations one may fail again; then the time
/// found so far is returned at the bound: early, never late.
constexpr int kRoundsMax = 64;

/// The first time from `start` on at which all six may hold, rounded down; may be +infinity.
double FirstOfAll(const std::array<Condition, 6>& conditions, double start) {
  double time = start;
  for (int round = 0; round < kRoundsMax; ++round) {
    // All from the same time: the order of the six must not matter, it turns with A and B.
    double next = time;
    for (const Condition& condition : conditions) {
      next = std::max(next, condition.FirstFrom(time));
      if (next == numeric::kInfinity) return numeric::kInfinity;
    }
    if (next == time) return time;
    time = next;
  }
  return time;
}

/// The conditions while the deviations of A and B reach as far as given.
std::array<Condition, 6> Conditions(const Agent& a, const motion::DirectionalReach& reach_A,
                                    const Agent& b, const motion::DirectionalReach& reach_B,
                                    double margin) {
  const numeric::Interval radii =
      (numeric::Interval(a.bound.limits.radius) + b.bound.limits.radius) + margin;
  const auto condition = [&](int axis, int sign) {
    const numeric::Interval along =
        numeric::Interval(sign * b.bound.state.p_WA[axis]) - sign * a.bound.state.p_WA[axis];
    return Condition(along, radii,
                     a.FaceOf({axis, sign}, (sign > 0 ? reach_A.upward : reach_A.downward)[axis]),
                     b.FaceOf({axis, -sign}, (sign > 0 ? reach_B.downward : reach_B.upward)[axis]));
  };
  return {condition(0, 1),  condition(1, 1),  condition(2, 1),
          condition(0, -1), condition(1, -1), condition(2, -1)};
}

bool BoxMatters(const motion::SpaceTimeBound& bound, Instant base) {
  if (CanDeviate(bound.limits) && DirectionHoldsFor(bound, base) > 0) return true;
  return HasSpeedCap(bound.limits);
}

}  // namespace

bool BoxesMatter(const BoundPair& pair) {
  return BoxMatters(pair.a, pair.base) || BoxMatters(pair.b, pair.base);
}

double LaterOfBoxes(const BoundPair& pair, double time, double limit) {
  const Agent agent_A(pair.a, pair.base), agent_B(pair.b, pair.base);
  const motion::DirectionalReach everywhere;
  // Piece by piece between the ends of the directions.
  double start = 0;
  while (start <= limit) {
    const bool A_holds = agent_A.direction_end > start, B_holds = agent_B.direction_end > start;
    const double end = std::min(A_holds ? agent_A.direction_end : numeric::kInfinity,
                                B_holds ? agent_B.direction_end : numeric::kInfinity);
    const auto conditions =
        Conditions(agent_A, A_holds ? ReachOfDirection(pair.a.state) : everywhere, agent_B,
                   B_holds ? ReachOfDirection(pair.b.state) : everywhere, pair.margin);
    // Boxes that overlap at `time` have done so before, or do so just then.
    if (time >= start && time < end && FirstOfAll(conditions, time) == time) return time;
    const double overlap = FirstOfAll(conditions, start);
    if (overlap < end || end == numeric::kInfinity) return std::max(time, overlap);
    start = end;
  }
  return numeric::kInfinity;
}

}  // namespace collision::intersection
