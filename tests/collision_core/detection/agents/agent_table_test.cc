// Goal:   names, indices, owners and expiries agree over an agent's whole life, and what does not
//         hold is found.
// Method: lives by hand; random lives with a walk after each change; broken preconditions.
#include "collision_core/detection/agents/agent_table.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

motion::MotionState StateAt(double t, double expiry = 0) {
  motion::MotionState state = State(t, {0, 0, 0}, {0, 0, 0});
  if (expiry > 0) state.expiry = At(expiry);
  return state;
}

AgentIndex Admitted(const AgentId& id, double t, AgentTable* table, double expiry = 0) {
  const AgentIndex agent = table->Admit(id, {.limits = {.radius = 1}}, At(t));
  if (agent.is_none()) return agent;
  table->Store(agent, StateAt(t, expiry), Link::kJumped);
  table->RecordBound(agent);
  return agent;
}

TEST(AgentTable, AdmitsAsManyAsAllowedAndEachNameOnce) {
  AgentTable table({.agents_max = 2});
  const AgentIndex first = Admitted(Id(1), 0, &table);
  EXPECT_EQ(table.Find(Id(1)), first);
  EXPECT_TRUE(Admitted(Id(1), 0, &table).is_none());
  EXPECT_FALSE(Admitted(Id(2), 0, &table).is_none());
  EXPECT_TRUE(Admitted(Id(3), 0, &table).is_none());
  EXPECT_TRUE(table.Find(Id(3)).is_none());
  table.Validate();
}

TEST(AgentTable, TimeHeardOfAnOwnerHoldsForAllItsAgents) {
  AgentTable table({});
  const AgentId a{.simulator = 7, .slot = 1, .run = 1}, b{.simulator = 7, .slot = 2, .run = 1};
  const AgentId other_run{.simulator = 7, .slot = 1, .run = 2};
  table.SetHeardUntil(OwnerOf(a), At(9));  // no agents yet: no effect
  const AgentIndex of_a = Admitted(a, 1, &table), of_b = Admitted(b, 3, &table);
  const AgentIndex of_other = Admitted(other_run, 0, &table);
  EXPECT_EQ(table[of_a].heard_until(), At(1));
  table.SetHeardUntil(OwnerOf(a), At(2));
  EXPECT_EQ(table[of_a].heard_until(), At(2));
  EXPECT_EQ(table[of_b].heard_until(), At(3)) << "its own state is newer";
  EXPECT_EQ(table[of_other].heard_until(), At(0));
  table.SetHeardUntil(OwnerOf(a), At(1));
  EXPECT_EQ(table[of_a].heard_until(), At(2)) << "never back";
}

TEST(AgentTable, ARemovedAgentStaysUntilItsReportedTime) {
  AgentTable table({});
  const AgentIndex agent = Admitted(Id(1), 0, &table);
  table.SetHeardUntil(OwnerOf(Id(1)), At(2));
  table.Remove(agent);
  table.Validate();
  EXPECT_TRUE(table.Find(Id(1)).is_none());
  EXPECT_EQ(table[agent].bound().state.expiry, At(2));
  EXPECT_THROW(table.Remove(agent), CheckFailure);
  const AgentIndex next = Admitted(Id(1), 1, &table);  // the owner may use the name again
  EXPECT_NE(next, agent);
  EXPECT_EQ(table[next].heard_until(), At(1)) << "an owner without agents is forgotten";
  EXPECT_TRUE(table.TakeExpired(At(1)).empty());
  EXPECT_EQ(table.TakeExpired(At(2)), std::vector{agent});
  table.Release(agent);
  EXPECT_THROW(table[agent], CheckFailure);
  EXPECT_THROW(table.Release(next), CheckFailure) << "it has not been removed";
  EXPECT_EQ(Admitted(Id(3), 2, &table), agent) << "the index is free";
  table.Validate();
}

TEST(AgentTable, RemovedAgentsExpireFirstInTheOrderOfTheirRemoval) {
  AgentTable table({});
  const AgentIndex a = Admitted(Id(1), 0, &table, 1), b = Admitted(Id(2), 0, &table, 1);
  const AgentIndex c = Admitted(Id(3), 0, &table), d = Admitted(Id(4), 0, &table);
  table.Remove(d);
  table.Remove(c);
  EXPECT_EQ(table.TakeExpired(At(1)), (std::vector{d, c, a, b}));
  EXPECT_EQ(table.expiries(), 0u);
}

TEST(AgentTable, RandomLivesKeepItsInvariants) {
  Random random(8);
  AgentTable table({.agents_max = 12, .history_max = 4});
  double now = 0;
  for (int i = 0; i < 3000; ++i) {
    now += random.Uniform(0, 0.1);
    const auto slot = static_cast<std::uint32_t>(random.Below(16));
    const AgentId id{.simulator = random.Below(3), .slot = slot, .run = 1};
    const AgentIndex agent = table.Find(id);
    if (agent.is_none()) {
      Admitted(id, now, &table, random.Chance(0.2) ? now + 1 : 0);
    } else if (random.Chance(0.2)) {
      table.Remove(agent);
    } else {
      table.Store(agent, StateAt(now), Link::kFollows);
      table.RecordBound(agent);
    }
    if (random.Chance(0.3)) table.SetHeardUntil(OwnerOf(id), At(now));
    for (const AgentIndex expired : table.TakeExpired(At(now))) {
      if (table[expired].removal != 0) {
        table.Release(expired);
      } else {
        table.SetExpired(expired);
      }
    }
    table.UpdateExtremes();
    table.EndStep([&](AgentIndex) { return At(now); });
    ASSERT_NO_THROW(table.Validate()) << i;
  }
}

// Goal:   the walk finds an agent that stands under another name than it has.
TEST(AgentTable, ValidateFindsAWrongName) {
  AgentTable table({});
  const AgentIndex agent = Admitted(Id(1), 0, &table);
  table[agent].id = Id(2);
  EXPECT_THROW(table.Validate(), CheckFailure);
}

/// A table with one agent, whose newest bound the test changes without RecordBound().
class UnrecordedBound : public testing::Test {
 protected:
  UnrecordedBound() : agent_(Admitted(Id(1), 0, &table_)) { table_.Validate(); }

  motion::SpaceTimeBound& bound() { return table_[agent_].history.newest().bound; }

  AgentTable table_{{}};
  const AgentIndex agent_;
};

TEST_F(UnrecordedBound, BeyondTheExtremesIsFound) {
  bound().limits.acceleration_max = 1;
  table_.RecordBound(agent_);
  table_.Validate();
  bound().limits.acceleration_max = 2;
  EXPECT_THROW(table_.Validate(), CheckFailure);
}

TEST_F(UnrecordedBound, WithOtherFeaturesIsFound) {
  bound().skew = 1;
  EXPECT_THROW(table_.Validate(), CheckFailure);
  table_.RecordBound(agent_);
  table_.Validate();
}

TEST_F(UnrecordedBound, WithFeaturesThatAreNotCountedIsFound) {
  bound().skew = 1;
  table_[agent_].features = SceneProfile::Of(table_[agent_].history.newest());
  EXPECT_THROW(table_.Validate(), CheckFailure);
}

TEST(History, WithoutAStateHasNoNewest) {
  const History history;
  EXPECT_THROW(history.newest(), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
