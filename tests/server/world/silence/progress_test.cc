// Goal:   a simulator that the world waits for is named once it has stood for the configured time,
//         and never while it tells anything; only one that others wait for holds them up.
// Method: steps written by hand, and random ones beside a plain model.
#include "server/world/silence/progress.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr std::int64_t kNamedAfter = 100;  ///< [ns]

TimeHolder Last(std::uint64_t id, std::int64_t clock_ns, std::uint64_t told = 0,
                bool others_wait = true) {
  return {.id = id, .is_last = true, .others_wait = others_wait, .told = {clock_ns, told}};
}

TEST(Progress, WhoStandsIsNamedAfterTheConfiguredTimeAndNotBefore) {
  Progress progress(kNamedAfter);
  progress.Update({Last(1, 0)}, 1000);
  EXPECT_EQ(progress.NextDue(1000), 1000 + kNamedAfter);
  progress.Update({Last(1, 0)}, 1000 + kNamedAfter - 1);
  EXPECT_FALSE(progress.IsNamed(1, 1000 + kNamedAfter - 1));
  EXPECT_TRUE(progress.IsNamed(1, 1000 + kNamedAfter));
  EXPECT_EQ(progress.NextDue(1000 + kNamedAfter), std::nullopt);
  EXPECT_EQ(progress.HoldsUpSince(1), 1000);
}

TEST(Progress, AClockOrAnythingElseThatItTellsIsProgress) {
  Progress progress(kNamedAfter);
  progress.Update({Last(1, 0, 0)}, 0);
  progress.Update({Last(1, 1, 0)}, 50);
  EXPECT_EQ(progress.StandsSince(1), 50);
  progress.Update({Last(1, 1, 1)}, 90);
  EXPECT_EQ(progress.StandsSince(1), 90);
  EXPECT_EQ(progress.HoldsUpSince(1), 90);
}

TEST(Progress, WhoIsNotTheLastOneIsNotWaitedFor) {
  Progress progress(kNamedAfter);
  progress.Update({Last(1, 0), {.id = 2, .told = {5, 0}}}, 0);
  EXPECT_EQ(progress.StandsSince(2), std::nullopt);
  // Nothing of 1 has changed, but another one was the last in between.
  progress.Update({{.id = 1, .told = {0, 0}}, Last(2, 5)}, 60);
  progress.Update({Last(1, 0)}, 70);
  EXPECT_EQ(progress.StandsSince(1), 70);
  EXPECT_EQ(progress.StandsSince(2), std::nullopt);
  EXPECT_FALSE(progress.IsNamed(7, 1000)) << "unknown";
}

TEST(Progress, HoldsUpNobodyWhileNobodyWaits) {
  Progress progress(kNamedAfter);
  progress.Update({Last(1, 0, 0, false)}, 0);
  progress.Update({Last(1, 0, 0, false)}, kNamedAfter);
  EXPECT_TRUE(progress.IsNamed(1, kNamedAfter));
  EXPECT_EQ(progress.HoldsUpSince(1), std::nullopt);
  progress.Update({Last(1, 0, 0, true)}, 200);
  EXPECT_EQ(progress.HoldsUpSince(1), 200);
  EXPECT_EQ(progress.StandsSince(1), 0);
}

TEST(Progress, RandomStepsAgreeWithAPlainModel) {
  Random random(1);
  Progress progress(kNamedAfter);
  struct Model {
    std::uint64_t told = 0;
    std::int64_t stands_since = -1;
  } models[4];
  std::int64_t now_ns = 0;
  int named = 0;
  for (int step = 0; step < 20'000; ++step) {
    now_ns += static_cast<std::int64_t>(random.Below(40));
    std::vector<TimeHolder> holders;
    for (std::uint64_t id = 0; id < 4; ++id) {
      Model& model = models[id];
      const bool moved = random.Chance(0.1);
      const bool is_last = random.Chance(0.9);
      if (moved) ++model.told;
      if (!is_last) {
        model.stands_since = -1;
      } else if (moved || model.stands_since < 0) {
        model.stands_since = now_ns;
      }
      holders.push_back({.id = id, .is_last = is_last, .told = {0, model.told}});
    }
    progress.Update(holders, now_ns);
    for (std::uint64_t id = 0; id < 4; ++id) {
      const std::int64_t since = models[id].stands_since;
      const bool expected = since >= 0 && now_ns - since >= kNamedAfter;
      ASSERT_EQ(progress.IsNamed(id, now_ns), expected) << "step " << step;
      named += expected;
    }
  }
  EXPECT_GT(named, 1000);
}

}  // namespace
}  // namespace collision::server
