// Goal:   the queue's head is always the least (key, agent), whatever changed before.
// Method: thousands of random changes, compared with a sorted map after each.
#include "collision_core/base/event_queue.h"

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
  EventQueue<AgentIndex> queue;
  std::map<std::uint32_t, Instant> keys;
  for (int i = 0; i < 20000; ++i) {
    const auto agent = static_cast<std::uint32_t>(random.Below(60));
    if (random.Below(3) == 0) {
      queue.Remove(AgentIndex(agent));
      keys.erase(agent);
    } else {
      const Instant key = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(100)));
      queue.Set(AgentIndex(agent), key);
      keys[agent] = key;
    }
    queue.Validate();
    ASSERT_EQ(queue.size(), keys.size());
    if (keys.empty()) continue;
    std::set<std::pair<Instant, std::uint32_t>> ordered;
    for (const auto& [a, k] : keys) ordered.insert({k, a});
    ASSERT_EQ(queue.top_key(), ordered.begin()->first);
    ASSERT_EQ(queue.top().value(), ordered.begin()->second);
  }
}

// Goal:   UpTo() gives each index up to a key once, and no other, whatever the shape of the heap.
// Method: every size up to 70, keys with many ties, every limit, against a sorted copy.
TEST(EventQueue, UpToGivesAllThatAreNotLater) {
  Random random(4);
  for (std::uint32_t size = 0; size <= 70; ++size) {
    EventQueue<AgentIndex> queue;
    std::vector<std::pair<Instant, std::uint32_t>> sorted;
    for (std::uint32_t index = 0; index < size; ++index) {
      const Instant key = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(20)));
      queue.Set(AgentIndex(index), key);
      sorted.emplace_back(key, index);
    }
    for (std::int64_t last = -1; last <= 20; ++last) {
      std::vector<AgentIndex> found, wanted;
      queue.UpTo(Instant::FromNanoseconds(last), &found);
      for (const auto& [key, index] : sorted) {
        if (key.nanoseconds() <= last) wanted.push_back(AgentIndex(index));
      }
      std::sort(found.begin(), found.end());
      ASSERT_TRUE(found == wanted) << size << " up to " << last;
    }
  }
}

// Goal:   a query about the head of an empty queue, or an absent index, is refused, not
//         undefined.
TEST(EventQueue, RefusesToNameAHeadThatItDoesNotHave) {
  EventQueue<AgentIndex> queue;
  EXPECT_THROW(queue.top(), CheckFailure);
  EXPECT_THROW(queue.top_key(), CheckFailure);
  EXPECT_THROW(queue.KeyOf(AgentIndex(3u)), CheckFailure);
  EXPECT_THROW(queue.Set(AgentIndex::None(), Instant()), CheckFailure);
  queue.Remove(AgentIndex(3u));
  queue.Set(AgentIndex(3u), Instant::FromNanoseconds(7));
  EXPECT_EQ(queue.KeyOf(AgentIndex(3u)), Instant::FromNanoseconds(7));
}

}  // namespace
}  // namespace collision
