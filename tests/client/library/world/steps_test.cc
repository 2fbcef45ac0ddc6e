// Goal:   a World in lock-step says when it goes on, binds itself by it, and goes on only when time
//         is granted.
// Method: a network under the test's control; every sample written is checked.
#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include "collision/world.h"
#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

class StepsTest : public testing::Test {
 protected:
  static AgentDescription Ball() {
    return {.name = "ball", .radius_m = 0.5, .acceleration_max_m_s2 = 2};
  }

  /// Known to 100 m, so that nothing that a test does with it breaks a bound.
  static State At(std::int64_t stamp_ns, double x = 0) {
    State state;
    state.stamp_ns = stamp_ns;
    state.position_m = {x, 0, 0};
    state.position_error_m = 100;
    return state;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
};

TEST_F(StepsTest, AStateWaitsForTheClockOfItsStamp) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Ball(), At(0));
  network_->Grant(40);
  world.AdvanceTo(0, nanoseconds(0));
  ball.SetState(At(100, 1));
  network_->written.clear();
  network_->on_wait = [](FakeNetwork* network) {
    network->Grant(network->waits.size() < 6 ? 70 : 130);
  };

  EXPECT_EQ(world.AdvanceTo(100, hours(1)), Advance::kReached);
  const auto& written = network_->written;
  ASSERT_EQ(written.size(), 2u);
  EXPECT_EQ(written[0].simulator_clock().clock_ns(), 0);
  EXPECT_EQ(written[0].simulator_clock().next_ns(), 100);
  EXPECT_EQ(written[0].simulator_clock().states_sequence(), 1u);
  ASSERT_EQ(written[1].agent_states().states_size(), 2) << "behind the first state";
  EXPECT_EQ(written[1].agent_states().states(1).stamp_ns(), 100);
  EXPECT_EQ(world.clock_ns(), 100);
  EXPECT_EQ(world.granted_until_ns(), 130);

  // What comes next is said with the next step, or while waiting at this one.
  world.Poll();
  EXPECT_EQ(written.size(), 2u);
  world.Poll(nanoseconds(1));
  ASSERT_EQ(written.size(), 3u);
  EXPECT_EQ(written[2].simulator_clock().clock_ns(), 100);
  EXPECT_EQ(written[2].simulator_clock().next_ns(), 101);
  EXPECT_EQ(written[2].simulator_clock().states_sequence(), 2u);
}

TEST_F(StepsTest, AdvanceNeverPassesTheGrantAndContinuesAfterATimeout) {
  World world = ConnectTo(network_);
  EXPECT_EQ(world.AdvanceTo(100, nanoseconds(0)), Advance::kTimeout);
  EXPECT_EQ(world.clock_ns(), 0);
  network_->Grant(60);
  EXPECT_EQ(world.AdvanceTo(100, nanoseconds(0)), Advance::kTimeout);
  EXPECT_EQ(world.clock_ns(), 0);
  network_->Grant(100);
  EXPECT_EQ(world.AdvanceTo(100, nanoseconds(0)), Advance::kReached);
  EXPECT_EQ(world.clock_ns(), 100);
  ASSERT_EQ(network_->Clocks().size(), 1u);
  EXPECT_EQ(network_->Clocks()[0].next_ns(), 100);
}

// Goal:   nobody is told less than was announced: others have gone on in reliance on it.
TEST_F(StepsTest, AnAnnouncedStepBinds) {
  World world = ConnectTo(network_);
  Agent ball = world.AddAgent(Ball(), At(0));
  EXPECT_EQ(world.AdvanceTo(100, nanoseconds(0)), Advance::kTimeout);
  EXPECT_THROW(world.AdvanceTo(99, nanoseconds(0)), std::invalid_argument);
  State jump = At(99);
  jump.discontinuity = true;
  EXPECT_THROW(ball.SetState(jump), std::invalid_argument);
  jump.stamp_ns = 100;
  EXPECT_NO_THROW(ball.SetState(jump));
  network_->Grant(100);
  EXPECT_EQ(world.AdvanceTo(100, nanoseconds(0)), Advance::kReached);
}

TEST_F(StepsTest, WhoHasFinishedSaysSo) {
  World world = ConnectTo(network_);
  const Agent ball = world.AddAgent(Ball(), At(0));
  world.AdvanceTo(0, nanoseconds(0));
  world.Finish();
  ASSERT_EQ(network_->Clocks().size(), 1u);
  EXPECT_EQ(network_->Clocks()[0].next_ns(), kNever);
  EXPECT_THROW(world.AdvanceTo(1, nanoseconds(0)), std::invalid_argument);
}

TEST_F(StepsTest, AWorldThatLeavesNoAgentsLeavesTheWorldsTime) {
  for (const bool stays : {false, true}) {
    network_->written.clear();
    std::optional<World> world = ConnectTo(network_, {.on_leave = OnLeave::kLeave});
    std::optional<Agent> ball = world->AddAgent(Ball(), At(0));
    world->AdvanceTo(0, nanoseconds(0));
    if (!stays) ball.reset();
    world.reset();
    ASSERT_EQ(network_->Clocks().size(), stays ? 0u : 1u);
    if (!stays) {
      EXPECT_EQ(network_->Clocks()[0].next_ns(), kNever);
    }
  }
}

TEST_F(StepsTest, AWorldTakesItsAgentsWithItBeforeItLeavesTime) {
  std::optional<World> world = ConnectTo(network_);
  const Agent first = world->AddAgent(Ball(), At(0)), second = world->AddAgent(Ball(), At(0));
  world->AdvanceTo(0, nanoseconds(0));
  network_->written.clear();
  world.reset();
  ASSERT_EQ(network_->written.size(), 5u);
  EXPECT_EQ(network_->written[0].agent_removal().slot(), 0u);
  EXPECT_EQ(network_->written[1].agent_removal().slot(), 1u);
  for (const int k : {2, 3}) {
    EXPECT_EQ(network_->written[k].agent_states().states(0).expiry_ns(), 0) << "when it left";
  }
  EXPECT_EQ(network_->written[4].simulator_clock().next_ns(), kNever);
  EXPECT_EQ(network_->flushed, 5u);
}

}  // namespace
}  // namespace collision::client
