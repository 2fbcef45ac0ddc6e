// Goal:   slots and the agents' lists of pairs agree, room is kept, slots rest before reuse, and a
//         slot that is not tracked is never read.
// Method: random additions and removals beside a model; broken preconditions.
#include "collision_core/detection/pairs/pair_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

AgentIndex Agent(std::uint64_t k) { return AgentIndex(static_cast<std::uint32_t>(k)); }

PairRecord PairOf(AgentIndex a, AgentIndex b) {
  return {.lower = a, .higher = b, .tracker = ContactTracker({}, Past::kKnown), .clear_until = {}};
}

PairTable TableOf(std::uint32_t pairs_max, std::uint32_t pairs_per_agent_max,
                  std::uint32_t agents) {
  PairTable pairs(pairs_max, pairs_per_agent_max);
  for (std::uint32_t k = 0; k < agents; ++k) pairs.AddAgent(Agent(k));
  return pairs;
}

TEST(PairTable, SlotsRestBeforeTheyAreUsedAgain) {
  PairTable pairs = TableOf(5000, 256, 2);
  std::set<PairSlot> seen;
  for (std::size_t i = 0; i <= PairTable::kSlotsResting; ++i) {
    const PairSlot slot = pairs.Add(PairOf(Agent(0), Agent(1)));
    EXPECT_TRUE(seen.insert(slot).second);
    EXPECT_TRUE(pairs.Contains(slot));
    pairs.Remove(slot);
    EXPECT_FALSE(pairs.Contains(slot));
  }
  EXPECT_FALSE(seen.insert(pairs.Add(PairOf(Agent(0), Agent(1)))).second)
      << "the first that was freed";
  EXPECT_EQ(pairs.room(), 4999u);
  pairs.Validate();
}

// An agent that changes sees each of its idle pairs once; a pair that was taken with one agent is
// still listed with the other.
TEST(PairTable, HandsOutTheIdlePairsOfAnAgentOnce) {
  PairTable pairs = TableOf(100, 10, 3);
  const PairSlot ab = pairs.Add(PairOf(Agent(0), Agent(1)));
  const PairSlot bc = pairs.Add(PairOf(Agent(1), Agent(2)));
  EXPECT_EQ(pairs.TakeIdle(Agent(1)), (std::vector{ab, bc})) << "new ones";
  EXPECT_TRUE(pairs.TakeIdle(Agent(1)).empty());
  pairs.SetIdle(bc);
  pairs.SetIdle(bc);
  pairs.Validate();
  EXPECT_EQ(pairs.TakeIdle(Agent(1)), std::vector{bc});
  EXPECT_EQ(pairs.TakeIdle(Agent(2)), std::vector{bc}) << "listed once, and once again in vain";
  pairs.SetIdle(ab);
  pairs.Remove(ab);
  EXPECT_TRUE(pairs.TakeIdle(Agent(0)).empty());
  EXPECT_TRUE(pairs.TakeIdle(Agent(1)).empty());
  pairs.Validate();
}

TEST(PairTable, KnowsThePairsOfEachAgentAndItsRoom) {
  constexpr std::uint32_t kAgents = 9, kPairsMax = 20, kPerAgentMax = 6;
  Random random(4);
  PairTable pairs = TableOf(kPairsMax, kPerAgentMax, kAgents);
  std::map<PairSlot, std::pair<AgentIndex, AgentIndex>> model;
  for (int i = 0; i < 4000; ++i) {
    const AgentIndex a = Agent(random.Below(kAgents)), b = Agent(random.Below(kAgents));
    const bool is_tracked = std::any_of(model.begin(), model.end(), [=](const auto& pair) {
      return pair.second == std::pair(a, b) || pair.second == std::pair(b, a);
    });
    const bool can_add = a != b && !is_tracked && pairs.RoomFor(a) > 0 && pairs.RoomFor(b) > 0;
    if (random.Chance(0.6) && can_add) {
      model[pairs.Add(PairOf(a, b))] = {a, b};
    } else if (!model.empty()) {
      const auto gone = std::next(model.begin(), static_cast<int>(random.Below(model.size())));
      pairs.Remove(gone->first);
      model.erase(gone);
    }
    ASSERT_NO_THROW(pairs.Validate());
    ASSERT_EQ(pairs.size(), model.size());
    for (std::uint32_t k = 0; k < kAgents; ++k) {
      std::size_t of_agent = 0;
      for (const auto& [slot, both] : model) {
        of_agent += both.first == Agent(k) || both.second == Agent(k);
      }
      ASSERT_EQ(pairs.Of(Agent(k)).size(), of_agent);
      ASSERT_EQ(pairs.IsFull(Agent(k)), of_agent == kPerAgentMax || model.size() == kPairsMax);
      ASSERT_EQ(pairs.RoomFor(Agent(k)),
                std::min<std::size_t>(kPerAgentMax - of_agent, kPairsMax - model.size()));
    }
  }
}

TEST(PairTable, RefusesWhatItDoesNotHold) {
  PairTable pairs = TableOf(1, 4, 3);
  const PairSlot slot = pairs.Add(PairOf(Agent(0), Agent(1)));
  EXPECT_TRUE(pairs.Add(PairOf(Agent(1), Agent(2))).is_none()) << "there is no slot";
  pairs.Remove(slot);
  EXPECT_THROW(pairs[slot], CheckFailure);
  EXPECT_THROW(pairs.Remove(slot), CheckFailure);
  EXPECT_THROW(pairs[PairSlot::None()], CheckFailure);
  EXPECT_THROW(pairs.Of(Agent(3)), CheckFailure);
  EXPECT_THROW(pairs.IsFull(Agent(3)), CheckFailure);
  EXPECT_THROW(pairs.RoomFor(Agent(3)), CheckFailure);
  EXPECT_THROW(pairs.Add(PairOf(Agent(2), Agent(2))), CheckFailure);
}

// Goal:   the walk finds a list that does not agree. Method: a pair is made to name another agent.
TEST(PairTable, ValidateFindsAPairThatIsNotListed) {
  PairTable pairs = TableOf(8, 4, 3);
  const PairSlot slot = pairs.Add(PairOf(Agent(0), Agent(1)));
  pairs.Validate();
  pairs[slot].higher = Agent(2);
  EXPECT_THROW(pairs.Validate(), CheckFailure);
}

// Method: the same pair is added twice.
TEST(PairTable, ValidateFindsTwoAgentsInTwoPairs) {
  PairTable pairs = TableOf(8, 4, 3);
  pairs.Add(PairOf(Agent(0), Agent(1)));
  pairs.Add(PairOf(Agent(0), Agent(2)));
  pairs.Validate();
  const PairSlot twice = pairs.Add(PairOf(Agent(1), Agent(0)));
  EXPECT_THROW(pairs.Validate(), CheckFailure);
  pairs.Remove(twice);
  pairs.Validate();
}

}  // namespace
}  // namespace collision::detection
