// Goal:   who is restless beside whom is a matter of the declared accelerations alone, never within
//         16 times and surely from 256 times; and whoever is there, or not, is known.
// Method: random bounds of all magnitudes against their ratio; agents come, change and leave, beside a
//         look at all.
#include "collision_core/detection/restlessness.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace collision {
namespace {

TEST(Restlessness, GoesByTheRatioOfTheAccelerations) {
  Random random(1);
  int restless = 0;
  for (int i = 0; i < 10000; ++i) {
    const double calm = random.LogUniform(1e-9, 1e9), ratio = random.LogUniform(1e-3, 1e6);
    Restlessness scene;
    scene.Set(0, calm);
    scene.Set(1, calm * ratio);
    restless += scene.IsRestless(1, 0);
    EXPECT_FALSE(scene.IsRestless(0, 0));
    EXPECT_FALSE(ratio < 16 && scene.IsRestless(1, 0)) << calm << " " << ratio;
    EXPECT_FALSE(ratio >= 256.0001 && !scene.IsRestless(1, 0)) << calm << " " << ratio;
    EXPECT_EQ(scene.CountBeside(0), scene.IsRestless(1, 0) ? 1u : 0u);
  }
  EXPECT_GT(restless, 1000);
}

TEST(Restlessness, ExtremesAreClassesToo) {
  Restlessness scene;
  const double bounds[] = {0, 5e-324, 1e-300, 1, 1e18, 1e300, INFINITY};
  for (std::uint32_t k = 0; k < 7; ++k) scene.Set(k, bounds[k]);
  for (std::uint32_t k = 0; k < 7; ++k) EXPECT_FALSE(scene.IsRestless(k, 0)) << k;
  EXPECT_EQ(scene.CountBeside(0), 0u);
  EXPECT_TRUE(scene.IsRestless(6, 1));
  EXPECT_TRUE(scene.IsRestless(3, 2));
  EXPECT_LT(scene.of(6), Restlessness::kClasses);
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
      scene.Set(agent, random.LogUniform(1e-3, 1e3));
    }
    for (std::uint32_t beside = 0; beside < kAgents; ++beside) {
      std::uint32_t count = 0;
      for (std::uint32_t k = 0; k < kAgents; ++k) count += scene.IsRestless(k, beside);
      ASSERT_EQ(scene.CountBeside(beside), count);
    }
  }
}

}  // namespace
}  // namespace collision
