// Why something that arrived was not accepted.
#pragma once

#include <cstdint>
#include <string>

#include "collision_core/detection/agent_id.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// One refusal: what, where, and what would have been allowed. Nothing beside it is affected.
struct Refusal {
  v1::RejectionReason reason = v1::REJECTED_NOT_FINITE;
  v1::Topic topic = v1::TOPIC_AGENT_DESCRIPTION;
  std::uint64_t simulator_id = 0;
  std::uint32_t run = 0;
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;
  std::string field = {};   ///< Name as in collision.idl; at most 64 characters.
  std::string detail = {};  ///< The value and the allowed range; at most 256 characters.
};

/// Where a refusal of this message points; the reason is still to be set.
Refusal At(const v1::AgentDescription& wire);
Refusal At(const v1::ShapePart& wire);
Refusal At(const v1::AgentStates& wire);
Refusal At(const v1::AgentStates& chunk, const v1::AgentState& wire);
Refusal At(const v1::SimulatorClock& wire);

/// A state of an agent that nothing has described.
Refusal NotDescribed(const detection::AgentId& agent, std::string detail);

/// A complete agent for which there is no room.
Refusal NoRoom(const detection::AgentId& agent, std::uint32_t agents_max);

/// A removal that does not come from the owner.
Refusal NotItsOwn(const v1::AgentRemoval& wire);
Refusal NotItsOwn(const v1::ShapeRemoval& wire);

/// What the owner of an agent is told of its shape; of an agent that refers to it, or of none.
Refusal ShapeRefusal(const detection::AgentId& agent, v1::Topic topic, std::string field,
                     std::string detail);

/// Texts on the wire are bounded.
inline constexpr std::size_t kDetailMax = 256;

}  // namespace collision::server
