// What tells a hypothetical agent from a real one.
#pragma once

#include "collision_core/detection/agents/agent_declaration.h"

namespace collision::server {

/// The side of hypothetical agents in every filter: they never meet each other.
inline constexpr std::uint32_t kHypotheticalSide = 2;

/// The side of real agents where they are screened against hypothetical ones. Elsewhere they are of
/// no side.
inline constexpr std::uint32_t kRealSide = 1;

/// Whether the agent was declared as hypothetical.
inline bool IsHypothetical(const detection::AgentDeclaration& declaration) {
  return declaration.filter.side == kHypotheticalSide;
}

}  // namespace collision::server
