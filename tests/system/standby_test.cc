// Goal:   where a standby runs, the end or the standstill of the service costs nobody a contact.
// Method: two daemons with one configuration, two simulators in lock-step, a monitor; the daemon
//         that serves is killed, stopped and woken, or ended in good order.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

/// The flight of 10 s takes 5 s.
const std::vector<std::string> kSlowly = {"--speed", "2"};

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

class StandbyTest : public testing::Test {
 protected:
  explicit StandbyTest(int domain = 83) : world_(domain, "simulators_awaited: 2", kConfig) {}

  static constexpr char kConfig[] = "on_occupied: STAND_BY\nlease_s: 0.1\n";

  std::unique_ptr<Process> StartStandby() const {
    auto daemon = world_.LaunchDaemon();
    EXPECT_TRUE(daemon->WaitForOutput("stands by")) << daemon->err();
    return daemon;
  }

  /// Both fly to their end, and the monitor is told of their contact once.
  void ExpectOneContact(Process* left, Process* right, Process* monitor) const {
    EXPECT_EQ(left->WaitForExit(), 0) << left->err();
    EXPECT_EQ(right->WaitForExit(), 0) << right->err();
    EXPECT_TRUE(monitor->WaitForOutput("ended")) << monitor->out();
    EXPECT_EQ(Count(monitor->out(), "confirmed"), 1u) << monitor->out();
    EXPECT_EQ(Count(monitor->out(), "ended"), 1u) << monitor->out();
  }

  const TestWorld world_;
};

TEST_F(StandbyTest, TakesOverFromOneThatIsKilled) {
  const auto first = world_.StartDaemon();
  const auto second = StartStandby();
  const auto monitor = world_.StartMonitor({"events", "--follow"});
  const auto left = world_.StartSimulator(kLeft, kSlowly);
  const auto right = world_.StartSimulator(kRight, kSlowly);
  ASSERT_TRUE(monitor->WaitForOutput("confirmed")) << monitor->err();
  first->Signal(SIGKILL);
  ExpectOneContact(left.get(), right.get(), monitor.get());
  EXPECT_TRUE(second->WaitForOutput("in term 2")) << second->err();
}

TEST_F(StandbyTest, OneThatStoodStillFindsItselfReplaced) {
  const auto first = world_.StartDaemon();
  const auto second = StartStandby();
  const auto monitor = world_.StartMonitor({"events", "--follow"});
  const auto left = world_.StartSimulator(kLeft, kSlowly);
  const auto right = world_.StartSimulator(kRight, kSlowly);
  ASSERT_TRUE(monitor->WaitForOutput("possible")) << monitor->err();
  first->Signal(SIGSTOP);
  EXPECT_TRUE(second->WaitForOutput("in term 2")) << second->err();
  first->Signal(SIGCONT);
  EXPECT_TRUE(first->WaitForOutput("goes before term 1: stands by")) << first->err();
  EXPECT_TRUE(world_.MonitorComesToSay({"status"}, "standby"));
  ExpectOneContact(left.get(), right.get(), monitor.get());
}

// As an upgrade does it: the new version stands by, the old one is ended.
TEST_F(StandbyTest, TakesOverFromOneThatIsEnded) {
  const auto first = world_.StartDaemon();
  const auto second = StartStandby();
  const auto monitor = world_.StartMonitor({"events", "--follow"});
  const auto left = world_.StartSimulator(kLeft, kSlowly);
  const auto right = world_.StartSimulator(kRight, kSlowly);
  ASSERT_TRUE(monitor->WaitForOutput("confirmed")) << monitor->err();
  first->Signal(SIGTERM);
  ExpectOneContact(left.get(), right.get(), monitor.get());
  EXPECT_EQ(first->WaitForExit(), 0) << first->err();
  EXPECT_TRUE(second->WaitForOutput("in term 2")) << second->err();
}

}  // namespace
}  // namespace collision::system_test
