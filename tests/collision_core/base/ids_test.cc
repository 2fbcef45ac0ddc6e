#include "collision_core/base/ids.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace collision {
namespace {

// Goal:   an index of one table cannot be used for another, nor an integer for an index.
static_assert(!std::is_convertible_v<AgentIndex, PairSlot>);
static_assert(!std::is_constructible_v<AgentIndex, PairSlot>);
static_assert(!std::is_convertible_v<std::uint32_t, AgentIndex>);
static_assert(!std::is_convertible_v<AgentIndex, std::uint32_t>);
static_assert(std::is_trivially_copyable_v<AgentIndex> && sizeof(AgentIndex) == 4);

TEST(Index, IsOrderedByValueAndNoneIsInNoTable) {
  EXPECT_LT(AgentIndex(3u), AgentIndex(4u));
  EXPECT_TRUE(AgentIndex::None().is_none());
  EXPECT_FALSE(AgentIndex(0u).is_none());
}

// Goal:   at() refuses what lies outside; [] and at() read the same place.
TEST(IndexedVector, ChecksWhereAsked) {
  IndexedVector<AgentIndex, int> table(2);
  table[AgentIndex(1u)] = 5;
  EXPECT_EQ(table.at(AgentIndex(1u)), 5);
  EXPECT_THROW(table.at(AgentIndex(2u)), CheckFailure);
  EXPECT_THROW(table.at(AgentIndex::None()), CheckFailure);
}

}  // namespace
}  // namespace collision
