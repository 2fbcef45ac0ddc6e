// Goal:   the extremes of an agent's pairs are those that a walk over all of them finds, whatever
//         pairs come, change and go.
// Method: random changes, with few different values so that pairs tie, beside a model that walks.
#include "collision_core/detection/pairs/pair_extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kAgents = 5;

struct Pair {
  AgentIndex a, b;
  PairExtremes says;

  bool Has(AgentIndex agent) const { return a == agent || b == agent; }
};

using Pairs = std::map<PairSlot, Pair>;

std::vector<PairSlot> SlotsOf(const Pairs& pairs, AgentIndex agent) {
  std::vector<PairSlot> slots;
  for (const auto& [slot, pair] : pairs) {
    if (pair.Has(agent)) slots.push_back(slot);
  }
  return slots;
}

PairExtremes Walk(const Pairs& pairs, AgentIndex agent) {
  PairExtremes all;
  for (const auto& [slot, pair] : pairs) {
    if (!pair.Has(agent)) continue;
    all.clear_until = std::min(all.clear_until, pair.says.clear_until);
    all.unannounced_until = std::min(all.unannounced_until, pair.says.unannounced_until);
    all.needed_from = std::min(all.needed_from, pair.says.needed_from);
    all.unsettled_until = std::max(all.unsettled_until, pair.says.unsettled_until);
    all.contacts += pair.says.contacts;
  }
  return all;
}

Instant RandomInstant(Random* random, Instant none) {
  return random->Chance(0.3) ? none : At(static_cast<double>(random->Below(6)));
}

PairExtremes RandomExtremes(Random* random) {
  return {.clear_until = RandomInstant(random, Instant::Never()),
          .unannounced_until = RandomInstant(random, Instant::Never()),
          .needed_from = RandomInstant(random, Instant::Never()),
          .unsettled_until = RandomInstant(random, Instant::Always()),
          .contacts = random->Chance(0.5)};
}

TEST(AgentExtremes, AreThoseOfAWalkOverAllPairs) {
  Random random(20);
  AgentExtremes extremes;
  for (std::uint32_t k = 0; k < kAgents; ++k) extremes.AddAgent(AgentIndex(k));
  Pairs pairs;
  for (int i = 0; i < 20'000; ++i) {
    const PairSlot slot(static_cast<std::uint32_t>(random.Below(12)));
    const auto known = pairs.find(slot);
    if (known == pairs.end()) {
      const auto a = static_cast<std::uint32_t>(random.Below(kAgents));
      const auto b = static_cast<std::uint32_t>((a + 1 + random.Below(kAgents - 1)) % kAgents);
      pairs[slot] = {AgentIndex(a), AgentIndex(b), RandomExtremes(&random)};
      extremes.Set(slot, AgentIndex(a), AgentIndex(b), pairs[slot].says);
    } else if (random.Chance(0.2)) {
      extremes.Set(slot, known->second.a, known->second.b, PairExtremes());
      pairs.erase(known);
    } else {
      known->second.says = RandomExtremes(&random);
      extremes.Set(slot, known->second.a, known->second.b, known->second.says);
    }
    // Others stay unread, so that changes add up.
    const AgentIndex agent(static_cast<std::uint32_t>(random.Below(kAgents)));
    const std::vector<PairSlot> slots = SlotsOf(pairs, agent);
    ASSERT_EQ(extremes.Of(agent, slots), Walk(pairs, agent)) << i;
    extremes.Validate(agent, slots);
  }
}

TEST(AgentExtremes, OfAnAgentWithoutPairsLimitNothing) {
  AgentExtremes extremes;
  extremes.AddAgent(AgentIndex(0u));
  EXPECT_EQ(extremes.Of(AgentIndex(0u), {}), PairExtremes());
}

}  // namespace
}  // namespace collision::detection
