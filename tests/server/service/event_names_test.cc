// Goal:   every event says what its agents are called: after a new description by the new name, and
//         after an agent has left by the last one.
// Method: two simulators whose balls fly at each other, step by step; one leaves in mid-contact.
#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kStep = 10'000'000;  // [ns] Shorter than what is granted in contact.

/// A ball on each side, 1 m in radius, which touch from 1.5 s on.
class EventNamesTest : public testing::Test {
 protected:
  EventNamesTest() : daemon_(OfTwoSimulators(v1::Clock::WAIT)) {
    for (const char* name : {"alpha", "beta"}) {
      v1::AgentDescription description = Description(name, 0);
      description.set_assembly(std::string("arm of ") + name);
      v1::Tag& tag = *description.add_tags();
      tag.set_key("kind");
      tag.set_value("ball");
      daemon_.Step({From(SenderOf(name), description)});
    }
  }

  static std::uint64_t SenderOf(const std::string& name) { return name == "alpha" ? 1 : 2; }

  std::vector<v1::Input> At(const std::string& name, int step) const {
    const double side = name == "alpha" ? -1 : 1;
    const auto sequence = static_cast<std::uint64_t>(step) + 1;
    v1::AgentState state = State(0, step * kStep, sequence);
    state.mutable_position_m()->set_x(side * (2.5 - 0.01 * step));
    state.mutable_velocity_m_s()->set_x(-side);
    return {From(SenderOf(name), state, name),
            From(SenderOf(name), ClockAfter(name, step * kStep, sequence, 1))};
  }

  void Fly(int from, int to) {
    for (int step = from; step <= to; ++step) {
      daemon_.Step(At("alpha", step), 0.01);
      daemon_.Step(At("beta", step), 0.01);
    }
  }

  std::vector<v1::CollisionEvent> Events() const {
    std::vector<v1::CollisionEvent> events;
    for (const v1::Output& output : daemon_.bus().outputs) {
      if (output.has_collision_event()) events.push_back(output.collision_event());
    }
    return events;
  }

  /// What the event calls the agent of this simulator.
  static v1::AgentLabel LabelOf(const v1::CollisionEvent& event, const std::string& simulator) {
    const bool is_lower = event.lower().simulator_id() == SimulatorId(simulator);
    return is_lower ? event.lower_label() : event.higher_label();
  }

  mutable ScriptedDaemon daemon_;
};

TEST_F(EventNamesTest, StandInEveryEvent) {
  Fly(0, 200);
  const std::vector<v1::CollisionEvent> events = Events();
  ASSERT_GE(events.size(), 2u);
  for (const v1::CollisionEvent& event : events) {
    for (const char* name : {"alpha", "beta"}) {
      const v1::AgentLabel label = LabelOf(event, name);
      EXPECT_EQ(label.simulator_name(), name);
      EXPECT_EQ(label.agent_name(), "agent 0");
      EXPECT_EQ(label.assembly(), std::string("arm of ") + name);
      ASSERT_EQ(label.tags_size(), 1);
      EXPECT_EQ(label.tags(0).key() + "=" + label.tags(0).value(), "kind=ball");
    }
  }
}

TEST_F(EventNamesTest, OutlastTheirAgents) {
  Fly(0, 200);
  ASSERT_EQ(Events().back().status(), v1::EVENT_CONFIRMED);
  daemon_.Step({Removal(2, "beta", 0)}, 0.01);
  daemon_.Step(At("alpha", 201), 0.01);
  daemon_.Step({From(2, ClockAfter("beta", 201 * kStep, 201, 1))}, 0.01);
  daemon_.Step(At("alpha", 202), 0.01);
  daemon_.Step({From(2, ClockAfter("beta", 202 * kStep, 201, 1))}, 0.01);
  const v1::CollisionEvent last = Events().back();
  ASSERT_EQ(last.status(), v1::EVENT_ENDED);
  EXPECT_EQ(LabelOf(last, "beta").agent_name(), "agent 0");
  EXPECT_EQ(LabelOf(last, "beta").assembly(), "arm of beta");
}

TEST_F(EventNamesTest, FollowTheNewestDescription) {
  Fly(0, 50);
  v1::AgentDescription renamed = Description("beta", 0);
  renamed.set_revision(2);
  renamed.set_sequence(2);
  renamed.set_agent_name("renamed");
  daemon_.Step({From(2, renamed)}, 0.01);
  Fly(51, 200);
  EXPECT_EQ(LabelOf(Events().back(), "beta").agent_name(), "renamed");
}

}  // namespace
}  // namespace collision::server
