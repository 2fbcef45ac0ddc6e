// Who could meet whom: the interface of every method.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "collision_core/broad_phase/pair_time.h"

namespace collision {

/// One possible meeting of the agent asked about.
struct Meeting {
  std::uint32_t partner;
  PairTime time;
};

/// Holds the bounds of all agents by index and finds their earliest meetings. Methods differ in
/// cost, never in what they answer: each value is EarliestIntersection() of the two bounds, bit for
/// bit.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  /// Adds the agent, or replaces its bound.
  virtual void Put(std::uint32_t agent, const SpaceTimeBound& bound) = 0;
  virtual void Remove(std::uint32_t agent) = 0;

  /// Appends each partner that `agent` may first meet, at or after `from`, by `until`, and of the
  /// later meetings at least the earliest. Partners for which `skip` holds are left out.
  virtual void Meetings(std::uint32_t agent, Instant from, Instant until,
                        const std::function<bool(std::uint32_t)>& skip,
                        std::vector<Meeting>* meetings) const = 0;

  /// Pairs given to the canonical routine so far.
  virtual std::uint64_t pair_queries() const = 0;
};

}  // namespace collision
