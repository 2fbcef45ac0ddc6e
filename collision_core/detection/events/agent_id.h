// The name of an agent, across the whole world.
#pragma once

#include <compare>
#include <cstdint>

namespace collision::detection {

/// Names one agent for all time: a slot is reused with a new generation, and a simulator that
/// rewinds starts a higher run. The order of the ids makes one agent of a pair the lower one;
/// normals point from the lower to the higher one.
struct AgentId {
  std::uint64_t simulator = 0;
  std::uint32_t slot = 0;
  std::uint32_t run = 0;
  std::uint32_t generation = 0;

  friend constexpr auto operator<=>(const AgentId&, const AgentId&) = default;
};

/// Names an owner: one run of a simulator, whose clock stamps the states of all its agents and
/// which reports up to when they are complete (Detector::SetHeardUntil).
struct OwnerId {
  std::uint64_t simulator = 0;
  std::uint32_t run = 0;

  friend constexpr auto operator<=>(const OwnerId&, const OwnerId&) = default;
};

constexpr OwnerId OwnerOf(const AgentId& id) { return {id.simulator, id.run}; }

}  // namespace collision::detection
