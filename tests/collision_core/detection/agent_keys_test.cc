// Goal:   each group has the key it was given, never a later one than the calm, and the first is the
//         earliest of all.
// Method: random changes, beside a key for each class in a plain array.
#include "collision_core/detection/agent_keys.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr int kCalm = Restlessness::kCalm;

Instant Draw(Random* random) {
  if (random->Chance(0.05)) return Instant::Never();
  return Instant::FromNanoseconds(static_cast<std::int64_t>(random->Below(1000)));
}

TEST(AgentKeys, AreThoseOfEachClass) {
  constexpr int kGroups = 6;
  Random random(5);
  AgentKeys keys;
  std::array<Instant, kGroups> expected;
  expected.fill(Instant::Always());
  for (int i = 0; i < 20000; ++i) {
    const int group = static_cast<int>(random.Below(kGroups));
    const Instant key = Draw(&random);
    if (random.Chance(0.1)) {
      keys.SetAll(key);
      expected.fill(key);
    } else if (group != kCalm && random.Chance(0.5)) {
      keys.SetRestless(group, key);
      expected[group] = key;
    } else {
      keys.Lower(group, key);
      expected[group] = std::min(expected[group], key);
    }
    for (Instant& one : expected) one = std::min(one, expected[kCalm]);
    std::vector<int> due, due_expected;
    const Instant until = Draw(&random);
    for (int g = 0; g < kGroups; ++g) {
      ASSERT_EQ(keys.of(g), expected[g]) << i;
      if (g != kCalm && expected[g] < expected[kCalm] && expected[g] <= until) {
        due_expected.push_back(g);
      }
    }
    ASSERT_EQ(keys.calm(), expected[kCalm]);
    ASSERT_EQ(keys.first(), *std::min_element(expected.begin(), expected.end()));
    if (until >= keys.calm()) continue;
    keys.RestlessUpTo(until, &due);
    std::sort(due.begin(), due.end());
    ASSERT_EQ(due, due_expected) << i;
  }
}

}  // namespace
}  // namespace collision::detection
