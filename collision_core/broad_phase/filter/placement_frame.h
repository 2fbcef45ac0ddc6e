// Where filters put an agent, and how far it reaches from there during a window.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/broad_phase/filter/pair_filter.h"
#include "collision_core/broad_phase/filter/point_grid.h"
#include "collision_core/broad_phase/filter/sphere_filter.h"

namespace collision::broad_phase {

/// At u seconds after its placing's middle the agent's centre is at c + v u, as seen from the
/// placing's frame, and up to x seconds after the placing's begin all of it lies within
/// s0 + x (s1 + x s2) of there. Rounded outward, with the slack that SphereFilter asks for.
struct PlacedHorn {
  double c[3];
  float v[3];
  float speed;  ///< |v|
  float s0, s1, s2;
  std::uint32_t agent;

  /// Of a horn that belongs to no agent: one that a question is asked about.
  static constexpr std::uint32_t kNoAgent = ~0u;
};

/// The box around placed agents, and the greatest reach coefficients and speed of any of them.
struct PlacedExtent {
  double low[3] = {numeric::kInfinity, numeric::kInfinity, numeric::kInfinity},
         high[3] = {-numeric::kInfinity, -numeric::kInfinity, -numeric::kInfinity};
  float s0 = 0, s1 = 0, s2 = 0, speed = 0;

  void Add(const PlacedHorn& horn) {
    s0 = std::max(s0, horn.s0), s1 = std::max(s1, horn.s1), s2 = std::max(s2, horn.s2);
    speed = std::max(speed, horn.speed);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], horn.c[axis]);
      high[axis] = std::max(high[axis], horn.c[axis]);
    }
  }
};

/// A stretch of time, in seconds after a placing's begin. It may begin earlier.
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

/// A common begin, a frame that moves with the agents on the average, and a middle: over a stretch
/// of time an agent is never farther from where it is placed than half its way, and its reach.
/// Windows are not shorter [s], and beyond the longest every instant is Never().
inline constexpr double kWindowMin = 1e-9;
inline constexpr double kWindowMax = 2e10;

/// Where filters put agents: a common begin, a frame that moves with the average of all agents, and
/// a middle of the window. Over a stretch of time an agent is never farther from where it is placed
/// than half its way and its reach.
class PlacementFrame {
 public:
  /// Places nothing.
  PlacementFrame() = default;
  /// For stretches of the query up to `seconds_max`; how long they are at first is chosen so that
  /// few pairs come within reach of each other.
  PlacementFrame(const HornTable& table, const intersection::BroadQuery& query, double seconds_max);

  Instant begin() const { return query_.from; }
  /// The begin is too far away for filters: all agents are asked directly.
  bool blind() const { return !HornTable::Near(query_.from); }
  intersection::BoundKind bound() const { return query_.bound; }
  /// The time ahead that was chosen [s].
  double window() const { return window_; }
  /// Looks less far ahead. Requires that no agent was moved to its middle.
  void Shorten(double seconds);

  /// About `count` of the agents that are placed, near each other: where to look for a first
  /// answer.
  Region Crowd(const HornTable& table, std::size_t count) const;

  PlacedHorn Place(const HornTable& table, std::uint32_t agent) const {
    PlacedHorn horn = AtBegin(table, agent);
    ToMiddle(&horn);
    return horn;
  }
  /// The same in two steps: where the agent is at the begin, and from there to the middle.
  PlacedHorn AtBegin(const HornTable& table, std::uint32_t agent) const {
    PlacedHorn horn = AtBegin(BallAt(table, agent));
    horn.agent = agent;
    return horn;
  }
  /// The horn of a row that is in no table, as Place(); of no agent (PlacedHorn::kNoAgent).
  PlacedHorn Place(const HornRow& row) const {
    PlacedHorn horn = AtBegin(BallAt(row));
    ToMiddle(&horn);
    return horn;
  }
  void ToMiddle(PlacedHorn* horn) const {
    for (int axis = 0; axis < 3; ++axis) {
      horn->c[axis] += static_cast<double>(horn->v[axis]) * middle_;
    }
    horn->s0 = (horn->s0 + horn->speed * slack_ + least_) * (1 + 0x1p-22f);
  }

  /// The relative motion of two agents from the begin on.
  numeric::QuickBall DifferenceOf(const HornTable& table, std::uint32_t a, std::uint32_t b) const {
    return Difference(BallAt(table, a), BallAt(table, b));
  }

  /// Where an agent is half-way to `last` seconds after the begin, and how far from there it
  /// reaches in between; it does not depend on the middle.
  ReachPoint HalfWay(const HornTable& table, std::uint32_t agent, double last) const {
    return HalfWay(BallAt(table, agent), last);
  }
  ReachPoint HalfWay(const numeric::QuickBall& at, double last) const;

  /// How far from its place a horn comes during the stretch.
  template <typename Horn>
  double Reach(const Horn& horn, TimeWindow stretch) const {
    const double way = std::max(middle_ - stretch.first, stretch.last - middle_);
    return horn.s0 + stretch.last * (horn.s1 + stretch.last * horn.s2) + horn.speed * way;
  }
  double middle() const { return middle_; }

  /// The stretch of `seconds` after `from`, which may lie before the begin.
  TimeWindow After(Instant from, double seconds) const;

 private:
  PlacedHorn AtBegin(const numeric::QuickBall& at) const;
  numeric::QuickBall BallAt(const HornTable& table, std::uint32_t agent) const {
    return BallAt(table.row(agent));
  }
  numeric::QuickBall BallAt(const HornRow& row) const {
    numeric::QuickBall at = HornTable::At(row, query_.from);
    if (query_.bound == intersection::BoundKind::kHypertrapezoid) at = BoxReach(at, duration_);
    return at;
  }

  intersection::BroadQuery query_;
  double duration_ = 0;  // of a hypertrapezoid's window
  double v_[3] = {};
  double window_ = 0, middle_ = 0;
  // SphereFilter's, for the way to the middle: of the speed, and beside it.
  float slack_ = 0, least_ = 0;
};

// Up, by more than a conversion to single precision takes, and with SphereFilter's slack.
inline PlacedHorn PlacementFrame::AtBegin(const numeric::QuickBall& at) const {
  constexpr double kSlack = kFilterSlack, kLeast = kReachLeast;
  constexpr double kUp = (1 + kSlack) * (1 + 0x1p-22);
  PlacedHorn horn;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = at.v[axis] - v_[axis];
    horn.c[axis] = at.c[axis];
    horn.v[axis] = static_cast<float>(v);
    square += v * v;
  }
  const double speed = std::sqrt(square) * (1 + 0x1p-40);
  horn.s0 = static_cast<float>((at.s0 + kLeast) * kUp);
  horn.s1 = static_cast<float>((at.s1 + kSlack * speed + kLeast) * kUp);
  horn.s2 = static_cast<float>(at.s2 * kUp);
  horn.speed = static_cast<float>(speed * kUp);
  horn.agent = PlacedHorn::kNoAgent;
  return horn;
}

// At() has given the reach 2^-48 of the terms of c, which covers this sum's rounding as well; all
// else loses less than 2^-20 of the way and the reach. SphereFilter's slack is added.
inline ReachPoint PlacementFrame::HalfWay(const numeric::QuickBall& at, double last) const {
  constexpr double kSlack = kFilterSlack, kLeast = kReachLeast, kUp = 1 + 0x1p-20;
  const double half = 0.5 * last;
  ReachPoint point;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = at.v[axis] - v_[axis];
    point.c[axis] = at.c[axis] + v * half;
    point.v[axis] = static_cast<float>(v);
    square += v * v;
  }
  const double way = half * std::sqrt(square);
  const double own = (at.s0 + last * (at.s1 + last * at.s2)) * (1 + kSlack) + kSlack * way;
  point.own = static_cast<float>(own * kUp + kLeast * half);
  point.reach = static_cast<float>((own + way) * kUp + kLeast * half);
  return point;
}

}  // namespace collision::broad_phase
