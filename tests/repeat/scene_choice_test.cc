// Goal:   every scene flies whole, and flights are only compared with others as long.
// Method: scenes by hand; what is left out has a reason.
#include "tests/repeat/scene_choice.h"

#include <gtest/gtest.h>

namespace collision::repeat {
namespace {

std::vector<std::string> Names(const std::vector<Series>& series) {
  std::vector<std::string> names;
  for (const Series& one : series) {
    names.push_back(one.name() + " " + std::to_string(static_cast<int>(one.seconds)));
  }
  return names;
}

TEST(SceneChoice, ALongSceneFliesItsPartAtFullSpeedAsWellAsAtRealTime) {
  EXPECT_EQ(Names(SeriesOf("a", 110, {}, AllConditions())),
            (std::vector<std::string>{"a/full-speed 110", "a/full-speed 20", "a/real-time 20",
                                      "a/starved-service 110", "a/starved-simulators 110",
                                      "a/slow-network 110"}));
}

TEST(SceneChoice, AShortSceneFliesWholeUnderEveryCondition) {
  EXPECT_EQ(Names(SeriesOf("a", 10, {}, AllConditions())),
            (std::vector<std::string>{"a/full-speed 10", "a/real-time 10", "a/starved-service 10",
                                      "a/starved-simulators 10", "a/slow-network 10"}));
}

TEST(SceneChoice, QuickFlightsAreAllOfOneLength) {
  for (const Series& series :
       SeriesOf("a", 110, {.quick = true, .part_seconds = 4}, AllConditions())) {
    EXPECT_EQ(series.seconds, 4) << series.name();
  }
}

TEST(SceneChoice, OnlyPicksByPartOfTheName) {
  EXPECT_EQ(Names(SeriesOf("a", 10, {.only = "a/real"}, AllConditions())),
            std::vector<std::string>{"a/real-time 10"});
}

TEST(SceneChoice, OnlyScenesWhoseTimeWaitsForEverythingAreRepeatable) {
  v1::Scene scene;
  v1::Clock& clock = *scene.mutable_config()->mutable_clock();
  clock.set_kind(v1::Clock::WALL);
  EXPECT_NE(WhyNotRepeatable(scene), "");
  clock.set_kind(v1::Clock::SIMULATED);
  EXPECT_EQ(WhyNotRepeatable(scene), "");
  clock.set_shape_wait_max_s(0);
  EXPECT_NE(WhyNotRepeatable(scene), "");
}

}  // namespace
}  // namespace collision::repeat
