// From a name that a person types to an agent of the world.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// The name fits no agent, or several; the text says which there are.
class NoSuchAgent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The newest event of the pair that has come, and is taken from the view; nullopt: there is none.
std::optional<v1::CollisionEvent> NewestOf(const AgentId& a, const AgentId& b, WorldView* view);

/// The agent called "agent" or "simulator:agent". Throws NoSuchAgent.
AgentView FindAgent(const WorldView& view, const std::string& name);

}  // namespace collision::client
