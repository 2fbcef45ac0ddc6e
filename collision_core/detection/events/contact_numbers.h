// The ordinal of each contact of a pair.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/base/ids.h"

namespace collision::detection {

/// Numbers the contacts of each pair from 1. A pair's numbers go on after it is no longer tracked,
/// so that an event's name is never used twice. Memory: at most kPartnersMax partners an agent.
///
/// Beyond that limit the table drops the number of the partner whose last contact is the oldest. If
/// the two meet again, their numbers continue above every number dropped so far, so that no number
/// is used twice.
class ContactNumbers {
 public:
  /// Partners of one agent whose numbers are kept one by one.
  static constexpr std::size_t kPartnersMax = 1024;

  /// The number of the next contact of the two. Symmetric. Requires a != b.
  std::uint32_t Next(AgentIndex a, AgentIndex b);

  /// Forgets the numbers of all pairs of an agent that has left; its index may be reused.
  void Forget(AgentIndex agent);

  /// Walks all numbers: each is kept with both agents of its pair.
  void Validate() const;

 private:
  struct Number {
    AgentIndex partner;
    std::uint32_t last;
  };
  struct OfAgent {
    std::vector<Number> known;   // the pair with the latest contact stands last
    std::uint32_t given_up = 0;  // no number given up was higher
  };

  std::uint32_t Take(AgentIndex agent, AgentIndex partner);
  void Record(AgentIndex agent, AgentIndex partner, std::uint32_t number);

  IndexedVector<AgentIndex, OfAgent> agents_;
};

}  // namespace collision::detection
