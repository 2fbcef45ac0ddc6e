// Goal:   a refusal names the message that it is about and nothing more, and fits the wire.
// Method: every way to make one, from messages whose numbers all differ.
#include "server/codec/refusal.h"

#include <gtest/gtest.h>

#include "idl/limits.h"
#include "tests/server/messages.h"

namespace collision::server {
namespace {

constexpr detection::AgentId kAgent{.simulator = 11, .slot = 13, .run = 12, .generation = 14};

void ExpectNamesTheAgent(const Refusal& refusal) {
  EXPECT_EQ(refusal.simulator_id, 11u);
  EXPECT_EQ(refusal.run, 12u);
  EXPECT_EQ(refusal.slot, 13u);
  EXPECT_EQ(refusal.generation, 14u);
}

TEST(Refusal, OfADescriptionNamesItsAgent) {
  v1::AgentDescription wire;
  wire.set_simulator_id(11);
  wire.set_run(12);
  wire.set_slot(13);
  wire.set_generation(14);
  ExpectNamesTheAgent(At(wire));
  EXPECT_EQ(At(wire).topic, v1::TOPIC_AGENT_DESCRIPTION);
}

TEST(Refusal, OfAStateTakesTheSlotFromTheStateAndTheRestFromTheChunk) {
  v1::AgentStates chunk;
  chunk.set_simulator_id(11);
  chunk.set_run(12);
  v1::AgentState state;
  state.set_slot(13);
  state.set_generation(14);
  ExpectNamesTheAgent(At(chunk, state));
  EXPECT_EQ(At(chunk, state).topic, v1::TOPIC_AGENT_STATES);
  EXPECT_EQ(At(chunk).slot, 0u);
  EXPECT_EQ(At(chunk).generation, 0u);
}

TEST(Refusal, OfAClockOrAPartNamesTheRunAndNoSlot) {
  v1::SimulatorClock clock = ClockOf("a", 5, 12);
  EXPECT_EQ(At(clock).topic, v1::TOPIC_SIMULATOR_CLOCK);
  EXPECT_EQ(At(clock).simulator_id, SimulatorId("a"));
  EXPECT_EQ(At(clock).run, 12u);
  v1::ShapePart part;
  part.set_simulator_id(11);
  part.set_run(12);
  EXPECT_EQ(At(part).topic, v1::TOPIC_SHAPE);
  EXPECT_EQ(At(part).simulator_id, 11u);
  EXPECT_EQ(At(part).run, 12u);
}

TEST(Refusal, OfAnAgentNamesReasonAndField) {
  const Refusal unknown = NotDescribed(kAgent, "why");
  ExpectNamesTheAgent(unknown);
  EXPECT_EQ(unknown.reason, v1::REJECTED_NOT_DESCRIBED);
  EXPECT_EQ(unknown.topic, v1::TOPIC_AGENT_STATES);
  EXPECT_EQ(unknown.detail, "why");
  const Refusal full = NoRoom(kAgent, "allowed: at most 1000");
  ExpectNamesTheAgent(full);
  EXPECT_EQ(full.reason, v1::REJECTED_TOO_MANY_AGENTS);
  EXPECT_NE(full.detail.find("at most 1000"), std::string::npos);
}

TEST(Refusal, OfARemovalNamesTheTopicOfWhatItRemoves) {
  v1::AgentRemoval agent;
  agent.set_simulator_id(11);
  agent.set_slot(13);
  EXPECT_EQ(NotItsOwn(agent).reason, v1::REJECTED_ID_OWNED);
  EXPECT_EQ(NotItsOwn(agent).topic, v1::TOPIC_AGENT_DESCRIPTION);
  EXPECT_EQ(NotItsOwn(agent).slot, 13u);
  v1::ShapeRemoval shape;
  shape.set_simulator_id(11);
  EXPECT_EQ(NotItsOwn(shape).reason, v1::REJECTED_ID_OWNED);
  EXPECT_EQ(NotItsOwn(shape).topic, v1::TOPIC_SHAPE);
}

TEST(Refusal, OfAShapeIsCutToWhatTheWireCarries) {
  const std::string fits(wire::kRefusalDetailMax, 'x');
  const Refusal refusal = ShapeRefusal(kAgent, v1::TOPIC_SHAPE, "bytes", fits + "y");
  ExpectNamesTheAgent(refusal);
  EXPECT_EQ(refusal.reason, v1::REJECTED_BAD_SHAPE);
  EXPECT_EQ(refusal.field, "bytes");
  EXPECT_EQ(refusal.detail, fits);
  EXPECT_EQ(ShapeRefusal(kAgent, v1::TOPIC_SHAPE, "bytes", fits).detail, fits);
}

}  // namespace
}  // namespace collision::server
