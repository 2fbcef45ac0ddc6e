// Goal:   of the states that a simulator sets, those that the service needs are sent, in time, and
//         no other; as a stream, all of them are.
// Method: a network under the test's control; the test publishes the clearances.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "idl/limits.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

constexpr std::int64_t kStep = 10;

class OnDemandTest : public testing::Test {
 protected:
  /// One agent, described, sent and admitted at 0; it drifts along x at 1 m/s, M = 0.
  void Start(WorldOptions options = {.lock_step = false, .lead = nanoseconds(0)}) {
    world_.emplace(ConnectTo(network_, options));
    ball_.emplace(
        world_->AddAgent({.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0}, At(0)));
    world_->Publish(0);
    network_->written.clear();
  }

  static State At(std::int64_t stamp_ns) {
    State state;
    state.stamp_ns = stamp_ns;
    state.position_m = {static_cast<double>(stamp_ns) * 1e-9, 0, 0};
    state.velocity_m_s = {1, 0, 0};
    return state;
  }

  struct Says {
    std::int64_t now_ns = 0;
    std::int64_t wanted_ns = 0;
    std::uint64_t acknowledged = 0;
    std::int64_t clear_until_ns = kNever;
    std::uint32_t generation = 1;
  };

  void ServiceSays(const Says& says) {
    v1::Clearance* clearance = network_->arriving.emplace_back().mutable_clearance();
    clearance->set_simulator_id(SimulatorId(kSimulator));
    clearance->set_run(kRun);
    clearance->set_now_ns(says.now_ns);
    clearance->set_granted_until_ns(granted_ns_);
    v1::AgentClearance* agent = clearance->add_agents();
    agent->set_generation(says.generation);
    agent->set_acknowledged_sequence(says.acknowledged);
    agent->set_clear_until_ns(says.clear_until_ns);
    agent->set_state_wanted_ns(says.wanted_ns);
    if (!in_wait_) world_->Poll();
  }

  /// Sets the states of all steps from `from_ns` to `to_ns`; returns the stamps that were sent.
  std::vector<std::int64_t> Fly(std::int64_t from_ns, std::int64_t to_ns) {
    for (std::int64_t t = from_ns; t <= to_ns; t += kStep) {
      ball_->SetState(At(t));
      world_->Publish(t);
    }
    return TakeSent();
  }

  std::vector<std::int64_t> TakeSent() {
    std::vector<std::int64_t> stamps;
    for (const v1::AgentStates& chunk : network_->States()) {
      for (const v1::AgentState& state : chunk.states()) stamps.push_back(state.stamp_ns());
    }
    network_->written.clear();
    return stamps;
  }

  using Stamps = std::vector<std::int64_t>;

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  std::optional<World> world_;
  std::optional<Agent> ball_;
  std::int64_t granted_ns_ = 1'000'000;
  bool in_wait_ = false;  ///< The world is waiting: what is said arrives by itself.
};

TEST_F(OnDemandTest, NothingIsKeptBackBeforeTheServiceHasSpoken) {
  Start();
  EXPECT_EQ(Fly(10, 20), (Stamps{0, 10, 0, 20})) << "a sample carries the first";
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 9, .generation = 2});
  EXPECT_EQ(Fly(30, 40), (Stamps{0, 30, 0, 40})) << "that was another agent";
}

TEST_F(OnDemandTest, TheLastStateBeforeItIsWantedGoesOut) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = 55, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 50), Stamps{50}) << "the next one comes at 60: too late";
  EXPECT_EQ(ball_->clearance().state_wanted_ns, 55);
  ServiceSays({.now_ns = 50, .wanted_ns = 90, .acknowledged = 2});
  EXPECT_EQ(Fly(60, 70), Stamps{});
  EXPECT_EQ(Fly(80, 80), Stamps{}) << "the next one comes at 90: in time";
  EXPECT_EQ(Fly(90, 90), Stamps{90});
  ServiceSays({.now_ns = 90, .wanted_ns = kNever, .acknowledged = 3});
  EXPECT_EQ(Fly(100, 2000), Stamps{});
}

// Nobody looks: as rare as before. Then for every second step a period has passed, by a clock that
// the test sets forward far more than a slow machine takes.
TEST_F(OnDemandTest, AWatchedAgentIsSentOnceAPeriodWhileItIsWatched) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 100), Stamps{});
  v1::Watch watch;
  watch.set_watcher_id(1);
  watch.set_period_ns(std::chrono::nanoseconds(hours(1)).count());
  watch.set_lease_ns(wire::kWatchLeaseMax);
  watch.set_all(true);
  Stamps sent;
  for (std::int64_t t = 110; t <= 180; t += kStep) {
    network_->later += std::chrono::minutes(31);
    *network_->heard.emplace_back().mutable_watch() = watch;
    world_->Poll();
    for (const std::int64_t stamp : Fly(t, t)) sent.push_back(stamp);
  }
  EXPECT_EQ(sent, (Stamps{120, 140, 160, 180}));
  network_->later += std::chrono::hours(2);
  EXPECT_EQ(Fly(190, 200), Stamps{}) << "the lease is over";
}

TEST_F(OnDemandTest, WantedAtOnceMeansEveryStep) {
  Start();
  ServiceSays({.now_ns = 5, .wanted_ns = 5, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 40), (Stamps{10, 20, 30, 40})) << "acknowledged or not";
}

TEST_F(OnDemandTest, AStreamSendsEverything) {
  Start({.lock_step = false, .on_demand = false});
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 30), (Stamps{10, 20, 30}));
  EXPECT_EQ(world_->traffic().states_set, 4u);
  EXPECT_EQ(world_->traffic().states_sent, 4u);
}

TEST_F(OnDemandTest, TheLeadCoversTheWay) {
  Start({.lock_step = false, .lead = nanoseconds(30)});
  ServiceSays({.now_ns = 0, .wanted_ns = 100, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 60), Stamps{}) << "at 70 there are still 30 left";
  EXPECT_EQ(Fly(70, 70), Stamps{70});
}

// In lock-step the world's time waits for the way, so no lead is added.
TEST_F(OnDemandTest, LockStepNeedsNoLead) {
  Start({.lock_step = true, .lead = nanoseconds(30)});
  ServiceSays({.now_ns = 0, .wanted_ns = 100, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 90), Stamps{});
  EXPECT_EQ(Fly(100, 100), Stamps{100});
}

// An admission or another agent's jump lowers a clearance: the staged state is wanted after all.
TEST_F(OnDemandTest, AStagedStateAnswersALoweredClearance) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = 10'000, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 50), Stamps{});
  ServiceSays({.now_ns = 45, .wanted_ns = 40, .acknowledged = 1});
  world_->Publish(50);
  EXPECT_EQ(TakeSent(), Stamps{50}) << "at once, at the same clock";
  world_->Publish(50);
  EXPECT_EQ(TakeSent(), Stamps{}) << "once";
}

// The simulator waits for a grant beyond its clock, and the answer to the lowered clearance must
// not wait for that.
TEST_F(OnDemandTest, AStagedStateAnswersWhileAGrantIsAwaited) {
  granted_ns_ = 60;
  Start({.lock_step = true});
  ServiceSays({.now_ns = 0, .wanted_ns = 10'000, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 50), Stamps{});
  int waits = 0;
  in_wait_ = true;
  network_->on_wait = [&](FakeNetwork* network) {
    if (++waits == 1) ServiceSays({.now_ns = 50, .wanted_ns = 50, .acknowledged = 1});
    if (waits == 2) network->Grant(100);
  };
  EXPECT_EQ(world_->AdvanceTo(100, hours(1)), Advance::kReached);
  EXPECT_EQ(TakeSent(), Stamps{50});
  EXPECT_EQ(waits, 2);
}

// A simulator ahead of the answers sends as the service would ask it to: half-way to the end of the
// clearance.
TEST_F(OnDemandTest, ASimulatorAheadOfTheAnswersHalvesItsDistance) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = 200, .acknowledged = 1, .clear_until_ns = 1000});
  EXPECT_EQ(Fly(10, 1000), (Stamps{200, 600, 800, 900, 950, 970, 980, 990, 1000}));
}

TEST_F(OnDemandTest, AStateOnItsWayIsNotSentTwice) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = 20, .acknowledged = 1, .clear_until_ns = 10'000});
  EXPECT_EQ(Fly(10, 100), Stamps{20});
}

TEST_F(OnDemandTest, AJumpIsAlwaysSent) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  State jump = At(10);
  jump.discontinuity = true;
  ball_->SetState(jump);
  world_->Publish(10);
  EXPECT_EQ(TakeSent(), Stamps{10});
}

// A state set after a jump that was not sent yet replaces it, and is marked as a jump.
TEST_F(OnDemandTest, AJumpThatIsReplacedIsSent) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  State jump = At(10);
  jump.position_m = {500, 0, 0};
  jump.velocity_m_s = {};
  jump.discontinuity = true;
  ball_->SetState(jump);
  State after = jump;
  after.stamp_ns = 20;
  after.discontinuity = false;
  ball_->SetState(after);
  world_->Publish(20);
  const std::vector<v1::AgentStates> chunks = network_->States();
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0].states(0).stamp_ns(), 20);
  EXPECT_TRUE(chunks[0].states(0).discontinuity());
}

// The service may refuse a state, and does not report every refusal. A state that must be sent must
// not be lost.
TEST_F(OnDemandTest, AStateThatMustBeSentIsRepeatedUntilItIsAccepted) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  State jump = At(10);
  jump.discontinuity = true;
  ball_->SetState(jump);
  world_->Publish(10);
  EXPECT_EQ(Fly(20, 30), (Stamps{10, 10, 20, 10, 30})) << "a sample carries the jump";
  ServiceSays({.now_ns = 30, .wanted_ns = kNever, .acknowledged = 3});
  EXPECT_EQ(Fly(40, 50), Stamps{});
}

// And so is the one that it does not follow from.
TEST_F(OnDemandTest, AStateThatLeavesThePromiseIsSent) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 20), Stamps{});
  State swerve = At(30);
  swerve.velocity_m_s = {1, 1e-3, 0};  // M = 0
  ball_->SetState(swerve);
  world_->Publish(30);
  EXPECT_EQ(TakeSent(), (Stamps{20, 30}));
}

// The service has not wanted the states at 10 and 20 ns; what there was until the agent left it has
// to know.
TEST_F(OnDemandTest, TheLastStateThatWasReachedIsSentBeforeItsAgentLeaves) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 20), Stamps{});
  network_->written.clear();
  ball_.reset();
  ASSERT_EQ(network_->written.size(), 2u);
  ASSERT_TRUE(network_->written[0].has_agent_states());
  EXPECT_EQ(network_->written[0].agent_states().states(0).stamp_ns(), 20);
  EXPECT_TRUE(network_->written[1].has_agent_removal());
}

// One that it has not reached yet it never reaches.
TEST_F(OnDemandTest, AStateAheadOfTheClockIsNotSentWhenItsAgentLeaves) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  ball_->SetState(At(30));
  network_->written.clear();
  ball_.reset();
  ASSERT_EQ(network_->written.size(), 1u);
  EXPECT_TRUE(network_->written[0].has_agent_removal());
}

// A new description counts from the next state on, so that must be sent.
TEST_F(OnDemandTest, ADescriptionIsFollowedByAState) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  EXPECT_EQ(Fly(10, 20), Stamps{});
  ball_->SetDescription({.name = "ball", .radius_m = 0.5, .acceleration_max_m_s2 = 0});
  world_->Publish(20);
  EXPECT_EQ(TakeSent(), Stamps{20}) << "the one that was kept back";
  ServiceSays({.now_ns = 20, .wanted_ns = kNever, .acknowledged = 2});
  EXPECT_EQ(Fly(30, 40), Stamps{});
}

TEST_F(OnDemandTest, SamplesAreSmallUnlessRequestedOtherwise) {
  for (const std::uint32_t chunk_size : {0u, 2u}) {
    network_->written.clear();
    World world = ConnectTo(network_, {.lock_step = false, .chunk_size = chunk_size});
    std::vector<Agent> agents;
    for (int i = 0; i < 4; ++i) agents.push_back(world.AddAgent(Point("a"), At(0)));
    world.Publish(0);
    EXPECT_EQ(network_->States().size(), chunk_size == 0 ? 4u : 2u);
    EXPECT_EQ(world.traffic().states_sent, 4u);
    EXPECT_EQ(world.traffic().samples_sent, network_->States().size());
  }
}

// The next agent of a slot starts without a clearance.
TEST_F(OnDemandTest, ANewAgentInheritsNothing) {
  Start();
  ServiceSays({.now_ns = 0, .wanted_ns = kNever, .acknowledged = 1});
  ball_.reset();
  ball_.emplace(
      world_->AddAgent({.name = "next", .radius_m = 1, .acceleration_max_m_s2 = 0}, At(5)));
  EXPECT_EQ(Fly(10, 20), (Stamps{10, 10, 20})) << "a sample carries its first";
}

}  // namespace
}  // namespace collision::client
