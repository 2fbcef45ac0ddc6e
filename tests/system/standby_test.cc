// Goal:   where a standby runs, the end or the standstill of the service costs nobody a contact.
// Method: two daemons with one configuration, two simulators in lock-step, a monitor; the daemon
//         that serves is killed, stopped and woken, or ended in good order for the next version.
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

/// All programs run; the first service serves, the second one stands by.
class StandbyTest : public testing::Test {
 protected:
  explicit StandbyTest(const std::string& lease_s = "0.1")
      : world_(83, "simulators_awaited: 2", "on_occupied: STAND_BY\nlease_s: " + lease_s + "\n") {}

  void Start(const std::string& second_program = "collisiond") {
    first_ = world_.StartDaemon();
    second_ = world_.LaunchDaemon({}, second_program);
    ASSERT_TRUE(second_->WaitForOutput("stands by")) << second_->err();
    monitor_ = world_.StartMonitor({"events", "--follow"});
    left_ = world_.StartSimulator(kLeft, kSlowly);
    right_ = world_.StartSimulator(kRight, kSlowly);
  }

  void AwaitEvent(const std::string& status) {
    ASSERT_TRUE(monitor_->WaitForOutput(status)) << monitor_->err();
  }

  void ExpectTakeOver() { EXPECT_TRUE(second_->WaitForOutput("in term 2")) << second_->err(); }

  /// Both fly to their end, and the monitor is told of their contact once.
  void ExpectOneContact() {
    EXPECT_EQ(left_->WaitForExit(), 0) << left_->err();
    EXPECT_EQ(right_->WaitForExit(), 0) << right_->err();
    EXPECT_TRUE(monitor_->WaitForOutput("ended")) << monitor_->out() << second_->err();
    EXPECT_EQ(Count(monitor_->out(), "confirmed"), 1u) << monitor_->out();
    EXPECT_EQ(Count(monitor_->out(), "ended"), 1u) << monitor_->out();
  }

  const TestWorld world_;
  std::unique_ptr<Process> first_, second_, monitor_, left_, right_;
};

TEST_F(StandbyTest, TakesOverFromOneThatIsKilled) {
  ASSERT_NO_FATAL_FAILURE(Start());
  ASSERT_NO_FATAL_FAILURE(AwaitEvent("confirmed"));
  EXPECT_TRUE(first_->WaitForOutput("has become a standby in this world")) << first_->err();
  first_->Signal(SIGKILL);
  ExpectOneContact();
  ExpectTakeOver();
  EXPECT_TRUE(Contains(second_->err(), "takes over from service ")) << second_->err();
  EXPECT_FALSE(Contains(second_->err(), "start it again, or evict it")) << second_->err();
}

TEST_F(StandbyTest, OneThatStoodStillFindsItselfReplaced) {
  ASSERT_NO_FATAL_FAILURE(Start());
  ASSERT_NO_FATAL_FAILURE(AwaitEvent("possible"));
  first_->Signal(SIGSTOP);
  ExpectTakeOver();
  // Before anybody has heard the successor the world would still be this one's.
  EXPECT_TRUE(monitor_->WaitForOutput("another service speaks")) << monitor_->err();
  first_->Signal(SIGCONT);
  EXPECT_TRUE(first_->WaitForOutput("goes before term 1: starts afresh, to stand by"))
      << first_->err();
  EXPECT_TRUE(world_.MonitorComesToSay({"status"}, "standby"));
  ExpectOneContact();
}

/// The standby stands still for longer than half its lease; a busy machine does not keep the other
/// one from its lease.
class StandbyOfLongLeaseTest : public StandbyTest {
 protected:
  StandbyOfLongLeaseTest() : StandbyTest("1") {}
};

TEST_F(StandbyOfLongLeaseTest, OneThatStoodStillItselfLeavesTheWorldToTheOther) {
  ASSERT_NO_FATAL_FAILURE(Start());
  ASSERT_NO_FATAL_FAILURE(AwaitEvent("possible"));
  second_->Signal(SIGSTOP);
  ASSERT_NO_FATAL_FAILURE(AwaitEvent("ended"));
  second_->Signal(SIGCONT);
  ExpectOneContact();
  EXPECT_FALSE(Contains(second_->err(), "in term 2")) << second_->err();
}

TEST_F(StandbyTest, TakesOverFromAnOlderVersionThatIsEnded) {
  ASSERT_NO_FATAL_FAILURE(Start("collisiond-next"));
  ASSERT_NO_FATAL_FAILURE(AwaitEvent("confirmed"));
  EXPECT_TRUE(world_.MonitorComesToSay({"status", "--json"}, "\"version\":\"next\""))
      << "the standby tells its version";
  first_->Signal(SIGTERM);
  ExpectTakeOver();
  EXPECT_EQ(first_->WaitForExit(), 0) << first_->err();
  const Outcome status = world_.Monitor({"status", "--json"});
  EXPECT_TRUE(Contains(status.out, "\"version\":\"next\"")) << status.out;
  EXPECT_TRUE(Contains(status.out, "\"phase\":\"serving\"")) << status.out;
  ExpectOneContact();
}

}  // namespace
}  // namespace collision::system_test
