// Goal:   a contact's number is never given twice, goes on where it is known, and what is kept of
//         numbers is bounded.
// Method: two agents among thousands of others, and a model that remembers everything.
#include "collision_core/detection/pair_table.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

TEST(PairTable, ContactsOfAPairAreCounted) {
  PairTable pairs(10);
  for (std::uint32_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(pairs.NextContact(3, 7), i);
    EXPECT_EQ(pairs.NextContact(3, 8), i);
    EXPECT_EQ(pairs.NextContact(7, 8), i);
  }
  pairs.Forget(7);
  EXPECT_EQ(pairs.NextContact(3, 7), 1u) << "another agent stands at the index";
  EXPECT_EQ(pairs.NextContact(3, 8), 6u);
}

TEST(PairTable, NoNumberComesTwiceBeyondTheBound) {
  Random random(3);
  PairTable pairs(10);
  std::map<Pair, std::set<std::uint32_t>> given;
  const auto others = static_cast<std::uint32_t>(3 * PairTable::kNumbersPerAgentMax);
  for (int i = 0; i < 40000; ++i) {
    const auto hub = static_cast<std::uint32_t>(random.Below(2));
    const auto other = 2 + static_cast<std::uint32_t>(random.Below(others));
    const std::uint32_t number = pairs.NextContact(hub, other);
    EXPECT_TRUE(given[Pair(hub, other)].insert(number).second) << hub << " " << other;
  }
}

TEST(PairTable, SlotsRestBeforeTheyAreUsedAgain) {
  PairTable pairs(5000);
  const PairRecord pair{
      .lower = 0, .higher = 1, .tracker = ContactTracker({}, false), .clear_until = {}};
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i <= PairTable::kSlotsResting; ++i) {
    const std::uint32_t slot = *pairs.Add(pair);
    EXPECT_TRUE(seen.insert(slot).second);
    EXPECT_TRUE(pairs.Contains(slot));
    pairs.Remove(slot);
    EXPECT_FALSE(pairs.Contains(slot));
  }
  EXPECT_FALSE(seen.insert(*pairs.Add(pair)).second) << "the first that was freed";
  EXPECT_EQ(pairs.room(), 4999u);
}

}  // namespace
}  // namespace collision::detection
