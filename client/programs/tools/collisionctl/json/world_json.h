// What is in a world, for programs: documents of kind "agents", "shapes" and "earliest", in one
// line each without a newline.
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// One agent, as AgentsJson() has it.
std::string AgentJson(const AgentView& agent, const WorldView& view);

/// All agents with their declaration, newest state and clearance, as far as they are known; in
/// "unknown" how many the service holds of simulators that are not heard.
std::string AgentsJson(const WorldView& view);

/// All shapes, as far as their parts have arrived.
std::string ShapesJson(const WorldView& view);

/// The pair that can touch first.
std::string EarliestJson(const WorldView& view);

}  // namespace collision::client
