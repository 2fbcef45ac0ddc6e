// Goal:   each band has the key it was given, never a later one than the comparable partners, and
//         the earliest of all is known.
// Method: random changes, beside a key for each tier in a plain array.
#include "collision_core/detection/clearance/keys/clearance_keys.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

constexpr int kComparable = AccelerationTiers::kComparable;

Instant Draw(Random* random) {
  if (random->Chance(0.05)) return Instant::Never();
  return Instant::FromNanoseconds(static_cast<std::int64_t>(random->Below(1000)));
}

TEST(ClearanceKeys, AreThoseOfEachTier) {
  constexpr int kBands = 6;
  Random random(5);
  ClearanceKeys keys;
  std::array<Instant, kBands> expected;
  expected.fill(Instant::Always());
  for (int i = 0; i < 20000; ++i) {
    const int band = static_cast<int>(random.Below(kBands));
    const Instant key = Draw(&random);
    if (random.Chance(0.1)) {
      keys.SetAll(key);
      expected.fill(key);
    } else if (band != kComparable && random.Chance(0.5)) {
      keys.SetTier(band, key);
      expected[band] = key;
    } else {
      keys.Lower(band, key);
      expected[band] = std::min(expected[band], key);
    }
    for (Instant& one : expected) one = std::min(one, expected[kComparable]);
    std::vector<int> due, due_expected;
    const Instant until = Draw(&random);
    for (int g = 0; g < kBands; ++g) {
      ASSERT_EQ(keys.Of(g), expected[g]) << i;
      if (g != kComparable && expected[g] < expected[kComparable] && expected[g] <= until) {
        due_expected.push_back(g);
      }
    }
    keys.Validate();
    ASSERT_EQ(keys.comparable(), expected[kComparable]);
    ASSERT_EQ(keys.earliest(), *std::min_element(expected.begin(), expected.end()));
    if (until >= keys.comparable()) continue;
    keys.TiersUpTo(until, &due);
    std::sort(due.begin(), due.end());
    ASSERT_EQ(due, due_expected) << i;
  }
}

}  // namespace
}  // namespace collision::detection
