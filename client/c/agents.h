// The agents of a world under numbers, for C programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "collision/collision.h"
#include "collision/world.h"

namespace collision::client::c {

/// A number is a place, which is used again, and how often it was used, so that no number means two
/// agents one after the other.
class NumberedAgents {
 public:
  collision_agent Add(Agent agent);

  /// These throw std::invalid_argument, "agent: number, allowed: ...", if there is none of this
  /// number.
  Agent& At(collision_agent number);
  const Agent& At(collision_agent number) const;
  void Remove(collision_agent number);

 private:
  struct Place {
    std::uint32_t use = 0;
    std::optional<Agent> agent;
  };

  std::vector<Place> places_;
  std::vector<std::uint32_t> free_;
};

}  // namespace collision::client::c
