// Goal:   whether a partner is in a band of its own beside an agent depends on the declared
//         accelerations of the two alone: never within 8 times, always from 64 times; and the
//         agents of each tier are counted.
// Method: random bounds of all magnitudes against their ratio; agents come, change and leave,
//         against a walk over all.
#include "collision_core/detection/clearance/keys/acceleration_tiers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr int kComparable = AccelerationTiers::kComparable;

bool HasOwnGroup(const AccelerationTiers& scene, std::uint32_t partner_index,
                 std::uint32_t beside_index) {
  const AgentIndex partner(partner_index), beside(beside_index);
  const int band = scene.BandOf(partner, beside);
  EXPECT_TRUE(band == kComparable || band == scene.TierOf(partner));
  return band != kComparable;
}

std::vector<int> OwnBandsOf(const AccelerationTiers& scene, std::uint32_t agent) {
  std::vector<int> tiers;
  scene.OwnBandsOf(AgentIndex(agent), &tiers);
  return tiers;
}

TEST(AccelerationTiers, GoesByTheRatioOfTheAccelerations) {
  Random random(1);
  int own_bands = 0;
  for (int i = 0; i < 10000; ++i) {
    const double calm = random.LogUniform(1e-9, 1e9), ratio = random.LogUniform(1e-3, 1e6);
    AccelerationTiers scene;
    scene.Set(AgentIndex(0u), calm);
    scene.Set(AgentIndex(1u), calm * ratio);
    const bool is_own = HasOwnGroup(scene, 1, 0);
    own_bands += is_own;
    EXPECT_FALSE(HasOwnGroup(scene, 0, 0));
    EXPECT_FALSE(ratio < 8 && is_own) << calm << " " << ratio;
    EXPECT_FALSE(ratio >= 64.0001 && !is_own) << calm << " " << ratio;
    EXPECT_EQ(OwnBandsOf(scene, 0).size(), is_own ? 1u : 0u);
  }
  EXPECT_GT(own_bands, 1000);
}

TEST(AccelerationTiers, ExtremesAreClassesToo) {
  AccelerationTiers scene;
  const double bounds[] = {0, 5e-324, 1e-300, 1, 1e18, 1e300, INFINITY};
  for (std::uint32_t k = 0; k < 7; ++k) scene.Set(AgentIndex(k), bounds[k]);
  EXPECT_TRUE(HasOwnGroup(scene, 6, 1));
  EXPECT_TRUE(HasOwnGroup(scene, 3, 2));
  EXPECT_LT(scene.TierOf(AgentIndex(6u)), AccelerationTiers::kTiers);
}

// Beside an agent that declares no acceleration, every agent that declares any.
TEST(AccelerationTiers, NoAccelerationIsBelowEveryTier) {
  AccelerationTiers scene;
  const double bounds[] = {0, 5e-324, 1e-300, 1, 1e18, 0};
  for (std::uint32_t k = 0; k < 6; ++k) scene.Set(AgentIndex(k), bounds[k]);
  for (std::uint32_t k = 1; k < 5; ++k) EXPECT_TRUE(HasOwnGroup(scene, k, 0)) << k;
  for (std::uint32_t k = 0; k < 6; ++k) EXPECT_FALSE(HasOwnGroup(scene, 5, k)) << k;
}

// If many agents declare no acceleration, they are not queried separately.
TEST(AccelerationTiers, UnacceleratedAgentsHaveNoOwnBandIfTheyAreMany) {
  constexpr std::uint32_t kMost = AccelerationTiers::kUnacceleratedMax;
  AccelerationTiers scene;
  scene.Set(AgentIndex(0u), 1);
  scene.Set(AgentIndex(1u), 1e3);
  for (std::uint32_t k = 0; k < kMost; ++k) {
    scene.Set(AgentIndex(2 + k), 0);
    EXPECT_TRUE(scene.HasOwnBands(AgentIndex(2u)) && HasOwnGroup(scene, 0, 2));
  }
  scene.Set(AgentIndex(2 + kMost), 0);
  EXPECT_FALSE(scene.HasOwnBands(AgentIndex(2u)) || HasOwnGroup(scene, 0, 2) ||
               HasOwnGroup(scene, 1, 2));
  EXPECT_TRUE(OwnBandsOf(scene, 2).empty());
  EXPECT_TRUE(scene.HasOwnBands(AgentIndex(0u)) && HasOwnGroup(scene, 1, 0));
  scene.Remove(AgentIndex(5u));
  EXPECT_TRUE(scene.HasOwnBands(AgentIndex(2u)) && HasOwnGroup(scene, 0, 2));
  EXPECT_EQ(scene.Count(0), kMost);
}

TEST(AccelerationTiers, KnowsWhichAgentsAreThere) {
  constexpr std::uint32_t kAgents = 12;
  Random random(2);
  AccelerationTiers scene;
  for (std::uint32_t k = 0; k < kAgents; ++k) scene.Set(AgentIndex(k), 1);
  for (int i = 0; i < 5000; ++i) {
    const auto agent = static_cast<std::uint32_t>(random.Below(kAgents));
    if (random.Chance(0.5)) {
      scene.Remove(AgentIndex(agent));
    } else {
      scene.Set(AgentIndex(agent), random.Chance(0.1) ? 0 : random.LogUniform(1e-3, 1e3));
    }
    for (std::uint32_t beside = 0; beside < kAgents; ++beside) {
      std::vector<int> tiers;
      for (std::uint32_t k = 0; k < kAgents; ++k) {
        if (HasOwnGroup(scene, k, beside)) tiers.push_back(scene.TierOf(AgentIndex(k)));
      }
      std::sort(tiers.begin(), tiers.end());
      std::uint32_t counted = 0;
      for (const int tier : OwnBandsOf(scene, beside)) counted += scene.Count(tier);
      ASSERT_EQ(counted, tiers.size());
      tiers.erase(std::unique(tiers.begin(), tiers.end()), tiers.end());
      ASSERT_EQ(OwnBandsOf(scene, beside), tiers);
    }
  }
  EXPECT_EQ(scene.Count(AccelerationTiers::kAbsent), 0u);
}

TEST(AccelerationTiers, KnowsOnlyAgentsThatWereSet) {
  AccelerationTiers scene;
  const AgentIndex set(0u), unknown(1u);
  scene.Set(set, 1);
  EXPECT_THROW(scene.TierOf(unknown), CheckFailure);
  EXPECT_THROW(scene.HasOwnBands(unknown), CheckFailure);
  EXPECT_THROW(scene.BandOf(unknown, set), CheckFailure);
  EXPECT_THROW(scene.BandOf(set, unknown), CheckFailure);
  EXPECT_THROW(scene.Count(-1), CheckFailure);
  EXPECT_THROW(scene.Count(AccelerationTiers::kAbsent + 1), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
