// Goal:   the set holds what was inserted and not erased, once, in the order of insertion as long
//         as nothing is erased.
// Method: random changes beside a sorted set.
#include "collision_core/base/index_set.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/random.h"

namespace collision {
namespace {

AgentIndex Agent(std::uint64_t k) { return AgentIndex(static_cast<std::uint32_t>(k)); }

TEST(IndexSet, HoldsWhatWasInsertedAndNotErased) {
  Random random(5);
  IndexSet<AgentIndex> set;
  std::set<AgentIndex> model;
  for (int i = 0; i < 20000; ++i) {
    const AgentIndex agent = Agent(random.Below(40));
    if (random.Chance(0.02)) {
      set.Clear();
      model.clear();
    } else if (random.Chance(0.6)) {
      ASSERT_EQ(set.Insert(agent), model.insert(agent).second);
    } else {
      ASSERT_EQ(set.Erase(agent), model.erase(agent) == 1);
    }
    ASSERT_NO_THROW(set.Validate());
    ASSERT_EQ(std::set<AgentIndex>(set.begin(), set.end()), model);
    ASSERT_EQ(set.size(), model.size());
    ASSERT_EQ(set.Contains(agent), model.contains(agent));
  }
}

TEST(IndexSet, KeepsTheOrderOfInsertion) {
  IndexSet<AgentIndex> set;
  for (const int k : {5, 2, 9, 2, 5, 0}) set.Insert(Agent(static_cast<std::uint64_t>(k)));
  EXPECT_EQ(std::vector(set.begin(), set.end()),
            (std::vector{Agent(5), Agent(2), Agent(9), Agent(0)}));
  EXPECT_THROW(set.Insert(AgentIndex::None()), CheckFailure);
}

}  // namespace
}  // namespace collision
