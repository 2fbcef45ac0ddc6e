// Goal:   a simulator that joins a world in lock-step is told what time it is, and joins there: the
//         world waits for it, and nobody has to reckon with where it was before.
// Method: simulators with the library, over a daemon in the same thread.
#include <gtest/gtest.h>

#include <optional>

#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr std::int64_t kSecond = 1'000'000'000;

class JoinTest : public testing::Test {
 protected:
  World Connect(std::uint64_t sender, const std::string& name) {
    return service_.Connect(sender, {.simulator = name});
  }

  static AgentDescription Ball() {
    return {.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 1};
  }

  static State At(std::int64_t stamp_ns, double x) {
    return {.stamp_ns = stamp_ns, .position_m = {x, 0, 0}};
  }

  InProcessService service_{server::Simulated(), 1};
};

TEST_F(JoinTest, TheWorldWaitsAtTheTimeThatIsToldAndNobodyReckonsWithThePast) {
  World first = Connect(1, "first");
  Agent a = first.AddAgent(Ball(), At(0, 0));
  std::int64_t now_ns = 0;
  for (; now_ns <= 100 * kSecond; now_ns += kSecond / 10) {
    a.SetState(At(now_ns, 0));
    ASSERT_EQ(first.AdvanceTo(now_ns, seconds(10)), Advance::kReached);
  }

  World late = Connect(2, "late");
  const std::optional<std::int64_t> joins_ns = late.Join(seconds(10));
  ASSERT_TRUE(joins_ns);
  EXPECT_GE(*joins_ns, first.clock_ns());
  EXPECT_EQ(*joins_ns, first.granted_until_ns());

  // The world waits, however long the late one takes.
  a.SetState(At(*joins_ns, 0));
  ASSERT_EQ(first.AdvanceTo(*joins_ns, seconds(10)), Advance::kReached);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(first.AdvanceTo(*joins_ns + 1, nanoseconds(0)), Advance::kTimeout);
    service_.Step(0.001);
  }
  EXPECT_EQ(first.granted_until_ns(), *joins_ns);

  Agent b = late.AddAgent(Ball(), At(*joins_ns, 1e5));
  EXPECT_EQ(late.AdvanceTo(*joins_ns, seconds(10)), Advance::kReached);
  for (std::int64_t t = *joins_ns; t < *joins_ns + 3 * kSecond;) {
    t += kSecond / 10;
    for (World* world : {&first, &late}) {
      Agent& agent = world == &first ? a : b;
      agent.SetState(At(t, world == &first ? 0 : 1e5));
    }
    for (int tries = 0; tries < 1000 && (first.clock_ns() < t || late.clock_ns() < t); ++tries) {
      first.AdvanceTo(t, nanoseconds(0));
      late.AdvanceTo(t, nanoseconds(0));
      service_.Step(0.001);
    }
    ASSERT_EQ(first.clock_ns(), t);
    ASSERT_EQ(late.clock_ns(), t);
  }
  // No state of the first one was wanted since 0, so after t seconds more they may meet where
  // (100 + t)²/2 + t²/2 = 1e5 m: at 262 s. Had the late one begun at 0, too, it would be 216 s.
  EXPECT_GT(a.clearance().clear_until_ns, *joins_ns + 260 * kSecond);
  EXPECT_TRUE(late.TakeRejections().empty());
  EXPECT_GT(b.clearance().clear_until_ns, *joins_ns);
}

TEST_F(JoinTest, AWorldWhoseTimeHasNotBegunBeginsAtZero) {
  World world = Connect(1, "first");
  EXPECT_EQ(world.Join(seconds(10)), 0);
  Agent a = world.AddAgent(Ball(), At(0, 0));
  EXPECT_EQ(world.AdvanceTo(0, seconds(10)), Advance::kReached);
  a.SetState(At(kSecond, 0));
  EXPECT_EQ(world.AdvanceTo(kSecond, seconds(10)), Advance::kReached);
  EXPECT_TRUE(world.TakeRejections().empty());
  EXPECT_THROW(world.Join(seconds(1)), std::logic_error);
}

TEST_F(JoinTest, WhoAsksAndIsGoneHoldsNobodyUp) {
  World first = Connect(1, "first");
  Agent a = first.AddAgent(Ball(), At(0, 0));
  ASSERT_EQ(first.AdvanceTo(0, seconds(10)), Advance::kReached);
  std::optional<World> late = Connect(2, "late");
  ASSERT_TRUE(late->Join(seconds(10)));
  late.reset();
  service_.End(2, "late");
  a.SetState(At(10 * kSecond, 0));
  EXPECT_EQ(first.AdvanceTo(10 * kSecond, seconds(10)), Advance::kReached);
}

TEST_F(JoinTest, WhoGivesUpHoldsNobodyUpAndAnEarlierFirstClockIsRefused) {
  World first = Connect(1, "first");
  Agent a = first.AddAgent(Ball(), At(0, 0));
  std::int64_t now_ns = 0;
  const auto fly = [&](std::int64_t until_ns) {
    for (int tries = 0; tries < 1000 && now_ns < until_ns; ++tries) {
      a.SetState(At(now_ns, 0));
      if (first.AdvanceTo(now_ns, nanoseconds(0)) == Advance::kReached) now_ns += kSecond / 10;
      service_.Step(0.001);
    }
    return now_ns >= until_ns;
  };
  ASSERT_TRUE(fly(5 * kSecond));
  World late = Connect(2, "late");
  const std::optional<std::int64_t> joins_ns = late.Join(seconds(10));
  ASSERT_TRUE(joins_ns);
  EXPECT_THROW(late.AdvanceTo(*joins_ns - 1, nanoseconds(0)), std::invalid_argument);
  EXPECT_FALSE(fly(15 * kSecond)) << "the world waits for its first clock";
  late.Finish();
  EXPECT_TRUE(fly(15 * kSecond));
}

TEST_F(JoinTest, WithoutTimeToWaitThereIsNoAnswer) {
  World first = Connect(1, "first");
  EXPECT_EQ(first.Join(nanoseconds(0)), std::nullopt);
}

}  // namespace
}  // namespace collision::client
