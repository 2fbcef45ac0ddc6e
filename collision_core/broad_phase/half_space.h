// Everything on one side of a plane: a floor, a wall, without end.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/intersection/intersection_query.h"
#include "collision_core/numeric/moving_ball.h"

namespace collision::broad_phase {

/// All x with normal·x <= offset, in the world frame. It never moves and never expires, and meets
/// only agents that move. The normal need not have length 1: the numbers are taken as exact.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Points out of it.
  double offset = 0;                                  ///< [m], times the normal's length.
  CollisionFilter filter{};
};

/// Whether the filters let the two meet, and the agent can move.
bool CanMeet(const HalfSpace& half_space, const AgentBound& bound);

/// When the agent may first touch the half-space, or come within `margin` [m] of it, by the query's
/// end, rounded down; +infinity: not within it. With n the normal and c(t), ρ(t) centre and radius
/// of the agent's ball, that is the first t at or after max(from, stamp) with
///
///   n·c(t) − offset − |n| (ρ(t) + margin) <= 0,
///
/// a quadratic in t with one certified first zero, so no tangents are needed. It holds for the
/// horn's ball and, where a speed cap is declared, for the capped ball (speed_cap.h): the later
/// counts. A direction changes nothing. Never late; early by what the inputs' rounding forces. If
/// something overflows, the answer is "at once". Both kinds of bound give the same answer.
intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HalfSpace& half_space,
                                                      const AgentBound& bound, double margin = 0);

/// Half-spaces by their own indices. They are few, so each is asked about all agents that move: a
/// query about one agent costs one test (about 25 ns) per half-space, a query about all agents one
/// per agent and half-space.
class HalfSpaces {
 public:
  /// The most half-spaces; Set() refuses more.
  static constexpr std::size_t kCountMax = 64;

  /// The greatest component of a normal lies between these, so that squares and products with
  /// lengths stay in range.
  static constexpr double kNormalMin = 1e-100, kNormalMax = 1e100;

  /// A half-space that is held, and the index under which partners see it.
  struct Entry {
    std::uint32_t agent;
    HalfSpace half_space;
    double length;  ///< Of the normal, rounded up.
  };

  /// Adds or replaces a half-space. Returns false, and changes nothing, for a normal out of range,
  /// an offset that is not finite, or if there is no more room.
  bool Set(std::uint32_t agent, const HalfSpace& half_space);
  /// Returns whether it was there.
  bool Remove(std::uint32_t agent);

  /// Null if there is no half-space of that index.
  const Entry* Find(std::uint32_t agent) const;
  std::size_t size() const { return entries_.size(); }
  /// In the order of indices.
  std::vector<Entry>::const_iterator begin() const { return entries_.begin(); }
  std::vector<Entry>::const_iterator end() const { return entries_.end(); }

 private:
  std::vector<Entry> entries_;
};

/// A filter in plain doubles: false if the agent certainly stays out of reach for `limit` seconds
/// after the instant of `horn`, so that EarliestIntersectionOf() is later. The gap is concave, so
/// it looks at both ends of the time ahead.
bool MayReach(const HalfSpaces::Entry& entry, const numeric::QuickBall& horn, double margin,
              double limit);

}  // namespace collision::broad_phase
