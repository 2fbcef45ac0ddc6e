// Goal:   collisionctl shows a live world as it is, and says so when there is none.
// Method: two simulators fly head-on and stay at the end; everything it can be asked is known.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

void ExpectAll(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "no " << part << " in\n" << text;
  }
}

TEST(Monitor, ShowsALiveWorld) {
  const TestWorld world(62);
  const auto daemon = world.StartDaemon();
  const auto events = world.StartMonitor({"events", "--follow"});
  const auto left = world.StartSimulator(kLeft, {"--linger"});
  const auto right = world.StartSimulator(kRight, {"--linger"});
  ASSERT_TRUE(events->WaitForOutput("ended")) << events->out() << events->err();
  // If a contact was over before the follower started, only its last revision is kept for it.
  ExpectAll(events->out(), {"left × right", "begin [", "end ["});

  // A status is published once a second, and all this may have taken less; on a busy machine the
  // first query may also end before every simulator was found.
  EXPECT_TRUE(world.MonitorComesToSay({"status", "--json"}, "left-sim"));
  EXPECT_TRUE(world.MonitorComesToSay({"status", "--json"}, "right-sim"));
  EXPECT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"left\""));
  EXPECT_TRUE(world.MonitorComesToSay({"agents", "--json"}, "\"right\""));
  EXPECT_TRUE(world.MonitorComesToSay({"events", "--json"}, "\"status\":\"ended\""));
  EXPECT_TRUE(world.MonitorComesToSay({"earliest", "--json"}, "earliest_ns"));
  EXPECT_TRUE(
      world.MonitorComesToSay({"suggest-bounds", "--live", "--seconds", "0.5"}, "left-sim/left "));
  const Outcome health = world.Monitor({"health", "--require-simulators", "2"});
  EXPECT_EQ(health.status, 0) << health.out << health.err;
  EXPECT_TRUE(Contains(health.out, "WELL")) << health.out;
  EXPECT_EQ(world.Monitor({"health", "--require-simulators", "3"}).status, 2);
  // It stands still: what is kept for those who come late is no sign of life.
  daemon->Signal(SIGSTOP);
  const Outcome still = world.Monitor({"health", "--max-age", "2"});
  EXPECT_EQ(still.status, 2) << still.out;
  daemon->Signal(SIGCONT);
  for (const char* word : {"status", "agents", "events", "earliest"}) {
    const Outcome text = world.Monitor({word});
    EXPECT_EQ(text.status, 0) << word << text.err;
    EXPECT_NE(text.out, "") << word;
  }
}

TEST(Monitor, SaysWhenThereIsNoService) {
  const TestWorld world(63);
  const Outcome outcome = world.Monitor({"status", "--timeout", "0.2"});
  EXPECT_EQ(outcome.status, 69);
  EXPECT_NE(outcome.err, "");
  const Outcome health = world.Monitor({"health", "--max-age", "0.2"});
  EXPECT_EQ(health.status, 2);
  EXPECT_TRUE(Contains(health.out, "CRITICAL: no service is heard in world")) << health.out;
  EXPECT_EQ(world.Monitor({"suggest-bounds", "--live", "--timeout", "0.2"}).status, 69);
}

TEST(Monitor, WrongWordsAreAUsageError) {
  EXPECT_EQ(RunToEnd({Program("collisionctl"), "no-such-word"}).status, 2);
  EXPECT_EQ(RunToEnd({Program("collisionctl"), "status", "--no-such-option"}).status, 2);
  EXPECT_EQ(RunToEnd({Program("collisionctl"), "suggest-bounds"}).status, 2);
  const Outcome domain = RunToEnd({Program("collisionctl"), "health"}, {"COLLISION_DOMAIN=abc"});
  EXPECT_EQ(domain.status, 2);
  EXPECT_TRUE(Contains(domain.err, "COLLISION_DOMAIN: abc, allowed: 0 to 230")) << domain.err;
  EXPECT_EQ(RunToEnd({Program("collisionctl"), "suggest-bounds", "no such file"}).status, 66);
}

}  // namespace
}  // namespace collision::system_test
