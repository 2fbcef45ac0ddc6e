// Goal:   a level watches who may meet and whom it names; its detectors share the budget of a step.
#include "server/detectors/level.h"

#include <gtest/gtest.h>

#include "server/config/config.h"
#include "server/detectors/detector_options.h"

namespace collision::server {
namespace {

TEST(Level, IsBetweenThoseThatItNames) {
  const ConfigResult result = ParseConfig(
      "classes { name: \"a\" meets: \"a\" meets: \"b\" } classes { name: \"b\" }"
      "levels { name: \"near\" margin_m: 1 between: \"a/b\" }"
      "levels { name: \"far\" margin_m: 2 look_ahead_s: 9 hysteresis_m: 3 basis: EXPECTED }",
      "F");
  ASSERT_TRUE(result.ok()) << result.errors[0];
  const std::vector<Level> levels = LevelsOf(result.config);
  ASSERT_EQ(levels.size(), 2u);
  const broad_phase::CollisionFilter none, a{.group = 2, .mask = 1 | 2 | 4},
      b{.group = 4, .mask = 1 | 2};
  const auto watched = [&](const auto& x, const auto& y) {
    return CanMeet(levels[0].FilterOf(x), levels[0].FilterOf(y));
  };
  EXPECT_TRUE(watched(a, b));
  EXPECT_FALSE(watched(a, a));
  EXPECT_FALSE(watched(b, b));
  EXPECT_FALSE(watched(a, none));
  EXPECT_FALSE(watched(none, none));
  EXPECT_TRUE(CanMeet(levels[1].FilterOf(a), levels[1].FilterOf(none)));
  EXPECT_FALSE(CanMeet(levels[1].FilterOf(b), levels[1].FilterOf(b))) << "they cannot meet at all";
  const broad_phase::CollisionFilter other{.group = 4, .mask = 1};
  EXPECT_FALSE(watched(broad_phase::CollisionFilter{.group = 2, .mask = 1}, other))
      << "a level names them, but they cannot meet";
  EXPECT_EQ(levels[0].look_ahead, result.config.announce_within_s());
  EXPECT_EQ(levels[1].look_ahead, 9);
  EXPECT_EQ(levels[1].hysteresis, 3);
}

TEST(Level, OfWhatIsExpectedLeavesOutForecastsOfThoseThatPass) {
  Level level;
  detection::CollisionEvent event;
  const auto tells = [&](v1::Level::Basis basis) {
    level.basis = basis;
    return level.Tells(event);
  };
  EXPECT_TRUE(tells(v1::Level::EXPECTED)) << "nothing is known of it";
  using enum detection::ExpectedOutcome;
  for (const auto& [outcome, told] :
       {std::pair(kTouch, true), {kUndecided, true}, {kPass, false}}) {
    event.expected.emplace().outcome = outcome;
    event.status = detection::EventStatus::kPossible;
    EXPECT_EQ(tells(v1::Level::EXPECTED), told);
    EXPECT_TRUE(tells(v1::Level::POSSIBLE));
    event.status = detection::EventStatus::kConfirmed;
    EXPECT_TRUE(tells(v1::Level::EXPECTED));
  }
}

TEST(Level, DetectorsShareTheBudgetOfAStep) {
  v1::Config config = CompleteConfig({});
  config.set_work_units_per_us(1);
  config.set_step_budget_us(1000);
  EXPECT_EQ(DetectorOptionsOf(config, 0).work_units_per_step, 1000u);
  EXPECT_EQ(DetectorOptionsOf(config, 2).work_units_per_step, 750u);
  EXPECT_EQ(LevelDetectorOptions(config, 2, 5).work_units_per_step, 125u);
  EXPECT_EQ(LevelDetectorOptions(config, 2, 5).announce_within, 5);
  config.set_step_budget_us(0);
  EXPECT_EQ(DetectorOptionsOf(config, 2).work_units_per_step, 0u) << "no limit stays none";
  EXPECT_EQ(LevelDetectorOptions(config, 2, 5).work_units_per_step, 0u);
}

}  // namespace
}  // namespace collision::server
