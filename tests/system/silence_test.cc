// Goal:   who holds up the world, or has left agents behind, is seen from outside, and an operator
//         can help; a daemon that is started again waits for those that it served before.
// Method: real processes that are stopped, killed and evicted.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

constexpr int kRefused = 1;
constexpr int kUnavailable = 69;

TEST(SilenceOfPrograms, AGhostIsShownAndCanBeEvicted) {
  const TestWorld world(81, "simulators_awaited: 2 waiting_after_s: 0.5");
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"right\""));
  // Left lives and does not move.
  ASSERT_TRUE(daemon->WaitForOutput("was granted time and has not made its next step"))
      << daemon->err();
  EXPECT_TRUE(world.MonitorComesToSay({"status", "--json"}, "\"left-sim\"")) << daemon->err();
  left->Signal(SIGKILL);
  ASSERT_EQ(left->WaitForExit(), 128 + SIGKILL);
  ASSERT_TRUE(world.MonitorComesToSay({"agents"}, "held: its simulator is not heard"))
      << daemon->err();
  EXPECT_TRUE(world.MonitorComesToSay({"agents"}, "left-sim:0.1"));
  const Outcome wrong = world.Monitor({"evict", "nobody"});
  EXPECT_EQ(wrong.status, kRefused);
  EXPECT_TRUE(Contains(wrong.err, "no simulator \"nobody\" in this world; known: left-sim, right"))
      << wrong.err;
  const Outcome refused = world.Monitor({"evict", "nobody", "--json"});
  EXPECT_EQ(refused.status, kRefused);
  EXPECT_TRUE(refused.out.ends_with("\"}\n")) << refused.out;
  EXPECT_TRUE(Contains(refused.out, "\"done\":false,\"answer\":\"no simulator ")) << refused.out;
  const Outcome evicted = world.Monitor({"evict", "left-sim"});
  EXPECT_EQ(evicted.status, 0) << evicted.err;
  EXPECT_TRUE(Contains(evicted.out, "simulator \"left-sim\" is removed with its 1 agents"));
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

TEST(SilenceOfPrograms, WithoutAServiceAnOperatorIsTold) {
  const TestWorld world(77);
  const Outcome alone = world.Monitor({"restart-time", "--timeout", "0.2"});
  EXPECT_EQ(alone.status, kUnavailable);
  EXPECT_TRUE(Contains(alone.err, "no service in world"));
  EXPECT_EQ(world.Monitor({"evict", "a.b"}).status, 2);
}

TEST(SilenceOfPrograms, TimeBeginsAnew) {
  const TestWorld world(78, "simulators_awaited: 1");
  const auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"left\""));
  const Outcome restarted = world.Monitor({"restart-time", "--json"});
  EXPECT_EQ(restarted.status, 0) << restarted.err;
  EXPECT_TRUE(Contains(restarted.out, "\"done\":true,\"answer\":\"the world's time begins anew"))
      << restarted.out;
  EXPECT_TRUE(restarted.out.ends_with("\"}\n")) << restarted.out;
  EXPECT_TRUE(world.MonitorComesToSay({"status", "--json"}, "\"epoch\":2")) << daemon->err();
}

TEST(SilenceOfPrograms, ADaemonStartedAgainWaitsForWhoIsOutOfReach) {
  const TestWorld world(79);
  auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, kHardlyMoves);
  const auto right = world.StartSimulator(kRight);
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"right\""));
  ASSERT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"left\""));
  left->Signal(SIGKILL);
  ASSERT_EQ(left->WaitForExit(), 128 + SIGKILL);
  daemon->Signal(SIGKILL);
  ASSERT_EQ(daemon->WaitForExit(), 128 + SIGKILL);
  daemon = world.StartDaemon();
  ASSERT_TRUE(daemon->WaitForOutput("waits for simulator \"left-sim\"")) << daemon->err();
  EXPECT_TRUE(Contains(daemon->err(), "the service before this one served it")) << daemon->err();
  EXPECT_FALSE(right->WaitForExit(std::chrono::seconds(1)).has_value()) << right->err();
  const auto left_again = world.StartSimulator(kLeft);
  EXPECT_EQ(left_again->WaitForExit(), 0) << left_again->err() << daemon->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

}  // namespace
}  // namespace collision::system_test
