// Goal:   what was touched lately is remembered, what was not for long is not, and no more than
//         twice as much as was asked for.
// Method: against a list of all keys in the order of their last touch.
#include "collision_core/base/recent_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/random.h"

namespace collision {
namespace {

constexpr std::size_t kKeys = 8;

TEST(RecentMap, RemembersTheKeysTouchedLast) {
  Random random(1);
  RecentMap<std::uint64_t, int> map(kKeys);
  std::vector<std::uint64_t> touched;  // The last one last.
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t key = random.Below(40);
    const bool was_known = map.Find(key) != nullptr;
    int& value = map.Touch(key);
    EXPECT_EQ(value != 0, was_known);
    value = i + 1;
    std::erase(touched, key);
    touched.push_back(key);
    std::size_t known = 0;
    for (std::size_t back = 0; back < touched.size(); ++back) {
      const int* found = map.Find(touched[touched.size() - 1 - back]);
      known += found != nullptr;
      if (back < kKeys) {
        ASSERT_NE(found, nullptr) << back;
      }
    }
    EXPECT_LE(known, 2 * kKeys);
  }
}

TEST(RecentMap, AValueIsKeptHoweverOftenItsKeyIsTouched) {
  RecentMap<int, int> map(2);
  map.Touch(0) = 7;
  for (int i = 1; i < 100; ++i) {
    map.Touch(i);
    EXPECT_EQ(map.Touch(0), 7);
  }
  map.Clear();
  EXPECT_EQ(map.Find(0), nullptr);
}

TEST(RecentMap, ForEachTellsEveryKeyOnceTheEarlierGenerationFirst) {
  RecentMap<int, int> map(2);
  for (const int key : {5, 4, 3}) map.Touch(key) = 10 * key;
  std::vector<std::pair<int, int>> all;
  map.ForEach([&](int key, int& value) { all.emplace_back(key, value++); });
  EXPECT_EQ(all, (std::vector<std::pair<int, int>>{{4, 40}, {5, 50}, {3, 30}}));
  EXPECT_EQ(*map.Find(4), 41);
}

}  // namespace
}  // namespace collision
