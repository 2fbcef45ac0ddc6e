// Goal:   every scene flies whole under every condition; what is left out has a reason.
// Method: scenes by hand.
#include "tests/repeat/scene_choice.h"

#include <gtest/gtest.h>

namespace collision::repeat {
namespace {

std::vector<std::string> Names(const std::vector<Series>& series) {
  std::vector<std::string> names;
  for (const Series& one : series) names.push_back(one.name());
  return names;
}

TEST(SceneChoice, EveryConditionFliesTheWholeScene) {
  const std::vector<Series> series = SeriesOf("a", 110, {}, AllConditions());
  EXPECT_EQ(Names(series),
            (std::vector<std::string>{"a/full-speed", "a/real-time", "a/starved-service",
                                      "a/starved-simulators", "a/slow-network"}));
  for (const Series& one : series) EXPECT_EQ(one.seconds, 110) << one.name();
}

TEST(SceneChoice, OnlyAPacedSceneThatTakesTooLongIsFasterThanRealTime) {
  for (const double length : {30.0, 120.0, 600.0}) {
    for (const Series& one : SeriesOf("a", length, {.paced_max_s = 120}, AllConditions())) {
      const double paced = length > 120 ? length / 120 : 1;
      EXPECT_EQ(one.speed, one.condition.paced ? paced : 0) << one.name();
    }
  }
}

TEST(SceneChoice, SecondsAreThoseOfEveryFlight) {
  for (const Series& one : SeriesOf("a", 110, {.seconds = 4}, AllConditions()))
    EXPECT_EQ(one.seconds, 4) << one.name();
}

TEST(SceneChoice, OnlyPicksByPartOfTheName) {
  EXPECT_EQ(Names(SeriesOf("a", 10, {.only = "a/real"}, AllConditions())),
            std::vector<std::string>{"a/real-time"});
}

TEST(SceneChoice, OnlyScenesWhoseTimeWaitsForEverythingAreRepeatable) {
  v1::Scene scene;
  v1::Clock& clock = *scene.mutable_config()->mutable_clock();
  clock.set_kind(v1::Clock::REAL_TIME);
  EXPECT_NE(WhyNotRepeatable(scene), "");
  clock.set_kind(v1::Clock::LOCK_STEP);
  EXPECT_EQ(WhyNotRepeatable(scene), "");
  clock.set_shape_wait_max_s(0);
  EXPECT_NE(WhyNotRepeatable(scene), "");
}

}  // namespace
}  // namespace collision::repeat
