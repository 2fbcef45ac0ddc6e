// Goal:   a killed process, simulator or daemon, is survived as the configuration says.
// Method: SIGKILL at a point of the run that the test waits for, then see which processes go on.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

TEST(Crash, KilledSimulatorIsWaitedFor) {
  const TestWorld world(64, "simulators_awaited: 2 on_silent_simulator: WAIT");
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"right\""));
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"left\""));
  left->Signal(SIGKILL);
  ASSERT_EQ(left->WaitForExit(), 128 + SIGKILL);
  // Its silence is known, and the other stands still until it is back.
  ASSERT_TRUE(world.MonitorComesToSay({"status", "--json"}, "\"alive\":false")) << daemon->err();
  EXPECT_FALSE(right->WaitForExit(std::chrono::seconds(1)).has_value()) << right->err();
  const auto left_again = world.StartSimulator(kLeft);
  EXPECT_EQ(left_again->WaitForExit(), 0) << left_again->err() << daemon->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

// As long as the old one counts as alive, its successor is a stranger.
TEST(Crash, SuccessorThatStartsAtOnceTakesOver) {
  const TestWorld world(69);
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"left\""));
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"right\""));
  // A run's number is the second of its start.
  EXPECT_FALSE(right->WaitForExit(std::chrono::seconds(1)).has_value()) << right->err();
  const auto left_again = world.StartSimulator(kLeft);
  EXPECT_TRUE(daemon->WaitForOutput("ID_OWNED")) << daemon->err();
  left->Signal(SIGKILL);
  ASSERT_EQ(left->WaitForExit(), 128 + SIGKILL);
  EXPECT_EQ(left_again->WaitForExit(), 0) << left_again->err() << daemon->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

TEST(Crash, KilledSimulatorIsReleased) {
  const TestWorld world(65,
                        "simulators_awaited: 2 on_silent_simulator: RELEASE release_after_s: 4 "
                        "waiting_after_s: 0.5");
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  // Left lives and hardly moves; it too would be released.
  ASSERT_TRUE(daemon->WaitForOutput("was granted time and has not made its next step"))
      << daemon->err();
  left->Signal(SIGKILL);
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

// It lives, and lingers where its data ends: the other one goes on without it.
TEST(Crash, ASimulatorThatStandsIsReleased) {
  const TestWorld world(80,
                        "simulators_awaited: 2 on_silent_simulator: RELEASE release_after_s: 0.5");
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
  EXPECT_TRUE(daemon->WaitForOutput("goes on without simulator \"left-sim\"")) << daemon->err();
}

TEST(Crash, RestartedDaemonRecoversFromTheNetworkAlone) {
  const TestWorld world(66);
  auto first = world.StartDaemon();
  const auto events = world.StartMonitor({"events", "--follow"});
  const auto left = world.StartSimulator(kLeft, {"--speed", "1"});
  const auto right = world.StartSimulator(kRight, {"--speed", "1"});
  // Announced at most two seconds before 4.5 s, so half of the run is still to come.
  ASSERT_TRUE(events->WaitForOutput("possible")) << events->err();
  first->Signal(SIGKILL);
  ASSERT_EQ(first->WaitForExit(), 128 + SIGKILL);

  const auto second = world.StartDaemon();
  EXPECT_TRUE(events->WaitForOutput("confirmed")) << events->out() << second->err();
  EXPECT_TRUE(events->WaitForOutput("ended")) << events->out() << second->err();
  EXPECT_EQ(left->WaitForExit(), 0) << left->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err();
}

}  // namespace
}  // namespace collision::system_test
