// Goal:   queries about one pair answer with the canonical routine, under the bounds that they
//         name, and only for agents that can meet.
// Method: two unit balls 10 m apart, one of which comes at 1 m/s without acceleration, so that they
//         touch at 8 s exactly.
#include "collision_core/detection/agents/pair_queries.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class PairQueriesTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const AgentIndex agent : {a_, b_}) {
      agents_.Admit(Id(agent.value()), {.limits = {.radius = 1}}, At(0));
      const double x = agent == a_ ? 0 : 10, v = agent == a_ ? 0 : -1;
      agents_.Store(agent, State(0, {x, 0, 0}, {v, 0, 0}), Link::kJumped);
      agents_[agent].margin = BoundMargin(agents_[agent].bound());
    }
  }

  const AgentIndex a_{0u}, b_{1u};
  StepClock clock_;
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  const PairQueries queries_{{clock_, agents_, &counters_, &dirty_}};
};

TEST_F(PairQueriesTest, AnswerUnderTheNewestBoundsInEitherOrder) {
  const Instant earliest = queries_.EarliestOf(a_, b_, At(0));
  EXPECT_LE(earliest, At(8));
  EXPECT_GT(earliest, At(8 - 1e-6));
  EXPECT_EQ(queries_.EarliestOf(b_, a_, At(0)), earliest);
  EXPECT_EQ(queries_.EarliestOf(a_, b_, At(9)), At(9)) << "they overlap by then";
  EXPECT_EQ(counters_.pair_queries, 3u);
}

TEST_F(PairQueriesTest, WideBoundsMeetEarlierByTheirMargin) {
  const Instant wide = queries_.EarliestOfWide(a_, b_, At(0));
  EXPECT_LT(wide, queries_.EarliestOf(a_, b_, At(0)));
  EXPECT_GT(wide, At(8 - 1e-6));
}

TEST_F(PairQueriesTest, AgentsWhoseLatestFiltersKeepThemApartDoNotMeet) {
  EXPECT_TRUE(queries_.MayMeet(a_, b_));
  agents_[b_].declaration.filter.mask = 2;
  EXPECT_FALSE(queries_.MayMeet(a_, b_));
  EXPECT_FALSE(queries_.MayMeet(b_, a_));
  EXPECT_TRUE(queries_.EarliestOf(a_, b_, At(0)).is_never());
  EXPECT_TRUE(queries_.EarliestOfWide(a_, b_, At(0)).is_never());
}

// Goal:   a query about the past uses the bounds and filters of that past.
TEST_F(PairQueriesTest, BoundsAndFiltersOfTheCallersChoiceCount) {
  agents_[b_].declaration.filter.mask = 2;
  motion::SpaceTimeBound faster = agents_[b_].bound();
  faster.state.v_WA = {-2, 0, 0};
  const broad_phase::CollisionFilter all;
  const Instant earliest =
      queries_.EarliestUnder({a_, agents_[a_].bound(), all}, {b_, faster, all}, At(0));
  EXPECT_LE(earliest, At(4));
  EXPECT_GT(earliest, At(4 - 1e-6));
}

}  // namespace
}  // namespace collision::detection
