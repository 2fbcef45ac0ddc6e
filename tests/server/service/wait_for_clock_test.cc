// Goal:   the wait for the wall clock ends as soon as it is right, after the longest time, when the
//         program is to stop, and at once where the system does not say.
// Method: a system that answers as the test says, and pauses that only count.
#include "server/service/wait_for_clock.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

constexpr std::chrono::seconds kLongest(1);

class WaitForClockTest : public testing::Test {
 protected:
  ClockWait Wait() {
    return WaitForClock(
        kLongest, [this] { return says_; },
        [this](std::chrono::nanoseconds period) {
          paused_ += period;
          if (paused_ >= right_after_) says_ = true;
          return paused_ < stopped_after_;
        });
  }

  std::optional<bool> says_ = false;
  std::chrono::nanoseconds paused_{0};
  std::chrono::nanoseconds right_after_ = std::chrono::hours(1);
  std::chrono::nanoseconds stopped_after_ = std::chrono::hours(1);
};

TEST_F(WaitForClockTest, AClockThatIsRightIsNotWaitedFor) {
  says_ = true;
  EXPECT_EQ(Wait(), ClockWait::kSynchronised);
  EXPECT_EQ(paused_.count(), 0);
}

TEST_F(WaitForClockTest, EndsWhenTheClockIsRight) {
  right_after_ = std::chrono::milliseconds(300);
  EXPECT_EQ(Wait(), ClockWait::kSynchronised);
  EXPECT_EQ(paused_, right_after_);
}

TEST_F(WaitForClockTest, EndsAfterTheLongestTime) {
  EXPECT_EQ(Wait(), ClockWait::kTimeout);
  EXPECT_EQ(paused_, kLongest);
}

TEST_F(WaitForClockTest, EndsWithTheProgram) {
  stopped_after_ = std::chrono::milliseconds(200);
  EXPECT_EQ(Wait(), ClockWait::kStopped);
  EXPECT_EQ(paused_, stopped_after_);
}

TEST_F(WaitForClockTest, DoesNotWaitWhereTheSystemDoesNotSay) {
  says_ = std::nullopt;
  EXPECT_EQ(Wait(), ClockWait::kNotToldBySystem);
  EXPECT_EQ(paused_.count(), 0);
}

}  // namespace
}  // namespace collision::server
