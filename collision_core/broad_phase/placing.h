// Where filters put an agent, and how far it reaches from there over a while.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision_core/broad_phase/approaching.h"
#include "collision_core/broad_phase/horn_table.h"
#include "collision_core/broad_phase/lane_scan.h"
#include "collision_core/broad_phase/point_grid.h"

namespace collision {

/// At u seconds after its placing's middle the agent's centre is at c + v u, as seen from the
/// placing's frame, and up to x seconds after the placing's begin all of it lies within
/// s0 + x (s1 + x s2) of there. Rounded outward, with the slack that LaneScan asks for.
struct PlacedHorn {
  double c[3];
  float v[3];
  float speed;  ///< |v|
  float s0, s1, s2;
  std::uint32_t agent;
};

/// The box around placed agents, and the most that any of them has.
struct PlacedExtent {
  double low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};
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

/// Of two horns at the begin. What single precision has taken is within the reaches' slack.
inline Approaching Between(const PlacedHorn& a, const PlacedHorn& b) {
  Approaching pair;
  for (int axis = 0; axis < 3; ++axis) {
    pair.d[axis] = b.c[axis] - a.c[axis];
    pair.w[axis] = static_cast<double>(b.v[axis]) - static_cast<double>(a.v[axis]);
  }
  pair.s0 = static_cast<double>(a.s0) + static_cast<double>(b.s0);
  pair.s1 = static_cast<double>(a.s1) + static_cast<double>(b.s1);
  pair.s2 = static_cast<double>(a.s2) + static_cast<double>(b.s2);
  return pair;
}

/// A stretch of time, in seconds after a placing's begin. It may begin earlier.
struct Stretch {
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

class Placing {
 public:
  Placing() = default;
  /// For stretches of the query up to `seconds_max`; how long they are at first is chosen so that
  /// few pairs come within reach of each other.
  Placing(const HornTable& table, const BroadQuery& query, double seconds_max);

  Instant begin() const { return query_.from; }
  /// Filters cannot reckon with the begin: all agents are to be asked directly.
  bool blind() const { return !HornTable::Near(query_.from); }
  BoundKind bound() const { return query_.bound; }
  /// The time ahead that was chosen [s].
  double window() const { return window_; }
  /// Looks less far ahead. Before anybody is at his middle.
  void Shorten(double seconds);

  /// About `count` of the agents that are placed, near each other: where to look for a first answer.
  Region Crowd(const HornTable& table, std::size_t count) const;

  PlacedHorn Place(const HornTable& table, std::uint32_t agent) const {
    PlacedHorn horn = AtBegin(table, agent);
    ToMiddle(&horn);
    return horn;
  }
  /// The same in two steps: where the agent is at the begin, and from there to the middle.
  PlacedHorn AtBegin(const HornTable& table, std::uint32_t agent) const;
  void ToMiddle(PlacedHorn* horn) const {
    for (int axis = 0; axis < 3; ++axis) {
      horn->c[axis] += static_cast<double>(horn->v[axis]) * middle_;
    }
    horn->s0 = (horn->s0 + horn->speed * slack_ + least_) * (1 + 0x1p-22f);
  }

  /// Of a horn at the begin: where it is half-way to `last` seconds later, and how far from there
  /// it reaches in between. Whatever the middle.
  ReachPoint HalfWay(const PlacedHorn& horn, double last) const {
    const auto half = static_cast<float>(0.5 * last) * (1 + 0x1p-22f), time = 2 * half;
    ReachPoint point;
    for (int axis = 0; axis < 3; ++axis) {
      point.c[axis] = horn.c[axis] + static_cast<double>(horn.v[axis]) * (0.5 * last);
    }
    point.reach =
        (horn.s0 + time * (horn.s1 + time * horn.s2) + half * horn.speed) * (1 + 0x1p-20f);
    return point;
  }

  /// So far from its place a horn comes during the stretch.
  template <typename Horn>
  double Reach(const Horn& horn, Stretch stretch) const {
    const double way = std::max(middle_ - stretch.first, stretch.last - middle_);
    return horn.s0 + stretch.last * (horn.s1 + stretch.last * horn.s2) + horn.speed * way;
  }
  double middle() const { return middle_; }

  /// The stretch of `seconds` after `from`, which may lie before the begin.
  Stretch After(Instant from, double seconds) const;

 private:
  BroadQuery query_;
  double duration_ = 0;  // of a hypertrapezoid's window
  double v_[3] = {};
  double window_ = 0, middle_ = 0;
  // LaneScan's, for the way to the middle: of the speed, and beside it.
  float slack_ = 0, least_ = 0;
};

// Up, by more than a conversion to single precision takes, and with LaneScan's slack.
inline PlacedHorn Placing::AtBegin(const HornTable& table, std::uint32_t agent) const {
  constexpr double kSlack = kLaneSlack, kLeast = kReachLeast;
  constexpr double kUp = (1 + kSlack) * (1 + 0x1p-22);
  HornAt at = table.At(agent, query_.from);
  PlacedHorn horn;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = at.v[axis] - v_[axis];
    horn.c[axis] = at.c[axis];
    horn.v[axis] = static_cast<float>(v);
    square += v * v;
  }
  const double speed = std::sqrt(square) * (1 + 0x1p-40);
  if (query_.bound == BoundKind::kHypertrapezoid) at = BoxReach(at, duration_);
  horn.s0 = static_cast<float>((at.s0 + kLeast) * kUp);
  horn.s1 = static_cast<float>((at.s1 + kSlack * speed + kLeast) * kUp);
  horn.s2 = static_cast<float>(at.s2 * kUp);
  horn.speed = static_cast<float>(speed * kUp);
  horn.agent = agent;
  return horn;
}

}  // namespace collision
