// The name of an agent, across the whole world.
#pragma once

#include <compare>
#include <cstdint>

namespace collision::detection {

/// A slot is reused with a new generation; a simulator that rewinds starts a higher run. The order
/// decides which agent of a pair is the lower one; normals point from lower to higher.
struct AgentId {
  std::uint64_t simulator = 0;
  std::uint32_t slot = 0;
  std::uint32_t run = 0;
  std::uint32_t generation = 0;

  friend constexpr auto operator<=>(const AgentId&, const AgentId&) = default;
};

/// One run of a simulator: what vouches, with its clock, for all of its agents at once.
struct OwnerId {
  std::uint64_t simulator = 0;
  std::uint32_t run = 0;

  friend constexpr auto operator<=>(const OwnerId&, const OwnerId&) = default;
};

constexpr OwnerId OwnerOf(const AgentId& id) { return {id.simulator, id.run}; }

}  // namespace collision::detection
