// Goal:   rules of pairs are kept as set, whatever the order of the two, within their limits.
// Method: by hand, and long seeded histories beside the plainest table of pairs.
#include "collision_core/intersection/pair_rules.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/random.h"

namespace collision::intersection {
namespace {

const PairRule kExcluded{.excluded = true};

PairRule Margin(double metres) { return {.margin = metres}; }

TEST(PairRules, AreUnorderedAndReplaced) {
  PairRules rules;
  EXPECT_TRUE(rules.empty());
  EXPECT_TRUE(rules.Set(3, 1, kExcluded));
  EXPECT_EQ(rules.Of(1, 3), kExcluded);
  EXPECT_EQ(rules.Of(3, 1), kExcluded);
  EXPECT_EQ(rules.Of(3, 2), PairRule());
  EXPECT_TRUE(rules.Set(1, 3, Margin(2)));
  EXPECT_EQ(rules.Of(3, 1), Margin(2));
  EXPECT_EQ(rules.size(), 1u);
  EXPECT_TRUE(rules.Set(3, 1, {}));
  EXPECT_TRUE(rules.empty());
  EXPECT_FALSE(rules.HasAny(1));
  EXPECT_TRUE(rules.Set(3, 1, {}));
}

TEST(PairRules, RefuseWhatIsNoMargin) {
  PairRules rules;
  for (const double metres : {-1.0, -1e-300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(rules.Set(1, 2, Margin(metres)));
  }
  EXPECT_FALSE(rules.Set(2, 2, kExcluded));
  EXPECT_TRUE(rules.empty());
  EXPECT_TRUE(rules.Set(1, 2, Margin(std::numeric_limits<double>::max())));
}

// Goal:   two halves cover the whole, also where halving rounds.
TEST(PairRules, HalvesOfMarginsAddUp) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double margin : {kLeast, 3 * kLeast, 1e-310, 0.1, 1e300}) {
    PairRules rules;
    ASSERT_TRUE(rules.Set(1, 2, Margin(margin)));
    ASSERT_TRUE(rules.Set(1, 3, Margin(0.5 * margin)));
    EXPECT_GE(rules.HalfMargin(1) + rules.HalfMargin(2), margin);
    EXPECT_LE(rules.HalfMargin(1), 0.5 * margin + kLeast);
  }
}

// Goal:   beyond the limits only what is new is refused, and room that is freed counts.
TEST(PairRules, HaveNamedLimits) {
  PairRules rules;
  constexpr std::uint32_t kMost = PairRules::kRulesOfAgentMax;
  for (std::uint32_t i = 1; i <= kMost; ++i) ASSERT_TRUE(rules.Set(0, i, kExcluded));
  EXPECT_FALSE(rules.Set(0, kMost + 1, kExcluded));
  EXPECT_FALSE(rules.Set(kMost + 1, 0, kExcluded));
  EXPECT_EQ(rules.Of(0, kMost + 1), PairRule());
  EXPECT_TRUE(rules.Set(7, 0, Margin(1)));
  EXPECT_TRUE(rules.Set(0, 9, {}));
  EXPECT_TRUE(rules.Set(0, kMost + 1, kExcluded));
  EXPECT_EQ(rules.Forget(0).size(), kMost);
  EXPECT_TRUE(rules.empty());
}

TEST(PairRules, RefuseMoreThanTheyHoldInAll) {
  PairRules rules;
  std::uint32_t agent = 0;
  while (rules.size() < PairRules::kRulesMax) {
    ASSERT_TRUE(rules.Set(agent, agent + 1, kExcluded));
    agent += 2;
  }
  EXPECT_FALSE(rules.Set(agent, agent + 1, kExcluded));
  EXPECT_TRUE(rules.Set(0, 1, {}));
  EXPECT_TRUE(rules.Set(agent, agent + 1, kExcluded));
}

TEST(PairRules, AgreeWithTheTableOfAllPairs) {
  constexpr std::uint32_t kAgents = 12;
  Random random(7);
  PairRules rules;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRule> table;
  for (int step = 0; step < 4000; ++step) {
    const auto a = static_cast<std::uint32_t>(random.Below(kAgents));
    const auto b = static_cast<std::uint32_t>(random.Below(kAgents));
    if (random.Chance(0.05)) {
      std::vector<std::uint32_t> partners;
      for (std::uint32_t other = 0; other < kAgents; ++other) {
        if (table.erase(std::minmax(a, other))) partners.push_back(other);
      }
      ASSERT_EQ(rules.Forget(a), partners);
    } else {
      const PairRule rule = random.Chance(0.3)   ? PairRule()
                            : random.Chance(0.5) ? kExcluded
                                                 : Margin(random.Uniform(0, 5));
      ASSERT_EQ(rules.Set(a, b, rule), a != b);
      if (a != b) table[std::minmax(a, b)] = rule;
      if (rule == PairRule()) table.erase(std::minmax(a, b));
    }
    ASSERT_EQ(rules.size(), table.size());
    for (std::uint32_t i = 0; i < kAgents; ++i) {
      double greatest = 0;
      bool has_any = false;
      for (std::uint32_t j = 0; j < kAgents; ++j) {
        const auto found = table.find(std::minmax(i, j));
        ASSERT_EQ(rules.Of(i, j), found == table.end() ? PairRule() : found->second);
        if (found == table.end()) continue;
        has_any = true;
        greatest = std::max(greatest, found->second.margin);
      }
      ASSERT_EQ(rules.HasAny(i), has_any);
      ASSERT_EQ(rules.HalfMargin(i), 0.5 * greatest);
    }
  }
}

}  // namespace
}  // namespace collision::intersection
