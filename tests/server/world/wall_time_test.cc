// Goal:   the world's time follows the wall clock through everything that happens to it, never goes
//         back, and tells every step of it from what is none.
// Method: readings of both clocks, written by hand.
#include "server/world/wall_clock/wall_time.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSkew = 2 * kMillisecond;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;

/// Both clocks, and the world's time that follows them.
class WallTimeTest : public testing::Test {
 protected:
  WallTimeTest() { EXPECT_EQ(Read(), std::nullopt); }

  std::optional<ClockStep> Read(bool was_set = false) {
    return time_.Take({.wall_ns = wall_ns_, .monotonic_ns = steady_ns_, .wall_was_set = was_set});
  }
  /// Both clocks go on by the same time; the wall clock is set by `set_ns` beside that.
  std::optional<ClockStep> Pass(std::int64_t ns, std::int64_t set_ns = 0, bool was_set = false) {
    steady_ns_ += ns;
    wall_ns_ += ns + set_ns;
    return Read(was_set);
  }
  std::int64_t now() const { return time_.now().nanoseconds() - kStart; }

  WallTime time_{kSkew};
  std::int64_t wall_ns_ = kStart;
  std::int64_t steady_ns_ = 0;
};

TEST_F(WallTimeTest, FollowsTheClock) {
  EXPECT_EQ(now(), 0);
  EXPECT_FALSE(Pass(kSecond));
  EXPECT_EQ(now(), kSecond);
  EXPECT_EQ(time_.earliest_stamp(), Instant::Always());
  EXPECT_EQ(time_.echoes_after(), Instant::Always());
}

TEST_F(WallTimeTest, AMachineThatSleptIsNoStep) {
  EXPECT_FALSE(Pass(8 * 3600 * kSecond, 0, true)) << "the system may say that the clock was set";
  EXPECT_EQ(now(), 8 * 3600 * kSecond);
}

TEST_F(WallTimeTest, SlewingIsFollowedQuietly) {
  // 500 ppm for a minute: 30 ms in all, far more than the bound on skew.
  for (int i = 0; i < 3600; ++i) EXPECT_FALSE(Pass(kSecond / 60, kSecond / 60 / 2000));
  EXPECT_EQ(now(), 60 * (kSecond / 60 * 60) + 3600 * (kSecond / 60 / 2000));
  for (int i = 0; i < 3600; ++i) EXPECT_FALSE(Pass(kSecond / 60, -kSecond / 60 / 2000));
  EXPECT_EQ(time_.now(), time_.reading());
}

TEST_F(WallTimeTest, AStepWithinTheSkewIsFollowedAndTold) {
  const auto step = Pass(kMillisecond, kSkew);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->by_ns, kSkew);
  EXPECT_EQ(step->to.nanoseconds(), kStart + kMillisecond + kSkew);
  EXPECT_FALSE(step->breaks);
  EXPECT_EQ(now(), kMillisecond + kSkew);
  EXPECT_EQ(time_.echoes_after().nanoseconds(), kStart);
}

TEST_F(WallTimeTest, AfterAStepBackWithinTheSkewTimeStandsUntilTheClockHasCaughtUp) {
  Pass(kSecond);
  const auto step = Pass(0, -kMillisecond);
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->breaks);
  EXPECT_EQ(now(), kSecond);
  EXPECT_EQ(time_.reading().nanoseconds(), kStart + kSecond - kMillisecond);
  EXPECT_FALSE(Pass(kMillisecond / 2));
  EXPECT_EQ(now(), kSecond);
  EXPECT_FALSE(Pass(kMillisecond));
  EXPECT_EQ(now(), kSecond + kMillisecond / 2);
  EXPECT_LT(time_.echoes_after(), time_.now());
}

TEST_F(WallTimeTest, AStepBeyondTheSkewBreaksTheTimeUntilItIsRestarted) {
  for (const std::int64_t by_ns : {5 * kSecond, -12 * kSecond, kSkew + 1, -kSkew - 1}) {
    Pass(kSecond);
    const Instant before = time_.now();
    const auto step = Pass(0, by_ns);
    ASSERT_TRUE(step) << by_ns;
    EXPECT_EQ(step->by_ns, by_ns);
    EXPECT_TRUE(step->breaks) << by_ns;
    EXPECT_EQ(time_.now(), before) << "until what was told of the former time is closed";
    time_.Restart();
    EXPECT_EQ(time_.now(), time_.reading());
    EXPECT_FALSE(Pass(kMillisecond));
    EXPECT_EQ(time_.now(), time_.reading());
  }
}

TEST_F(WallTimeTest, TheClockOfAMachineThatStartsIn1970IsFollowed) {
  WallTime time(kSkew);
  EXPECT_FALSE(time.Take({.wall_ns = 30 * kSecond, .monotonic_ns = kSecond}));
  const auto step = time.Take({.wall_ns = kStart, .monotonic_ns = 2 * kSecond});
  ASSERT_TRUE(step && step->breaks);
  time.Restart();
  EXPECT_EQ(time.now().nanoseconds(), kStart);
}

TEST_F(WallTimeTest, AStepSmallerThanSlewingIsToldWhereTheSystemTellsOfIt) {
  constexpr std::int64_t kSmall = kMillisecond;
  EXPECT_FALSE(Pass(10 * kSecond, kSmall)) << "10 s of slewing explain 5 ms";
  EXPECT_TRUE(Pass(10 * kSecond, kSmall, true));
  EXPECT_FALSE(Pass(10 * kSecond, kReadingErrorNs, true)) << "two readings explain it";
}

TEST_F(WallTimeTest, ANewEpochTakesNoStampOfTheFormerTime) {
  Pass(kSecond, 5 * kSecond);
  time_.Restart();
  EXPECT_EQ(time_.earliest_stamp().nanoseconds(), kStart + 6 * kSecond - kSkew);
  Pass(kSecond, -12 * kSecond);
  time_.Restart();
  EXPECT_EQ(time_.earliest_stamp().nanoseconds(), time_.now().nanoseconds() - kSkew);
}

// Stamps of the former time reach to its end: until the clock has passed that, they could be taken
// for new ones.
TEST_F(WallTimeTest, AfterASmallStepBackTheEpochBeginsWhereTheFormerOneEnded) {
  Pass(kSecond);
  const Instant end = time_.now();
  Pass(0, -10 * kMillisecond);
  time_.Restart();
  EXPECT_EQ(time_.earliest_stamp().nanoseconds(), end.nanoseconds() + kSkew);
  EXPECT_LT(time_.now(), end);
}

TEST_F(WallTimeTest, TwoStepsBeforeARestartAreOne) {
  Pass(kSecond, -kSecond / 2);
  const Instant end = time_.now();
  const auto second = Pass(kSecond, kMillisecond);
  ASSERT_TRUE(second && second->breaks);
  EXPECT_EQ(time_.now(), end);
  time_.Restart();
  EXPECT_EQ(time_.earliest_stamp().nanoseconds(), end.nanoseconds() + kSkew);
}

}  // namespace
}  // namespace collision::server
