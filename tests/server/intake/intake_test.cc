#include "server/intake/intake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <limits>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kAlpha = 10, kBeta = 20;  // senders

struct BadInput {
  v1::RejectionReason reason;
  const char* simulator;
  std::vector<v1::Input> inputs;
};

v1::Input Spoiled(const std::function<void(v1::AgentState*)>& spoil) {
  v1::AgentState state = State(0, 0, 7);
  spoil(&state);
  return From(kAlpha, state, "alpha");
}

std::vector<BadInput> BadInputs() {
  std::vector<BadInput> cases;
  const auto add = [&cases](v1::RejectionReason reason, v1::Input input,
                            const char* simulator = "alpha") {
    cases.push_back({reason, simulator, {std::move(input)}});
  };
  add(v1::REJECTED_NOT_FINITE, Spoiled([](v1::AgentState* s) {
        s->mutable_velocity_m_s()->set_y(std::numeric_limits<double>::quiet_NaN());
      }));
  add(v1::REJECTED_OUT_OF_RANGE, Spoiled([](v1::AgentState* s) { s->set_position_error_m(-1); }));
  add(v1::REJECTED_OUT_OF_RANGE, Spoiled([](v1::AgentState* s) { s->set_slot(70000); }));
  add(v1::REJECTED_ZERO_QUATERNION,
      Spoiled([](v1::AgentState* s) { s->mutable_orientation()->set_w(0); }));
  add(v1::REJECTED_NOT_UNIT,
      Spoiled([](v1::AgentState* s) { s->mutable_orientation()->set_x(0.5); }));
  add(v1::REJECTED_FUTURE_STAMP, Spoiled([](v1::AgentState* s) { s->set_stamp_ns(11 * kSecond); }));
  add(v1::REJECTED_STALE, Spoiled([](v1::AgentState* s) {
        s->set_stamp_ns(-1);
        s->set_discontinuity(true);
      }));
  add(v1::REJECTED_ID_OWNED, From(kBeta, State(0, 0, 9), "alpha"));
  add(v1::REJECTED_ID_OWNED, Removal(kBeta, "alpha", 0));
  v1::AgentDescription other = Description("alpha", 2);
  other.set_simulator_name("beta");
  add(v1::REJECTED_ID_MISMATCH, From(kAlpha, other));
  v1::AgentDescription negative = Description("alpha", 2);
  negative.set_radius_m(-1);
  add(v1::REJECTED_OUT_OF_RANGE, From(kAlpha, negative));
  v1::AgentDescription shaped = Description("alpha", 2);
  shaped.set_shape_hash("\x01");
  add(v1::REJECTED_BAD_SHAPE, From(kAlpha, shaped));
  v1::Input part;
  part.set_sender(kAlpha);
  part.mutable_shape_part()->set_simulator_id(SimulatorId("alpha"));
  part.mutable_shape_part()->set_run(1);
  add(v1::REJECTED_BAD_SHAPE, part);
  v1::AgentStates large = Chunk("alpha");
  for (int i = 0; i < 129; ++i) *large.add_states() = State(0, 0, 7);
  add(v1::REJECTED_CHUNK_TOO_LARGE, From(kAlpha, large));
  add(v1::REJECTED_OLD_RUN, From(kAlpha, ClockOf("alpha", 0, 0)));
  add(v1::REJECTED_CLOCK_BACKWARD, From(kAlpha, ClockOf("alpha", -1)));
  add(v1::REJECTED_CLOCK_BEYOND_GRANT, From(kAlpha, ClockOf("alpha", 11 * kSecond)));
  cases.push_back({v1::REJECTED_TOO_MANY_AGENTS,
                   "alpha",
                   {From(kAlpha, Description("alpha", 2)), From(kAlpha, Description("alpha", 3)),
                    From(kAlpha, State(2, 0, 8), "alpha"), From(kAlpha, State(3, 0, 9), "alpha")}});
  add(v1::REJECTED_TOO_MANY_SIMULATORS, From(kBeta, Description("gamma", 0)), "gamma");
  return cases;
}

// Goal:   every bad input is refused for its reason, reported to its sender, counted, and disturbs
//         nothing: agents present stay, a good state in the same batch is taken, time goes on.
// Method: each bad input in a world of its own, in one batch with a good state.
TEST(Intake, RefusesBadInputAndNothingElse) {
  for (const BadInput& bad : BadInputs()) {
    SCOPED_TRACE(v1::RejectionReason_Name(bad.reason));
    v1::Config config = Simulated();
    config.set_agents_max(3);
    config.set_simulators_max(1);
    ScriptedDaemon daemon(config);
    daemon.Step(AlphaJoins(kAlpha));
    ASSERT_TRUE(daemon.rejections().empty());

    std::vector<v1::Input> batch = bad.inputs;
    batch.push_back(From(kAlpha, State(1, kSecond, 10), "alpha"));
    batch.push_back(From(kAlpha, ClockAfter("alpha", kSecond, 10, 2)));
    daemon.Step(batch);

    const auto rejections = daemon.rejections();
    ASSERT_EQ(rejections.size(), 1u);
    EXPECT_EQ(rejections[0].reason(), bad.reason) << rejections[0].ShortDebugString();
    EXPECT_EQ(rejections[0].simulator_id(), SimulatorId(bad.simulator));
    EXPECT_EQ(rejections[0].count(), 1u);
    EXPECT_FALSE(rejections[0].field().empty());
    EXPECT_FALSE(rejections[0].detail().empty());
    EXPECT_EQ(rejections[0].stamp().service_id(), 1u);

    std::string name = v1::RejectionReason_Name(bad.reason);
    std::transform(name.begin(), name.end(), name.begin(), ::tolower);
    EXPECT_EQ(daemon.counter(name), 1u);
    const v1::ServiceStatus status = daemon.status();
    EXPECT_EQ(status.agents(), bad.reason == v1::REJECTED_TOO_MANY_AGENTS ? 3u : 2u);
    EXPECT_EQ(status.now_ns(), kSecond);
    const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
    ASSERT_GE(clearance.agents_size(), 2);
    EXPECT_EQ(clearance.agents(1).acknowledged_sequence(), 10u);
  }
}

// Goal:   a bad state in a chunk costs that slot only, and its repetitions are not reported.
TEST(Intake, ABadStateInAChunkCostsItsSlotOnly) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  v1::AgentStates chunk = Chunk("alpha");
  *chunk.add_states() = State(0, 1000, 3);
  chunk.mutable_states(0)->set_velocity_error_m_s(-1);
  *chunk.add_states() = State(1, 1000, 4);
  for (int i = 0; i < 3; ++i) daemon.Step({From(kAlpha, chunk)});
  EXPECT_EQ(daemon.rejections().size(), 1u);
  const v1::Clearance clearance = daemon.clearance(SimulatorId("alpha"));
  EXPECT_EQ(clearance.agents(0).acknowledged_sequence(), 1u);
  EXPECT_EQ(clearance.agents(1).acknowledged_sequence(), 4u);
  EXPECT_EQ(daemon.counter("states_repeated"), 4u);
}

// Goal:   states of an agent that nothing describes are kept, reported once after
//         undescribed_after_s, and used when the description comes.
TEST(Intake, KeepsStatesOfUndescribedAgents) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step({From(kAlpha, State(0, 0, 1), "alpha"), From(kAlpha, ClockAfter("alpha", 0, 1, 0))});
  daemon.Step({}, 4.9);
  EXPECT_TRUE(daemon.rejections().empty());
  EXPECT_LE(daemon.bus().timeout_ns, kSecond / 2);
  daemon.Step({}, 0.2);
  daemon.Step({}, 10);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_NOT_DESCRIBED);
  EXPECT_EQ(daemon.status().agents(), 0u);
  daemon.Step({From(kAlpha, Description("alpha", 0))});
  EXPECT_EQ(daemon.status().agents(), 1u);
}

// Goal:   of equal stamps the higher sequence wins, an older stamp is dropped and counted, a
// repetition is not.
TEST(Intake, OrdersStatesByStampAndSequence) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  const auto acknowledged = [&daemon] {
    return daemon.clearance(SimulatorId("alpha")).agents(0).acknowledged_sequence();
  };
  daemon.Step({From(kAlpha, State(0, 500, 5), "alpha")});
  daemon.Step({From(kAlpha, State(0, 400, 6), "alpha")});
  EXPECT_EQ(acknowledged(), 5u);
  daemon.Step({From(kAlpha, State(0, 500, 5), "alpha")});
  daemon.Step({From(kAlpha, State(0, 500, 7), "alpha")});
  EXPECT_EQ(acknowledged(), 7u);
  EXPECT_EQ(daemon.counter("states_older"), 1u);
  EXPECT_EQ(daemon.counter("states_repeated"), 1u);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   a new generation replaces an agent, a removal ends it, and late states of the old one do
// nothing.
TEST(Intake, SlotsAreReusedByGeneration) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  v1::AgentDescription next = Description("alpha", 0);
  next.set_generation(2);
  v1::AgentState state = State(0, 0, 5);
  state.set_generation(2);
  daemon.Step({From(kAlpha, next), From(kAlpha, state, "alpha")});
  EXPECT_EQ(daemon.clearance(SimulatorId("alpha")).agents(0).generation(), 2u);
  EXPECT_EQ(daemon.status().agents(), 2u);
  daemon.Step({From(kAlpha, State(0, 10, 6), "alpha")});
  EXPECT_EQ(daemon.counter("states_older"), 1u);
  daemon.Step({Removal(kAlpha, "alpha", 0)});
  EXPECT_EQ(daemon.status().agents(), 1u);
  EXPECT_EQ(daemon.clearance(SimulatorId("alpha")).agents_size(), 1);
  daemon.Step({From(kAlpha, next)});
  EXPECT_EQ(daemon.status().agents(), 1u);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   an agent's last state counts although its removal came in the same batch.
TEST(Intake, TheLastStateOfAnAgentCounts) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  daemon.Step({From(kAlpha, State(1, kSecond, 3), "alpha"),
               From(kAlpha, ClockAfter("alpha", kSecond, 3, 2)), Removal(kAlpha, "alpha", 1)});
  EXPECT_EQ(daemon.status().agents(), 1u);
  EXPECT_EQ(daemon.counter("states_accepted"), 3u);
  EXPECT_EQ(daemon.counter("states_older"), 0u);
}

// Goal:   a successor that comes before its predecessor's death is noticed is notified once, and
//         takes over when it writes again after that.
TEST(Intake, ASuccessorWaitsForItsPredecessorsEnd) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  const std::vector<v1::Input> joins = {From(kBeta, Description("alpha", 0, 2)),
                                        From(kBeta, State(0, 0, 1), "alpha", 2),
                                        From(kBeta, ClockOf("alpha", 0, 2))};
  daemon.Step(joins);
  EXPECT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].run_in_force(), 1u);
  EXPECT_EQ(daemon.status().agents(), 2u);
  daemon.Step({Liveliness(kAlpha, "alpha", false)});
  daemon.Step(joins);
  EXPECT_EQ(daemon.rejections().size(), 1u);
  const v1::ServiceStatus status = daemon.status();
  EXPECT_EQ(status.agents(), 1u);
  ASSERT_EQ(status.simulators_size(), 1);
  EXPECT_EQ(status.simulators(0).run(), 2u);
  EXPECT_EQ(daemon.clearance(SimulatorId("alpha")).run(), 2u);
}

// Goal:   a service that has stood still has not heard anybody: who lives keeps its name, although
//         another program waits for it; who does not loses it a little later.
TEST(Intake, ASuccessorGetsNoNameBecauseTheServiceStoodStill) {
  for (const bool lives : {true, false}) {
    ScriptedDaemon daemon(Simulated());
    daemon.Step(AlphaJoins(kAlpha));
    daemon.Step({From(kBeta, ClockOf("alpha", 0, 2))});
    daemon.Step({Liveliness(kAlpha, "alpha", false)}, 5);
    daemon.Step({From(kBeta, ClockOf("alpha", 0, 2))}, 0.4);
    if (lives) daemon.Step({Liveliness(kAlpha, "alpha", true)}, 0.1);
    daemon.Step({}, 1.5);
    daemon.Step({From(kBeta, ClockOf("alpha", 0, 2))}, 1.5);
    EXPECT_EQ(daemon.status().simulators(0).run(), lives ? 1u : 2u);
    EXPECT_EQ(daemon.status().agents(), lives ? 2u : 0u);
  }
}

// Goal:   nothing of a successor that dies waiting comes to life when the owner goes, also if both
//         ends come in one batch, the owner's first: the world has the owner's run, and waits for
//         it if it has not left.
TEST(Intake, NothingOfASuccessorThatDiesWaitingIsAdmitted) {
  for (const bool at_once : {false, true}) {
    ScriptedDaemon daemon(Simulated());
    daemon.Step(AlphaJoins(kAlpha));
    daemon.Step({From(kBeta, Description("alpha", 7, 2)), From(kBeta, State(7, 0, 1), "alpha", 2),
                 From(kBeta, ClockOf("alpha", 0, 2))});
    if (!at_once) daemon.Step({Liveliness(kBeta, "alpha", false)});
    std::vector<v1::Input> end = {Liveliness(kAlpha, "alpha", false)};
    if (at_once) end.push_back(Liveliness(kBeta, "alpha", false));
    daemon.Step(end);
    const v1::ServiceStatus status = daemon.status();
    EXPECT_EQ(status.agents(), 2u);
    EXPECT_EQ(status.simulators(0).run(), 1u);
    EXPECT_FALSE(status.simulators(0).alive());
  }
}

// Goal:   a clock of the other kind is refused by name, with what to do, and not used; none of its
//         agents is admitted, whatever comes first. A clock of the world's kind mends it.
TEST(Intake, RefusesClocksOfTheOtherKind) {
  for (const bool simulated : {true, false}) {
    v1::Config config = Simulated();
    if (!simulated) {
      config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
      config.mutable_clock()->set_skew_max_s(0.002);
    }
    ScriptedDaemon daemon(config);
    v1::SimulatorClock clock = ClockAfter("alpha", 0, 1, 1);
    clock.set_lock_step(!simulated);
    daemon.Step({From(kAlpha, Description("alpha", 0)), From(kAlpha, State(0, 0, 1), "alpha")});
    daemon.Step({From(kAlpha, clock)});
    daemon.Step({From(kAlpha, Description("alpha", 1)), From(kAlpha, State(1, 0, 2), "alpha")});
    EXPECT_EQ(daemon.status().agents(), 0u);
    ASSERT_EQ(daemon.rejections().size(), 1u);
    const v1::Rejection rejection = daemon.rejections()[0];
    EXPECT_EQ(rejection.reason(), v1::REJECTED_OUT_OF_RANGE);
    EXPECT_EQ(rejection.topic(), v1::TOPIC_SIMULATOR_CLOCK);
    EXPECT_EQ(rejection.field(), "lock_step");
    EXPECT_LE(rejection.detail().size(), 256u);
    EXPECT_NE(rejection.detail().find(simulated ? "runs in lock-step" : "runs in real time"),
              std::string::npos);
    clock.set_lock_step(simulated);
    daemon.Step({From(kAlpha, clock)});
    daemon.Step({From(kAlpha, Description("alpha", 2)), From(kAlpha, State(2, 0, 3), "alpha")});
    EXPECT_EQ(daemon.status().agents(), simulated ? 3u : 2u);  // the one admitted before is gone
  }
}

// Goal:   a change of an instance without a sender counts if it is the owner's program that wrote
//         it: a removed description, a clock without a writer. A clock says nothing about an owner
//         that has sent none, and what another program of the name leaves behind says nothing.
TEST(Intake, WhatHasNoSenderCounts) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  daemon.Step({From(kBeta, Description("beta", 0))});
  v1::Input removal = Removal(0, "alpha", 0), end = Liveliness(0, "alpha", false);
  removal.mutable_agent_removal()->set_incarnation(66);
  end.mutable_liveliness()->set_incarnation(66);
  daemon.Step({removal, end});
  EXPECT_EQ(daemon.status().agents(), 2u);
  EXPECT_EQ(daemon.counter("removals_ignored"), 1u);
  const v1::ServiceStatus before = daemon.status();
  for (const v1::SimulatorStatus& one : before.simulators()) EXPECT_TRUE(one.alive());
  daemon.Step(
      {Removal(0, "alpha", 1), Liveliness(0, "alpha", false), Liveliness(0, "beta", false)});
  EXPECT_TRUE(daemon.rejections().empty());
  const v1::ServiceStatus status = daemon.status();
  EXPECT_EQ(status.agents(), 1u);
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    EXPECT_EQ(simulator.alive(), simulator.name() == "beta") << simulator.name();
  }
}

// Goal:   a flood of bad input is counted whole and reported only up to the limit per second.
TEST(Intake, TellsABoundedNumberOfRejections) {
  v1::Config config = Simulated();
  config.set_rejections_per_second_max(5);
  ScriptedDaemon daemon(config);
  daemon.Step(AlphaJoins(kAlpha));
  std::uint64_t sequence = 10;
  const auto bad = [&sequence] {
    v1::AgentState state = State(0, 0, ++sequence);
    state.set_position_error_m(-1);
    return From(kAlpha, state, "alpha");
  };
  std::vector<v1::Input> flood(50);
  std::generate(flood.begin(), flood.end(), bad);
  daemon.Step(flood);
  EXPECT_EQ(daemon.rejections().size(), 5u);
  EXPECT_EQ(daemon.counter("rejected_out_of_range"), 50u);
  EXPECT_EQ(daemon.counter("rejections_suppressed"), 45u);
  daemon.Step({bad()}, 1);
  EXPECT_EQ(daemon.rejections().size(), 6u);
  EXPECT_EQ(daemon.rejections()[5].count(), 51u);
}

}  // namespace
}  // namespace collision::server
