// Goal:   who is restless beside whom is a matter of the declared accelerations of the two alone, never
//         within 8 times and surely from 64 times; and whoever is there, or not, is known.
// Method: random bounds of all magnitudes against their ratio; agents come, change and leave, beside a
//         look at all.
#include "collision_core/detection/restlessness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr int kCalm = Restlessness::kCalm;

bool IsRestless(const Restlessness& scene, std::uint32_t partner, std::uint32_t beside) {
  const int group = scene.GroupOf(partner, beside);
  EXPECT_TRUE(group == kCalm || group == scene.of(partner));
  return group != kCalm;
}

std::vector<int> RestlessBeside(const Restlessness& scene, std::uint32_t agent) {
  std::vector<int> classes;
  scene.RestlessBeside(agent, &classes);
  return classes;
}

TEST(Restlessness, GoesByTheRatioOfTheAccelerations) {
  Random random(1);
  int restless = 0;
  for (int i = 0; i < 10000; ++i) {
    const double calm = random.LogUniform(1e-9, 1e9), ratio = random.LogUniform(1e-3, 1e6);
    Restlessness scene;
    scene.Set(0, calm);
    scene.Set(1, calm * ratio);
    const bool is_restless = IsRestless(scene, 1, 0);
    restless += is_restless;
    EXPECT_FALSE(IsRestless(scene, 0, 0));
    EXPECT_FALSE(ratio < 8 && is_restless) << calm << " " << ratio;
    EXPECT_FALSE(ratio >= 64.0001 && !is_restless) << calm << " " << ratio;
    EXPECT_EQ(RestlessBeside(scene, 0).size(), is_restless ? 1u : 0u);
  }
  EXPECT_GT(restless, 1000);
}

TEST(Restlessness, ExtremesAreClassesToo) {
  Restlessness scene;
  const double bounds[] = {0, 5e-324, 1e-300, 1, 1e18, 1e300, INFINITY};
  for (std::uint32_t k = 0; k < 7; ++k) scene.Set(k, bounds[k]);
  EXPECT_TRUE(IsRestless(scene, 6, 1));
  EXPECT_TRUE(IsRestless(scene, 3, 2));
  EXPECT_LT(scene.of(6), Restlessness::kClasses);
}

// Beside one that declares none, everybody who declares any.
TEST(Restlessness, NoneIsCalmerThanAny) {
  Restlessness scene;
  const double bounds[] = {0, 5e-324, 1e-300, 1, 1e18, 0};
  for (std::uint32_t k = 0; k < 6; ++k) scene.Set(k, bounds[k]);
  for (std::uint32_t k = 1; k < 5; ++k) EXPECT_TRUE(IsRestless(scene, k, 0)) << k;
  for (std::uint32_t k = 0; k < 6; ++k) EXPECT_FALSE(IsRestless(scene, 5, k)) << k;
}

// Of those that declare none only so many are asked about each other by themselves.
TEST(Restlessness, NotWhereManyDeclareNone) {
  constexpr std::uint32_t kMost = Restlessness::kDeclareNoneMax;
  Restlessness scene;
  scene.Set(0, 1);
  scene.Set(1, 1e3);
  for (std::uint32_t k = 0; k < kMost; ++k) {
    scene.Set(2 + k, 0);
    EXPECT_TRUE(scene.Divides(2) && IsRestless(scene, 0, 2));
  }
  scene.Set(2 + kMost, 0);
  EXPECT_FALSE(scene.Divides(2) || IsRestless(scene, 0, 2) || IsRestless(scene, 1, 2));
  EXPECT_TRUE(RestlessBeside(scene, 2).empty());
  EXPECT_TRUE(scene.Divides(0) && IsRestless(scene, 1, 0));
  scene.Remove(5);
  EXPECT_TRUE(scene.Divides(2) && IsRestless(scene, 0, 2));
  EXPECT_EQ(scene.Count(0), kMost);
}

TEST(Restlessness, KnowsWhoIsThere) {
  constexpr std::uint32_t kAgents = 12;
  Random random(2);
  Restlessness scene;
  for (std::uint32_t k = 0; k < kAgents; ++k) scene.Set(k, 1);
  for (int i = 0; i < 5000; ++i) {
    const auto agent = static_cast<std::uint32_t>(random.Below(kAgents));
    if (random.Chance(0.5)) {
      scene.Remove(agent);
    } else {
      scene.Set(agent, random.Chance(0.1) ? 0 : random.LogUniform(1e-3, 1e3));
    }
    for (std::uint32_t beside = 0; beside < kAgents; ++beside) {
      std::vector<int> classes;
      for (std::uint32_t k = 0; k < kAgents; ++k) {
        if (IsRestless(scene, k, beside)) classes.push_back(scene.of(k));
      }
      std::sort(classes.begin(), classes.end());
      std::uint32_t counted = 0;
      for (const int of_class : RestlessBeside(scene, beside)) counted += scene.Count(of_class);
      ASSERT_EQ(counted, classes.size());
      classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
      ASSERT_EQ(RestlessBeside(scene, beside), classes);
    }
  }
  EXPECT_EQ(scene.Count(Restlessness::kNobody), 0u);
}

}  // namespace
}  // namespace collision::detection
