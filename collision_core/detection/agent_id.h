// Who an agent is, across the whole world.
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

}  // namespace collision::detection
