// Goal:   a contact's number is never given twice, goes on where it is known, and what is kept of
//         numbers is bounded.
// Method: two agents among thousands of others, and a model that remembers everything.
#include "collision_core/detection/events/contact_numbers.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::uint32_t NextOf(std::uint32_t a, std::uint32_t b, ContactNumbers* numbers) {
  return numbers->Next(AgentIndex(a), AgentIndex(b));
}

TEST(ContactNumbers, ContactsOfAPairAreCounted) {
  ContactNumbers numbers;
  for (std::uint32_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(NextOf(3, 7, &numbers), i);
    EXPECT_EQ(NextOf(3, 8, &numbers), i);
    EXPECT_EQ(NextOf(7, 8, &numbers), i);
  }
  numbers.Validate();
  numbers.Forget(AgentIndex(7u));
  numbers.Validate();
  EXPECT_EQ(NextOf(3, 7, &numbers), 1u) << "another agent stands at the index";
  EXPECT_EQ(NextOf(3, 8, &numbers), 6u);
}

TEST(ContactNumbers, NoNumberComesTwiceBeyondTheBound) {
  Random random(3);
  ContactNumbers numbers;
  std::map<Pair, std::set<std::uint32_t>> given;
  const auto others = static_cast<std::uint32_t>(3 * ContactNumbers::kPartnersMax);
  for (int i = 0; i < 40000; ++i) {
    const auto hub = static_cast<std::uint32_t>(random.Below(2));
    const auto other = 2 + static_cast<std::uint32_t>(random.Below(others));
    const std::uint32_t number = NextOf(hub, other, &numbers);
    EXPECT_TRUE(given[Pair(hub, other)].insert(number).second) << hub << " " << other;
  }
  numbers.Validate();
}

TEST(ContactNumbers, RefuseAnAgentWithItself) {
  ContactNumbers numbers;
  EXPECT_THROW(NextOf(4, 4, &numbers), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
