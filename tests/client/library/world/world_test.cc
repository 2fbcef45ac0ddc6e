// Goal:   what a World writes is complete, in order, and never ahead of what it promises or was
//         granted; what it receives reaches the right callback once, and none after the end.
// Method: a network under the test's control; every sample written is checked.
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>

#include "client/library/world/world_implementation.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

class WorldTest : public testing::Test {
 protected:
  static AgentDescription Ball(const std::string& name = "ball") {
    return {.name = name, .radius_m = 0.5, .acceleration_max_m_s2 = 2};
  }

  /// Known to 100 m, so that nothing that a test does with it breaks a bound.
  static State At(std::int64_t stamp_ns, double x = 0) {
    State state;
    state.stamp_ns = stamp_ns;
    state.position_m = {x, 0, 0};
    state.position_error_m = 100;
    return state;
  }

  void Arrive(const v1::CollisionEvent& event) {
    *network_->arriving.emplace_back().mutable_collision_event() = event;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
};

// A jump may be overwritten by the next state before the service has read it: until it is
// acknowledged, every sample carries it.
TEST_F(WorldTest, AJumpIsCarriedUntilItIsAcknowledged) {
  World world = ConnectTo(network_, {.lock_step = false});
  Agent ball = world.AddAgent(Ball(), At(0));
  std::int64_t clock_ns = 0;
  world.Publish(clock_ns);
  State jump = At(++clock_ns, 50);
  jump.discontinuity = true;
  ball.SetState(jump);
  world.Publish(clock_ns);
  const auto acknowledge = [&](std::uint64_t sequence) {
    v1::Clearance* clearance = network_->arriving.emplace_back().mutable_clearance();
    clearance->set_simulator_id(SimulatorId(kSimulator));
    clearance->set_run(kRun);
    v1::AgentClearance* agent = clearance->add_agents();
    agent->set_generation(1);
    agent->set_acknowledged_sequence(sequence);
    world.Poll();
  };
  using Stamps = std::vector<std::int64_t>;
  const auto next = [&] {
    ball.SetState(At(++clock_ns, 50));
    world.Publish(clock_ns);
    Stamps stamps;
    const v1::AgentStates chunk = network_->States().back();
    for (const v1::AgentState& state : chunk.states()) {
      stamps.push_back(state.stamp_ns());
      EXPECT_EQ(state.discontinuity(), state.stamp_ns() == 1);
    }
    return stamps;
  };
  EXPECT_EQ(next(), (Stamps{0, 1, 2})) << "behind the first state";
  acknowledge(1);
  EXPECT_EQ(next(), (Stamps{1, 3}));
  acknowledge(2);
  EXPECT_EQ(next(), Stamps{4});
}

// The successor of a killed program waits until the service has given up its predecessor, but not
// longer, and takes the next run if its own is not higher.
TEST_F(WorldTest, WhenTheNameIsFreeEverythingIsRepeated) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Ball(), At(0, 3));
  world.Publish(0);
  network_->written.clear();
  network_->Report(kRun + 2, 1, true);
  world.Poll();
  EXPECT_NE(world.waits_for_name(), "");
  ball.SetState(At(0, 4));
  world.Publish(0);
  EXPECT_TRUE(network_->States().empty()) << "it would be refused";
  EXPECT_EQ(ball.id().run, kRun);
  network_->written.clear();
  network_->Report(kRun + 2, 1, false);
  world.Poll();
  EXPECT_EQ(world.waits_for_name(), "");
  EXPECT_EQ(ball.id().run, kRun + 3);
  ASSERT_EQ(network_->written.size(), 4u);
  EXPECT_EQ(network_->written[0].agent_description().run(), kRun + 3);
  EXPECT_EQ(network_->written[0].agent_description().agent_name(), "ball");
  EXPECT_EQ(network_->written[1].agent_states().run(), kRun + 3);
  EXPECT_EQ(network_->written[1].agent_states().states(0).position_m().x(), 3);
  EXPECT_EQ(network_->written[2].agent_states().states(0).position_m().x(), 4) << "it is due";
  EXPECT_EQ(network_->written[3].simulator_clock().run(), kRun + 3);
  EXPECT_EQ(network_->written[3].simulator_clock().descriptions_sequence(), 1u);
  world.Publish(0);
  EXPECT_EQ(network_->written.size(), 4u) << "once is enough";
}

TEST_F(WorldTest, AnAgentIsDescribedThenPlacedThenCoveredByAClock) {
  World world = ConnectTo(network_);
  const Agent ball = world.AddAgent(Ball(), At(0, 3));
  world.Publish(0);
  ASSERT_EQ(network_->written.size(), 3u);
  EXPECT_EQ(network_->flushed, 3u);

  const v1::AgentDescription& description = network_->written[0].agent_description();
  EXPECT_EQ(description.simulator_id(), SimulatorId(kSimulator));
  EXPECT_EQ(description.simulator_name(), kSimulator);
  EXPECT_EQ(description.run(), kRun);
  EXPECT_EQ(description.generation(), 1u);
  EXPECT_EQ(description.revision(), 1u);
  EXPECT_EQ(description.sequence(), 1u);
  EXPECT_EQ(description.agent_name(), "ball");
  EXPECT_EQ(description.radius_m(), 0.5);
  EXPECT_EQ(description.angular_acceleration_max_rad_s2(), -1);
  EXPECT_EQ(description.class_name(), "");

  const v1::AgentStates& states = network_->written[1].agent_states();
  ASSERT_EQ(states.states_size(), 1);
  EXPECT_EQ(states.run(), kRun);
  EXPECT_EQ(states.states(0).sequence(), 1u);
  EXPECT_EQ(states.states(0).generation(), 1u);
  EXPECT_EQ(states.states(0).position_m().x(), 3);
  EXPECT_EQ(states.states(0).orientation().w(), 1);
  EXPECT_EQ(states.states(0).expiry_ns(), kNever);

  const v1::SimulatorClock& clock = network_->written[2].simulator_clock();
  EXPECT_EQ(clock.clock_ns(), 0);
  EXPECT_EQ(clock.states_sequence(), 1u);
  EXPECT_EQ(clock.descriptions_sequence(), 1u);
  EXPECT_EQ(clock.agents(), 1u);
  EXPECT_TRUE(clock.lock_step());
}

// A lost or overtaken sample costs nothing: each carries all of its chunk. Only chunks that changed
// are written.
TEST_F(WorldTest, AChunkIsCompleteAndOnlyChangedOnesAreWritten) {
  World world = ConnectTo(network_, {.chunk_size = 2});
  std::vector<Agent> agents;
  for (int i = 0; i < 5; ++i) agents.push_back(world.AddAgent(Ball(), At(0, i)));
  world.Publish(0);
  ASSERT_EQ(network_->States().size(), 3u);

  network_->written.clear();
  agents[3].SetState(At(0, 30));
  world.Publish(0);
  const auto states = network_->States();
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].chunk(), 1u);
  ASSERT_EQ(states[0].states_size(), 2);
  EXPECT_EQ(states[0].states(0).slot(), 2u);
  EXPECT_EQ(states[0].states(0).sequence(), 3u);
  EXPECT_EQ(states[0].states(0).position_m().x(), 2);
  EXPECT_EQ(states[0].states(1).slot(), 3u);
  EXPECT_EQ(states[0].states(1).sequence(), 6u);
  EXPECT_EQ(states[0].states(1).position_m().x(), 30);
  EXPECT_EQ(network_->Clocks().back().states_sequence(), 6u);
}

TEST_F(WorldTest, TheLastOfSeveralStagedStatesIsWritten) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Ball(), At(0, 1));
  ball.SetState(At(0, 2));
  ball.SetState(At(0, 3));
  world.Publish(0);
  ASSERT_EQ(network_->States().size(), 1u);
  EXPECT_EQ(network_->States()[0].states(0).position_m().x(), 3);
  EXPECT_EQ(network_->Clocks()[0].states_sequence(), 1u);
}

// "Everything up to clock_ns has been sent": not a moment later and, since the service refuses
// stamps beyond its grant, not before.
TEST_F(WorldTest, AdvanceWithoutLockStepDoesNotWait) {
  World world = ConnectTo(network_, {.lock_step = false});
  EXPECT_EQ(world.AdvanceTo(1'700'000'000'000'000'000, hours(1)), Advance::kReached);
  EXPECT_EQ(network_->waits, std::vector<nanoseconds>{nanoseconds(0)});
  EXPECT_FALSE(network_->Clocks().at(0).lock_step());
}

TEST_F(WorldTest, WaitsAreBoundedByTheRestOfTheTimeout) {
  World world = ConnectTo(network_);
  int answers = 0;
  network_->on_wait = [&answers](FakeNetwork* network) { network->Grant(++answers); };
  EXPECT_EQ(world.AdvanceTo(5, hours(1)), Advance::kReached);
  ASSERT_EQ(network_->waits.size(), 6u);
  EXPECT_EQ(network_->waits[0], nanoseconds(0));
  for (std::size_t i = 1; i < network_->waits.size(); ++i) {
    EXPECT_GT(network_->waits[i], nanoseconds(0));
    EXPECT_LE(network_->waits[i], i == 1 ? nanoseconds(hours(1)) : network_->waits[i - 1]);
  }
}

// A service that answers, but never grants enough, must not block a simulator forever.
TEST_F(WorldTest, AnswersDoNotProlongTheTimeout) {
  World world = ConnectTo(network_);
  network_->on_wait = [](FakeNetwork* network) {
    if (network->waits.size() > 1'000'000) throw std::logic_error("it waits for ever");
    network->Grant(1);
  };
  EXPECT_EQ(world.AdvanceTo(5, nanoseconds(1)), Advance::kTimeout);
  EXPECT_FALSE(world.WaitForService(nanoseconds(1)));
}

TEST_F(WorldTest, TheLongestTimeoutDoesNotOverflow) {
  World world = ConnectTo(network_);
  network_->on_wait = [](FakeNetwork* network) { network->Grant(9); };
  EXPECT_EQ(world.AdvanceTo(9, nanoseconds::max()), Advance::kReached);
}

TEST_F(WorldTest, PublishRefusesClocksOutsideTheGrant) {
  World world = ConnectTo(network_);
  world.Publish(10);
  EXPECT_THROW(world.Publish(9), std::invalid_argument);
  EXPECT_THROW(world.Publish(11), std::invalid_argument);
  EXPECT_THROW(world.AdvanceTo(9, nanoseconds(0)), std::invalid_argument);
  network_->Grant(11);
  world.Poll();
  world.Publish(11);
  EXPECT_THROW(world.Publish(std::numeric_limits<std::int64_t>::min()), std::invalid_argument);
  EXPECT_EQ(network_->Clocks().size(), 2u);
}

TEST_F(WorldTest, PublishingNothingNewWritesNothing) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Ball(), At(0));
  world.Publish(0);
  network_->written.clear();
  world.Publish(0);
  EXPECT_TRUE(network_->written.empty());
  ball.SetState(At(1));
  world.Publish(0);
  EXPECT_TRUE(network_->written.empty());
  ball.SetDescription(Ball("other"));
  world.Publish(0);
  ASSERT_EQ(network_->written.size(), 2u);
  EXPECT_EQ(network_->written[0].agent_description().revision(), 2u);
  EXPECT_EQ(network_->written[1].simulator_clock().descriptions_sequence(), 2u);
}

TEST_F(WorldTest, GrantsOnlyGrowAndThoseOfOthersAreIgnored) {
  World world = ConnectTo(network_);
  network_->Grant(50);
  network_->Grant(40);
  network_->Grant(99, 1, kRun - 1);
  network_->Grant(99);
  network_->arriving.back().mutable_clearance()->set_simulator_id(1);
  world.Poll();
  EXPECT_EQ(world.granted_until_ns(), 50);
}

// A standby that has taken over has a higher term; samples of the old one are void.
TEST_F(WorldTest, LowerTermsAreDropped) {
  World world = ConnectTo(network_);
  network_->Grant(50, 2);
  network_->Grant(99, 1);
  world.Poll();
  EXPECT_EQ(world.granted_until_ns(), 50);
  network_->Grant(60, 2);
  world.Poll();
  EXPECT_EQ(world.granted_until_ns(), 60);
}

TEST_F(WorldTest, ARemovedAgentLeavesItsChunkAndItsSlotToANewGeneration) {
  World world = ConnectTo(network_, {.chunk_size = 64});
  const Agent stays = world.AddAgent(Ball(), At(0));
  {
    const Agent leaves = world.AddAgent(Ball(), At(0));
    world.Publish(0);
    network_->written.clear();
  }
  ASSERT_EQ(network_->written.size(), 1u);
  EXPECT_EQ(network_->written[0].agent_removal().slot(), 1u);
  EXPECT_EQ(network_->flushed, 1u);
  // The service is to see its last state, so its slot waits until the clock has moved on.
  world.Publish(0);
  ASSERT_EQ(network_->States().size(), 1u);
  EXPECT_EQ(network_->States()[0].states(1).expiry_ns(), 0) << "when it left";
  EXPECT_EQ(network_->Clocks().back().agents(), 1u);
  network_->written.clear();
  network_->Grant(1);
  world.Poll();
  world.Publish(1);
  ASSERT_EQ(network_->States().size(), 1u);
  EXPECT_EQ(network_->States()[0].states_size(), 1);

  const Agent next = world.AddAgent(Ball(), At(0));
  EXPECT_EQ(next.id().slot, 1u);
  EXPECT_EQ(next.id().generation, 2u);
  EXPECT_EQ(stays.id().generation, 1u);
}

TEST_F(WorldTest, TheLowestFreeSlotIsTakenFirst) {
  World world = ConnectTo(network_);
  std::vector<Agent> agents;
  for (int i = 0; i < 6; ++i) agents.push_back(world.AddAgent(Ball(), At(0)));
  for (const int slot : {0, 5, 1, 4}) Agent(std::move(agents[slot]));
  for (const std::uint32_t slot : {0u, 1u, 4u, 5u, 6u}) {
    agents.push_back(world.AddAgent(Ball(), At(0)));
    EXPECT_EQ(agents.back().id().slot, slot);
  }
}

TEST_F(WorldTest, AnAgentThatIsRemovedTakesItsStagedStateWithIt) {
  World world = ConnectTo(network_);
  world.AddAgent(Ball(), At(0));
  const Agent next = world.AddAgent(Ball(), At(0));
  world.Publish(0);
  ASSERT_EQ(network_->States().size(), 1u);
  ASSERT_EQ(network_->States()[0].states_size(), 1);
  EXPECT_EQ(network_->States()[0].states(0).generation(), 2u);
  EXPECT_EQ(network_->Clocks()[0].states_sequence(), 1u);
}

TEST_F(WorldTest, AHandleThatWasMovedFromRemovesNothing) {
  World world = ConnectTo(network_);
  Agent first = world.AddAgent(Ball("first"), At(0));
  Agent second = world.AddAgent(Ball("second"), At(0));
  network_->written.clear();
  Agent moved = std::move(first);
  EXPECT_TRUE(network_->written.empty());
  moved = std::move(second);
  ASSERT_EQ(network_->written.size(), 1u);
  EXPECT_EQ(network_->written[0].agent_removal().slot(), 0u);
  EXPECT_EQ(moved.id().slot, 1u);
}

TEST_F(WorldTest, AHandleThatOutlivesItsWorldDoesNothing) {
  std::optional<World> world = ConnectTo(network_);
  std::optional<Agent> ball = world->AddAgent(Ball(), At(0));
  world.reset();
  network_->written.clear();
  ball->SetState(At(5));
  ball->SetDescription(Ball());
  EXPECT_EQ(ball->clearance().clear_until_ns, std::numeric_limits<std::int64_t>::min());
  ball.reset();
  EXPECT_TRUE(network_->written.empty());
}

TEST_F(WorldTest, ClearancesReachTheirAgentAndNoFormerOne) {
  World world = ConnectTo(network_);
  const Agent ball = world.AddAgent(Ball(), At(0));
  network_->Grant(10);
  v1::AgentClearance* said = network_->arriving.back().mutable_clearance()->add_agents();
  said->set_generation(1);
  said->set_clear_until_ns(33);
  said->set_cause(v1::CAUSE_BREACH);
  said->set_void_from_ns(5);
  v1::AgentClearance* unknown = network_->arriving.back().mutable_clearance()->add_agents();
  *unknown = *said;
  unknown->set_slot(9);
  world.Poll();
  EXPECT_EQ(ball.clearance().clear_until_ns, 33);
  EXPECT_EQ(ball.clearance().cause, "CAUSE_BREACH");
  EXPECT_EQ(ball.clearance().void_from_ns, 5);

  network_->Grant(10);
  said = network_->arriving.back().mutable_clearance()->add_agents();
  said->set_generation(2);
  said->set_clear_until_ns(44);
  world.Poll();
  EXPECT_EQ(ball.clearance().clear_until_ns, 33);
}

TEST_F(WorldTest, RefusalsOfThisRunAreKeptUpToABound) {
  World world = ConnectTo(network_);
  for (std::uint64_t i = 1; i <= kRejectionsMax + 2; ++i) {
    v1::Rejection* rejection = network_->arriving.emplace_back().mutable_rejection();
    rejection->set_simulator_id(SimulatorId(kSimulator));
    rejection->set_run(i == 1 ? kRun - 1 : kRun);
    rejection->set_reason(v1::REJECTED_NOT_FINITE);
    rejection->set_topic(v1::TOPIC_AGENT_STATES);
    rejection->set_count(i);
  }
  world.Poll();
  const auto rejections = world.TakeRejections();
  ASSERT_EQ(rejections.size(), kRejectionsMax);
  EXPECT_EQ(rejections.front().count, 3u);
  EXPECT_EQ(rejections.front().reason, "REJECTED_NOT_FINITE");
  EXPECT_EQ(rejections.front().topic, "TOPIC_AGENT_STATES");
  EXPECT_TRUE(world.TakeRejections().empty());
}

TEST_F(WorldTest, RefusalsOfAServiceThatHasBeenReplacedDoNotCount) {
  World world = ConnectTo(network_);
  network_->Grant(10, 2);
  for (const std::uint32_t term : {1, 2}) {
    v1::Rejection* rejection = network_->arriving.emplace_back().mutable_rejection();
    rejection->mutable_stamp()->set_service_id(term);
    rejection->mutable_stamp()->set_term(term);
    rejection->set_simulator_id(SimulatorId(kSimulator));
    rejection->set_run(kRun);
    rejection->set_count(term);
  }
  world.Poll();
  const auto rejections = world.TakeRejections();
  ASSERT_EQ(rejections.size(), 1u);
  EXPECT_EQ(rejections.front().count, 2u);
}

TEST_F(WorldTest, WaitsForAServiceUntilItIsAliveOrTheTimeoutIsOver) {
  World world = ConnectTo(network_);
  EXPECT_FALSE(world.WaitForService(nanoseconds(0)));
  network_->on_wait = [](FakeNetwork* network) { network->alive = true; };
  EXPECT_TRUE(world.WaitForService(hours(1)));
}

TEST_F(WorldTest, OptionsOutOfRangeAreRefused) {
  const auto connect = [this](WorldOptions options) {
    World::Connect(options, std::make_unique<FakeTransport>(network_));
  };
  EXPECT_NO_THROW(connect({.simulator = "a-Z_9"}));
  EXPECT_THROW(connect({}), std::runtime_error);
  EXPECT_THROW(connect({.simulator = "a.b"}), std::runtime_error);
  EXPECT_THROW(connect({.simulator = std::string(65, 'a')}), std::runtime_error);
  EXPECT_THROW(connect({.world = "*", .simulator = "a"}), std::runtime_error);
  EXPECT_THROW(connect({.simulator = "a", .domain = 231}), std::runtime_error);
  EXPECT_THROW(connect({.simulator = "a", .lead = nanoseconds(-1)}), std::runtime_error);
  EXPECT_THROW(connect({.simulator = "a", .chunk_size = 65}), std::runtime_error);
}

}  // namespace
}  // namespace collision::client
