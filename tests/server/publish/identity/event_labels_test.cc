// Goal:   a pair keeps what its agents are called until its slot is another pair's.
// Method: events of two pairs in one slot, of agents that the world does not know any more.
#include "server/publish/identity/event_labels.h"

#include <gtest/gtest.h>

#include "server/config/config.h"

namespace collision::server {
namespace {

detection::CollisionEvent Event(std::uint32_t lower, std::uint32_t higher) {
  detection::CollisionEvent event;
  event.pair_slot = 1;
  event.lower.slot = lower;
  event.higher.slot = higher;
  return event;
}

std::shared_ptr<const v1::AgentLabel> Label(const std::string& name) {
  v1::AgentLabel label;
  label.set_agent_name(name);
  return std::make_shared<const v1::AgentLabel>(label);
}

TEST(EventLabels, StayUntilTheSlotIsUsedAgain) {
  World world(CompleteConfig({}));
  const detection::CollisionEvent event = Event(1, 2);
  world.departed().Add(event.lower, Label("left"), Instant::FromNanoseconds(10));
  world.departed().Add(event.higher, Label("right"), Instant::FromNanoseconds(20));
  EventLabels labels;
  labels.Note(event, world);
  world.departed().ForgetUntil(Instant::FromNanoseconds(20));
  EXPECT_EQ(world.LabelOf(event.higher), nullptr);
  labels.Note(event, world);
  v1::CollisionEvent wire;
  AddLabels(labels.Of(event), &wire);
  EXPECT_EQ(wire.lower_label().agent_name(), "left");
  EXPECT_EQ(wire.higher_label().agent_name(), "right");
  labels.Note(Event(1, 3), world);
  EXPECT_EQ(labels.Of(event).lower, nullptr);
  EXPECT_EQ(labels.Of(Event(1, 3)).lower, nullptr);
}

TEST(DepartedAgents, AreForgottenInTheOrderOfTheirTimes) {
  DepartedAgents departed;
  const detection::AgentId early = Event(1, 2).lower, late = Event(1, 2).higher;
  departed.Add(late, Label("late"), Instant::FromNanoseconds(20));
  departed.Add(early, Label("early"), Instant::FromNanoseconds(10));
  departed.ForgetUntil(Instant::FromNanoseconds(19));
  EXPECT_EQ(departed.Find(early), nullptr);
  ASSERT_NE(departed.Find(late), nullptr);
  EXPECT_EQ(departed.Find(late)->agent_name(), "late");
}

}  // namespace
}  // namespace collision::server
