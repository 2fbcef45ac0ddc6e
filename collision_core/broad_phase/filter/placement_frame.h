// Where filters put an agent, and how far it reaches from there during a window.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/broad_phase/filter/pair_filter.h"
#include "collision_core/broad_phase/filter/point_grid.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"

namespace collision::broad_phase {

/// A horn's ball in floats, for the filter in wide vectors: at u seconds after the middle of the
/// placement's window its centre is at c + v u, as seen from the placement's frame, and up to x
/// seconds after the placement's begin all of it lies within s0 + x (s1 + x (s2 + x s3)) of there.
/// A known acceleration is part of the reach: the line is the tangent of the path at the begin.
/// Rounded outward, with the slack that SphereFilter asks for; PlacementFrame makes it.
struct PlacedBall {
  double c[3];  ///< In doubles: PlacedBalls stores it relative to a corner nearby.
  float v[3];
  float speed;  ///< |v|, rounded up.
  float s0, s1, s2, s3;
  float bend;           ///< By bend u² is it off the line before the begin; rounded up.
  std::uint32_t agent;  ///< Its index, or kNoAgent.

  /// In place of an agent's index: the ball of a query about a bound that the table does not hold.
  static constexpr std::uint32_t kNoAgent = ~0u;
};

/// The box around placed agents, and the greatest reach coefficients and speed of any of them.
struct PlacedExtent {
  double low[3] = {numeric::kInfinity, numeric::kInfinity, numeric::kInfinity},
         high[3] = {-numeric::kInfinity, -numeric::kInfinity, -numeric::kInfinity};
  float s0 = 0, s1 = 0, s2 = 0, s3 = 0, speed = 0;

  void Add(const PlacedBall& horn) {
    s0 = std::max(s0, horn.s0), s1 = std::max(s1, horn.s1), s2 = std::max(s2, horn.s2);
    s3 = std::max(s3, horn.s3);
    speed = std::max(speed, horn.speed);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], horn.c[axis]);
      high[axis] = std::max(high[axis], horn.c[axis]);
    }
  }
};

/// From `first` to `last`, in seconds after a placement's begin; `first` may be negative.
struct TimeWindow {
  double first, last;
};

/// A box in space.
struct Region {
  double low[3], high[3];

  bool Contains(const double* c) const {
    return c[0] >= low[0] && c[0] <= high[0] && c[1] >= low[1] && c[1] <= high[1] &&
           c[2] >= low[2] && c[2] <= high[2];
  }
};

/// No window is shorter [s]; beyond the longest every instant is Never().
inline constexpr double kWindowMin = 1e-9;
inline constexpr double kWindowMax = 2e10;

/// A factor that rounds up by more than a conversion to single precision and a product there can
/// lose (2^-24 each).
inline constexpr double kFloatUp = 1 + 0x1p-22;

/// Where filters put agents for a window of time: at the middle of the window, as seen from a frame
/// that moves with the mean velocity of a sample of the agents, or stays at rest if that does not
/// halve their speeds. Until the end of the window an agent stays within its reach plus half its
/// path of where it is placed.
class PlacementFrame {
 public:
  /// Places nothing.
  PlacementFrame() = default;
  /// For windows of the query up to `seconds_max` [s]. Chooses the length of the first window so
  /// that few pairs come within reach of each other in it.
  PlacementFrame(const HornTable& table, const intersection::BroadQuery& query, double seconds_max);

  /// Whether the query begins too far from time zero for filters (HornTable::Near()); all pairs
  /// then go to the canonical routine.
  bool is_unfilterable() const { return !HornTable::Near(query_.from); }
  intersection::BoundKind bound() const { return query_.bound; }
  /// The length of the first window [s].
  double window() const { return window_; }
  /// Shortens the window to `seconds`. Unchecked: no agent was moved to its middle.
  void Shorten(double seconds);

  /// A box with about `count` of the agents in it, near each other: where to look for a first
  /// answer.
  Region Crowd(const HornTable& table, std::size_t count) const;

  PlacedBall Place(const HornTable& table, std::uint32_t agent) const {
    PlacedBall horn = AtBegin(table, agent);
    ToMiddle(&horn);
    return horn;
  }
  /// The same in two steps: where the agent is at the begin, and from there to the middle.
  PlacedBall AtBegin(const HornTable& table, std::uint32_t agent) const {
    PlacedBall horn = AtBegin(BallAt(table, agent));
    horn.agent = agent;
    return horn;
  }
  /// Likewise for a row that is in no table; its agent is PlacedBall::kNoAgent.
  PlacedBall Place(const HornRow& row) const {
    PlacedBall horn = AtBegin(BallAt(row));
    ToMiddle(&horn);
    return horn;
  }
  void ToMiddle(PlacedBall* horn) const {
    for (int axis = 0; axis < 3; ++axis) {
      horn->c[axis] += static_cast<double>(horn->v[axis]) * middle_;
    }
    horn->s0 = (horn->s0 + horn->speed * slack_ + least_) * static_cast<float>(kFloatUp);
  }

  /// The relative motion of two agents from the begin on.
  numeric::QuickBall DifferenceOf(const HornTable& table, std::uint32_t a, std::uint32_t b) const {
    return Difference(BallAt(table, a), BallAt(table, b));
  }

  /// Where an agent is half-way to `last` seconds after the begin, and how far from there it
  /// reaches until then; independent of the window.
  ReachPoint HalfWay(const HornTable& table, std::uint32_t agent, double last) const {
    return HalfWay(BallAt(table, agent), last);
  }
  ReachPoint HalfWay(const numeric::QuickBall& at, double last) const;

  /// How far from its place a horn (or the greatest of many, PlacedExtent) comes during the window.
  template <typename Horn>
  double Reach(const Horn& horn, TimeWindow window) const {
    const double way = std::max(middle_ - window.first, window.last - middle_);
    const double top = horn.s2 + window.last * horn.s3;
    return horn.s0 + window.last * (horn.s1 + window.last * top) + horn.speed * way;
  }
  double middle() const { return middle_; }

  /// The window of the `seconds` after `from`, which may lie before the begin.
  TimeWindow After(Instant from, double seconds) const;

 private:
  /// A velocity as seen from the frame, and its length.
  struct SeenVelocity {
    double v[3];
    double speed;
  };

  SeenVelocity Seen(const numeric::QuickBall& ball) const;
  PlacedBall AtBegin(const numeric::QuickBall& at) const;
  numeric::QuickBall BallAt(const HornTable& table, std::uint32_t agent) const {
    return BallAt(table.row(agent));
  }
  numeric::QuickBall BallAt(const HornRow& row) const {
    numeric::QuickBall at = HornTable::At(row, query_.from);
    if (query_.bound == intersection::BoundKind::kHypertrapezoid) at = BoxReach(at, duration_);
    return at;
  }

  intersection::BroadQuery query_;
  double duration_ = 0;  ///< Of a hypertrapezoid's window [s].
  double v_[3] = {};     ///< Of the frame [m/s].
  double window_ = 0, middle_ = 0;
  /// SphereFilter's slack for the way to the middle: of the speed, and beside it.
  float slack_ = 0, least_ = 0;
};

// From doubles to floats. Both functions below round up what they store:
// - HornTable::At() has given the reach 2^-48 of the terms of c; that covers the sums of doubles
//   here, which have fewer than sixteen terms, and the speed's 2^-50.
// - A conversion to single precision takes 2^-24 of the number, likewise the product after it:
//   kFloatUp. Where a second sum follows in single precision, 2^-20 stands for all of it.
// - SphereFilter asks for kFilterSlack of the reach and of the way, and for kReachLeast of both.

inline PlacementFrame::SeenVelocity PlacementFrame::Seen(const numeric::QuickBall& ball) const {
  SeenVelocity seen;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    seen.v[axis] = ball.v[axis] - v_[axis];
    square += seen.v[axis] * seen.v[axis];
  }
  seen.speed = std::sqrt(square);
  return seen;
}

inline PlacedBall PlacementFrame::AtBegin(const numeric::QuickBall& at) const {
  constexpr double kSlack = kFilterSlack, kLeast = kReachLeast, kUp = (1 + kSlack) * kFloatUp;
  constexpr double kSpeedUp = 1 + 0x1p-40;
  const SeenVelocity seen = Seen(at);
  PlacedBall horn;
  for (int axis = 0; axis < 3; ++axis) {
    horn.c[axis] = at.c[axis];
    horn.v[axis] = static_cast<float>(seen.v[axis]);
  }
  const double speed = seen.speed * kSpeedUp;
  horn.s0 = static_cast<float>((at.s0 + kLeast) * kUp);
  horn.s1 = static_cast<float>((at.s1 + kSlack * speed + kLeast) * kUp);
  const double bend = at.bends() ? Length(at.bend) * kSpeedUp : 0;
  horn.s2 = static_cast<float>((at.s2 + bend) * kUp);
  horn.s3 = static_cast<float>(at.s3 * kUp);
  horn.bend = static_cast<float>(bend * kUp);
  horn.speed = static_cast<float>(speed * kUp);
  horn.agent = PlacedBall::kNoAgent;
  return horn;
}

// A path that bends is off its tangent half-way by |bend| (½ last)² at most.
inline ReachPoint PlacementFrame::HalfWay(const numeric::QuickBall& given, double last) const {
  constexpr double kSlack = kFilterSlack, kLeast = kReachLeast, kUp = 1 + 0x1p-20;
  const double half = 0.5 * last;
  numeric::QuickBall at = given;
  if (given.bends()) {
    for (int axis = 0; axis < 3; ++axis) {
      at.c[axis] -= at.bend[axis] * half * half;
      at.v[axis] += at.bend[axis] * last;
    }
    at.s0 += Length(at.bend) * half * half + last * last * last * at.s3;
  }
  const SeenVelocity seen = Seen(at);
  ReachPoint point;
  for (int axis = 0; axis < 3; ++axis) {
    point.c[axis] = at.c[axis] + seen.v[axis] * half;
    point.v[axis] = static_cast<float>(seen.v[axis]);
  }
  const double way = half * seen.speed;
  const double own = (at.s0 + last * (at.s1 + last * at.s2)) * (1 + kSlack) + kSlack * way;
  point.own = static_cast<float>(own * kUp + kLeast * half);
  point.reach = static_cast<float>((own + way) * kUp + kLeast * half);
  return point;
}

}  // namespace collision::broad_phase
