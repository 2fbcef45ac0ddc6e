// Where filters put an agent, and how far it reaches from there over a while.
#pragma once

#include <algorithm>

#include "collision_core/broad_phase/horn_table.h"

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

/// A stretch of time, in seconds after a placing's begin. It may begin earlier.
struct Stretch {
  double first, last;
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

  PlacedHorn Place(const HornTable& table, std::uint32_t agent) const;

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
  double v_[3] = {};
  double window_ = 0, middle_ = 0;
};

}  // namespace collision
