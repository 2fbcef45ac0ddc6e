// Goal:   a World chooses a run of its own, takes no step while another program has its name, and
//         knows which kind of clock the service has.
// Method: a network under the test's control; the run is compared with the clock before and after.
#include <gtest/gtest.h>

#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

/// Since 2020 began.
std::int64_t Tenths() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count() / 100 - 15'778'368'000;
}

// Two starts of a simulator in one second are two runs.
TEST(RunAndClock, ARunByTheClockCountsTenthsOfASecond) {
  const auto network = std::make_shared<FakeNetwork>();
  const auto before = static_cast<std::uint32_t>(Tenths());
  World world = World::Connect({.simulator = kSimulator}, std::make_unique<FakeTransport>(network));
  const auto after = static_cast<std::uint32_t>(Tenths());
  const Agent ball = world.AddAgent(Point(), {});
  world.Publish(0);
  EXPECT_GE(network->written[0].agent_description().run(), before);
  EXPECT_LE(network->written[0].agent_description().run(), after);
}

TEST(RunAndClock, TheServiceSaysTheKindOfItsClock) {
  const auto network = std::make_shared<FakeNetwork>();
  World world = ConnectTo(network);
  EXPECT_FALSE(world.world_lock_step());
  for (const bool simulated : {true, false}) {
    v1::ServiceStatus& status = *network->arriving.emplace_back().mutable_service_status();
    status.set_phase(v1::PHASE_SERVING);
    status.set_simulated_clock(simulated);
    world.Poll();
    EXPECT_EQ(world.world_lock_step(), simulated);
  }
}

// Goal:   the first states and the first clock are sent together, also where the grant arrives
//         before the word that the name is free: others rely on where the agents are then.
TEST(RunAndClock, NoStepIsTakenWhileAnotherProgramHasTheName) {
  using namespace std::chrono_literals;
  const auto network = std::make_shared<FakeNetwork>();
  World world = ConnectTo(network);
  network->Report(kRun - 1, kIncarnation + 1, true);
  EXPECT_FALSE(world.Join(0ns));
  EXPECT_NE(world.waits_for_name(), "");
  network->Grant(5);
  ASSERT_EQ(world.Join(0ns), 5);
  const Agent ball = world.AddAgent(Point(), {.stamp_ns = 5});
  EXPECT_EQ(world.AdvanceTo(5, 0ns), Advance::kTimeout);
  EXPECT_TRUE(network->States().empty());
  network->Report(kRun - 1, kIncarnation + 1, false);
  EXPECT_EQ(world.AdvanceTo(5, 0ns), Advance::kReached);
  EXPECT_EQ(world.AdvanceTo(6, 0ns), Advance::kTimeout);
  EXPECT_EQ(network->Clocks().back().clock_ns(), 5);
  EXPECT_EQ(network->Clocks().back().states_sequence(), 1u);
  ASSERT_FALSE(network->States().empty());
  EXPECT_EQ(network->States().back().states(0).stamp_ns(), 5);
}

}  // namespace
}  // namespace collision::client
