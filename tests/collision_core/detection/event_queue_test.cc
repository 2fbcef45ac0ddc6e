// Goal:   the queue's head is always the least (key, agent), whatever changed before.
// Method: thousands of random changes, compared with a sorted map after each.
#include "collision_core/detection/event_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/support/random.h"

namespace collision {
namespace {

TEST(EventQueue, HeadIsTheLeastAfterEveryChange) {
  Random random(7);
  EventQueue queue;
  std::map<std::uint32_t, Instant> keys;
  for (int i = 0; i < 20000; ++i) {
    const auto agent = static_cast<std::uint32_t>(random.Below(60));
    if (random.Below(3) == 0) {
      queue.Remove(agent);
      keys.erase(agent);
    } else {
      const Instant key = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(100)));
      queue.Set(agent, key);
      keys[agent] = key;
    }
    ASSERT_EQ(queue.size(), keys.size());
    if (keys.empty()) continue;
    std::set<std::pair<Instant, std::uint32_t>> ordered;
    for (const auto& [a, k] : keys) ordered.insert({k, a});
    ASSERT_EQ(queue.top_key(), ordered.begin()->first);
    ASSERT_EQ(queue.top(), ordered.begin()->second);
  }
}

// Goal:   the first few come in order, whatever the count.
// Method: 1000 keys with many ties, beside a sorted copy.
TEST(EventQueue, FirstFewAreThoseThatWouldBeTaken) {
  Random random(4);
  EventQueue queue;
  std::vector<std::pair<Instant, std::uint32_t>> sorted;
  for (std::uint32_t index = 0; index < 1000; ++index) {
    const Instant key = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(300)));
    queue.Set(index, key);
    sorted.emplace_back(key, index);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> first;
  for (const std::size_t count : {0, 1, 2, 33, 999, 1000, 1001}) {
    queue.First(count, &first);
    ASSERT_EQ(first.size(), std::min<std::size_t>(count, 1000));
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i], sorted[i].second);
  }
}

}  // namespace
}  // namespace collision
