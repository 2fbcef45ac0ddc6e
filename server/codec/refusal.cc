#include "server/codec/refusal.h"

#include "idl/limits.h"

namespace collision::server {

Refusal At(const v1::AgentDescription& wire) {
  return {.topic = v1::TOPIC_AGENT_DESCRIPTION,
          .simulator_id = wire.simulator_id(),
          .run = wire.run(),
          .slot = wire.slot(),
          .generation = wire.generation(),
          .incarnation = wire.incarnation()};
}

Refusal At(const v1::ShapePart& wire) {
  return {.topic = v1::TOPIC_SHAPE, .simulator_id = wire.simulator_id(), .run = wire.run()};
}

Refusal At(const v1::AgentStates& wire) {
  return {.topic = v1::TOPIC_AGENT_STATES,
          .simulator_id = wire.simulator_id(),
          .run = wire.run(),
          .incarnation = wire.incarnation()};
}

Refusal At(const v1::AgentStates& chunk, const v1::AgentState& wire) {
  Refusal refusal = At(chunk);
  refusal.slot = wire.slot();
  refusal.generation = wire.generation();
  return refusal;
}

Refusal At(const v1::SimulatorClock& wire) {
  return {.topic = v1::TOPIC_SIMULATOR_CLOCK,
          .simulator_id = wire.simulator_id(),
          .run = wire.run(),
          .incarnation = wire.incarnation()};
}

Refusal NotDescribed(const detection::AgentId& agent, std::string detail) {
  return {.reason = v1::REJECTED_NOT_DESCRIBED,
          .topic = v1::TOPIC_AGENT_STATES,
          .simulator_id = agent.simulator,
          .run = agent.run,
          .slot = agent.slot,
          .generation = agent.generation,
          .field = "generation",
          .detail = std::move(detail)};
}

Refusal Changed(const v1::AgentDescription& wire, std::string field, std::string detail) {
  Refusal refusal = At(wire);
  refusal.reason = v1::REJECTED_OUT_OF_RANGE;
  refusal.field = std::move(field);
  refusal.detail = std::move(detail);
  return refusal;
}

Refusal NoRoom(const detection::AgentId& agent, std::string detail) {
  return {.reason = v1::REJECTED_TOO_MANY_AGENTS,
          .topic = v1::TOPIC_AGENT_DESCRIPTION,
          .simulator_id = agent.simulator,
          .run = agent.run,
          .slot = agent.slot,
          .generation = agent.generation,
          .field = "slot",
          .detail = std::move(detail)};
}

Refusal NotItsOwn(const v1::AgentRemoval& wire) {
  return {.reason = v1::REJECTED_ID_OWNED,
          .topic = v1::TOPIC_AGENT_DESCRIPTION,
          .simulator_id = wire.simulator_id(),
          .slot = wire.slot(),
          .incarnation = wire.incarnation(),
          .field = "simulator_id",
          .detail = "a removal by another sender; allowed: by its owner"};
}

Refusal NotItsOwn(const v1::ShapeRemoval& wire) {
  return {.reason = v1::REJECTED_ID_OWNED,
          .topic = v1::TOPIC_SHAPE,
          .simulator_id = wire.simulator_id(),
          .field = "simulator_id",
          .detail = "a removal by another sender; allowed: by its owner"};
}

Refusal ShapeRefusal(const detection::AgentId& agent, v1::InputTopic topic, std::string field,
                     const std::string& detail) {
  return {.reason = v1::REJECTED_BAD_SHAPE,
          .topic = topic,
          .simulator_id = agent.simulator,
          .run = agent.run,
          .slot = agent.slot,
          .generation = agent.generation,
          .field = std::move(field),
          .detail = detail.substr(0, wire::kRefusalDetailMax)};
}

}  // namespace collision::server
