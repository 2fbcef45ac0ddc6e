// Goal:   a Monitor hands on everything that its network receives, as plain values.
// Method: messages with a different value in every field, on a network under the test's control.
#include "collision/monitor.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/library/network/transport.h"
#include "tests/client/fake_receiver.h"

namespace collision::client {
namespace {

using std::chrono::nanoseconds;

void SetId(v1::AgentId* id, std::uint32_t slot) {
  id->set_simulator_id(5);
  id->set_run(7);
  id->set_slot(slot);
  id->set_generation(3);
}

constexpr AgentId IdOf(std::uint32_t slot) { return {5, 7, slot, 3}; }

class MonitorTest : public testing::Test {
 protected:
  std::size_t Poll(const Monitor::Callbacks& callbacks) {
    return Monitor(std::make_unique<FakeReceiver>(&next_), callbacks).Poll(nanoseconds(0));
  }

  Arrivals next_;
};

TEST_F(MonitorTest, AnEventArrivesWithAllItsFields) {
  auto* message = next_.outputs.emplace_back().mutable_collision_event();
  SetId(message->mutable_lower(), 1);
  SetId(message->mutable_higher(), 2);
  message->set_status(v1::EVENT_ENDED);
  message->set_contacts_sequence(9);
  message->set_limited_by(v1::LIMIT_GEOMETRY);
  message->mutable_begin()->set_earliest_ns(10);
  message->mutable_end()->set_latest_ns(20);
  message->mutable_proximity()->set_at_ns(15);
  message->mutable_proximity()->mutable_separation_m()->set_lower(-2);
  message->mutable_proximity()->mutable_separation_m()->set_upper(-1);
  std::vector<Event> events;
  EXPECT_EQ(Poll({.event = [&](const Event& event) { events.push_back(event); }}), 1u);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].lower, IdOf(1));
  EXPECT_EQ(events[0].higher, IdOf(2));
  EXPECT_EQ(events[0].status, EventStatus::kEnded);
  EXPECT_EQ(events[0].contacts_sequence, 9u);
  EXPECT_EQ(events[0].limited_by, EventLimit::kGeometry);
  EXPECT_EQ(events[0].begin.earliest_ns, 10);
  EXPECT_EQ(events[0].end.latest_ns, 20);
  EXPECT_EQ(events[0].proximity->at_ns, 15);
  EXPECT_EQ(events[0].proximity->separation_lower_m, -2);
  EXPECT_EQ(events[0].proximity->separation_upper_m, -1);
}

TEST_F(MonitorTest, ABreachArrivesWithAllItsFields) {
  auto* message = next_.outputs.emplace_back().mutable_agent_breach();
  message->set_simulator_id(5);
  message->set_run(7);
  message->set_slot(1);
  message->set_generation(3);
  message->set_field("speed_max_m_s");
  message->set_declared(2);
  message->set_seen(2.5);
  message->set_from_ns(10);
  message->set_at_ns(20);
  message->set_count(4);
  std::vector<Breach> breaches;
  EXPECT_EQ(Poll({.breach = [&](const Breach& breach) { breaches.push_back(breach); }}), 1u);
  ASSERT_EQ(breaches.size(), 1u);
  EXPECT_EQ(breaches[0].agent, IdOf(1));
  EXPECT_EQ(breaches[0].field, "speed_max_m_s");
  EXPECT_EQ(breaches[0].declared, 2);
  EXPECT_EQ(breaches[0].seen, 2.5);
  EXPECT_EQ(breaches[0].from_ns, 10);
  EXPECT_EQ(breaches[0].at_ns, 20);
  EXPECT_EQ(breaches[0].count, 4u);
}

TEST(Conversion, WhatAnEventDoesNotTellIsAbsent) {
  const Event event = FromMessage(v1::CollisionEvent());
  EXPECT_FALSE(event.proximity || event.expected || event.closest);
  EXPECT_FALSE(event.lower_state || event.higher_state);
  v1::CollisionEvent evaluated;
  evaluated.mutable_proximity()->set_at_ns(15);
  const Proximity proximity = FromMessage(evaluated).proximity.value();
  EXPECT_FALSE(proximity.normal || proximity.relative_velocity);
  EXPECT_FALSE(proximity.lower_part || proximity.higher_part);
}

TEST_F(MonitorTest, TheStatusArrivesWithSimulatorsAndCounters) {
  auto* message = next_.outputs.emplace_back().mutable_service_status();
  message->mutable_stamp()->set_term(2);
  message->set_phase(v1::PHASE_SERVING);
  message->set_world("lab");
  message->add_left_out("rotation");
  message->set_cpu_us(12);
  auto* histogram = message->add_histograms();
  histogram->set_name("step_us");
  histogram->add_counts(3);
  histogram->add_counts(4);
  auto* counter = message->add_counters();
  counter->set_name("queries");
  counter->set_value(9);
  auto* simulator = message->add_simulators();
  simulator->set_name("sim");
  simulator->set_granted_until_ns(11);
  ServiceStatus status;
  EXPECT_EQ(Poll({.status = [&](const ServiceStatus& arrived) { status = arrived; }}), 1u);
  EXPECT_EQ(status.term, 2u);
  EXPECT_EQ(status.world, "lab");
  EXPECT_EQ(status.left_out, std::vector<std::string>{"rotation"});
  EXPECT_EQ(status.counters.at("queries"), 9u);
  EXPECT_EQ(status.cpu_us, 12u);
  EXPECT_EQ(status.histograms.at("step_us"), (std::vector<std::uint64_t>{3, 4}));
  ASSERT_EQ(status.simulators.size(), 1u);
  EXPECT_EQ(status.simulators[0].name, "sim");
  EXPECT_EQ(status.simulators[0].granted_until_ns, 11);
}

TEST_F(MonitorTest, ADescriptionAndARemovalArrive) {
  auto* message = next_.inputs.emplace_back().mutable_agent_description();
  message->set_simulator_id(5);
  message->set_run(7);
  message->set_slot(1);
  message->set_generation(3);
  message->set_simulator_name("sim");
  message->set_shape_hash("hash");
  message->set_acceleration_max_m_s2(4);
  auto* removal = next_.inputs.emplace_back().mutable_agent_removal();
  removal->set_simulator_id(5);
  removal->set_slot(1);
  DescribedAgent agent;
  std::pair<std::uint64_t, std::uint32_t> removed;
  Monitor::Callbacks callbacks;
  callbacks.description = [&](const DescribedAgent& arrived) { agent = arrived; };
  callbacks.removal = [&](std::uint64_t simulator, std::uint32_t slot) {
    removed = {simulator, slot};
  };
  EXPECT_EQ(Poll(callbacks), 2u);
  EXPECT_EQ(agent.id, IdOf(1));
  EXPECT_EQ(agent.simulator, "sim");
  EXPECT_EQ(agent.shape_hash, "hash");
  EXPECT_EQ(agent.description.acceleration_max_m_s2, 4);
  EXPECT_EQ(removed, std::pair(std::uint64_t{5}, 1u));
}

// A sample holds the states, or clearances, of many agents: each is a call of its own.
TEST_F(MonitorTest, StatesAndClearancesArriveOneByOne) {
  auto* states = next_.inputs.emplace_back().mutable_agent_states();
  auto* clearance = next_.outputs.emplace_back().mutable_clearance();
  states->set_simulator_id(5);
  clearance->set_simulator_id(5);
  states->set_run(7);
  clearance->set_run(7);
  for (const std::uint32_t slot : {1, 2}) {
    v1::AgentState* state = states->add_states();
    *state = ToMessage(State{.stamp_ns = slot, .position_m = {1, 2, 3}});
    state->set_slot(slot);
    state->set_generation(3);
    v1::AgentClearance* agent = clearance->add_agents();
    agent->set_slot(slot);
    agent->set_generation(3);
    agent->set_clear_until_ns(100 + slot);
  }
  std::vector<AgentId> seen, clear;
  Monitor::Callbacks callbacks;
  callbacks.state = [&](const AgentId& id, const State& state) {
    seen.push_back(id);
    EXPECT_EQ(state.stamp_ns, id.slot);
    EXPECT_EQ(state.position_m, (Vector3{1, 2, 3}));
    EXPECT_FALSE(state.expiry_ns);
    EXPECT_FALSE(state.thrust_direction);
  };
  callbacks.clearance = [&](const AgentId& id, const Clearance& arrived) {
    clear.push_back(id);
    EXPECT_EQ(arrived.clear_until_ns, 100 + id.slot);
  };
  EXPECT_EQ(Poll(callbacks), 2u);
  EXPECT_EQ(seen, (std::vector<AgentId>{IdOf(1), IdOf(2)}));
  EXPECT_EQ(clear, seen);
}

TEST_F(MonitorTest, EarliestIntersectionClockAndRejectionArrive) {
  auto* earliest = next_.outputs.emplace_back().mutable_earliest_intersection();
  earliest->set_found(true);
  earliest->set_earliest_ns(12);
  SetId(earliest->mutable_lower(), 1);
  auto* rejection = next_.outputs.emplace_back().mutable_rejection();
  rejection->set_simulator_id(5);
  rejection->set_reason(v1::REJECTED_NOT_UNIT);
  auto* clock = next_.inputs.emplace_back().mutable_simulator_clock();
  clock->set_clock_ns(13);
  clock->set_lock_step(true);
  int arrived = 0;
  Monitor::Callbacks callbacks;
  callbacks.earliest = [&](const EarliestIntersection& sample) {
    ++arrived;
    EXPECT_TRUE(sample.found);
    EXPECT_EQ(sample.earliest_ns, 12);
    EXPECT_EQ(sample.lower, IdOf(1));
  };
  callbacks.rejection = [&](const Rejection& sample) {
    ++arrived;
    EXPECT_EQ(sample.simulator, 5u);
    EXPECT_EQ(sample.reason, "REJECTED_NOT_UNIT");
  };
  callbacks.clock = [&](const SimulatorClock& sample) {
    ++arrived;
    EXPECT_EQ(sample.clock_ns, 13);
    EXPECT_TRUE(sample.lock_step);
  };
  EXPECT_EQ(Poll(callbacks), 3u);
  EXPECT_EQ(arrived, 3);
}

TEST_F(MonitorTest, WithoutCallbacksNothingIsHandedOn) {
  next_.outputs.emplace_back().mutable_collision_event();
  EXPECT_EQ(Poll({}), 1u);
}

}  // namespace
}  // namespace collision::client
