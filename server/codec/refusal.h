// Why a message, or a part of one, is not accepted.
#pragma once

#include <cstdint>
#include <string>

#include "collision_core/detection/events/agent_id.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// What was refused, where, and what would have been allowed.
struct Refusal {
  v1::RejectionReason reason = v1::REJECTED_NOT_FINITE;
  v1::InputTopic topic = v1::TOPIC_AGENT_DESCRIPTION;
  std::uint64_t simulator_id = 0;
  std::uint32_t run = 0;
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;
  std::uint32_t incarnation = 0;  ///< Of the sender, if its message says.
  std::string field = {};         ///< Name as in collision.idl; at most 64 characters.
  std::string detail = {};        ///< The value and the allowed range; at most 256 characters.
};

/// A refusal of this message, without its reason.
Refusal At(const v1::AgentDescription& wire);
Refusal At(const v1::ShapePart& wire);
Refusal At(const v1::AgentStates& wire);
Refusal At(const v1::AgentStates& chunk, const v1::AgentState& wire);
Refusal At(const v1::SimulatorClock& wire);

/// Refuses a state whose agent has no description.
Refusal NotDescribed(const detection::AgentId& agent, std::string detail);

/// Refuses a complete agent for which there is no room.
Refusal NoRoom(const detection::AgentId& agent, std::string detail);

/// Refuses a description that would change what an agent keeps for good.
Refusal Changed(const v1::AgentDescription& wire, std::string field, std::string detail);

/// Refuses a removal that does not come from the owner.
Refusal NotItsOwn(const v1::AgentRemoval& wire);
Refusal NotItsOwn(const v1::ShapeRemoval& wire);

/// Refuses a shape: for an agent that refers to it, or for a simulator that wrote it (`agent` then
/// names no slot). `detail` is cut to what the wire carries.
Refusal ShapeRefusal(const detection::AgentId& agent, v1::InputTopic topic, std::string field,
                     const std::string& detail);

}  // namespace collision::server
