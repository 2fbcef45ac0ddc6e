// Goal:   agents are queued for the time at which they must be queried again; the walk finds a key
//         that promises too little, and a queue that does not agree.
// Method: one or two agents by hand.
#include "collision_core/detection/clearance/keys/coverage_table.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class CoverageTest : public testing::Test {
 protected:
  CoverageTest() {
    for (std::uint32_t k = 0; k < 2; ++k) {
      const AgentIndex agent = agents_.Admit(Id(k), {.limits = {.radius = 1}}, At(0));
      agents_.Store(agent, State(0, {0, 0, 0}, {0, 0, 0}), Link::kJumped);
      coverage_.AddAgent(agent);
      coverage_.Renew(agent, At(0), ClearanceCause::kAdmission);
    }
    clock_.step = 1;
  }

  /// As a query leaves the agent: with one key for all.
  void SetKey(AgentIndex agent, double key) {
    AgentCoverage& record = coverage_[agent];
    record.renewed_from.reset();
    record.queried_step = clock_.step;
    record.keys.SetAll(At(key));
    coverage_.KeysChanged(agent);
  }

  const AgentIndex a_{0u}, b_{1u};
  StepClock clock_{.now = At(0), .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  CoverageTable coverage_{{clock_, agents_, &counters_, &dirty_}};
};

TEST_F(CoverageTest, AgentsWaitForTheirEarliestKey) {
  SetKey(a_, 30);
  SetKey(b_, 20);
  EXPECT_EQ(coverage_.due().top(), b_);
  EXPECT_EQ(coverage_.KeyOf(a_, b_), At(30));
  coverage_.LowerKey(a_, b_, At(10));
  EXPECT_EQ(coverage_.due().top(), a_);
  EXPECT_EQ(coverage_.due().top_key(), At(10));
  coverage_.LowerKey(a_, b_, At(15));
  EXPECT_EQ(coverage_.KeyOf(a_, b_), At(10)) << "a key is never raised";
  coverage_.Validate();
  EXPECT_TRUE(dirty_.Contains(a_) && dirty_.Contains(b_));
}

TEST_F(CoverageTest, ASaturatedAgentIsQueriedAgainSoon) {
  SetKey(a_, 30);
  SetKey(b_, 30);
  coverage_.Saturate(a_, b_);
  EXPECT_TRUE(coverage_.IsSaturated(a_));
  EXPECT_EQ(counters_.saturations, 1u);
  EXPECT_GT(coverage_.due().KeyOf(a_), clock_.announce_until());
  EXPECT_LT(coverage_.due().KeyOf(a_), At(2.3));
  coverage_.Saturate(a_, b_);
  EXPECT_EQ(counters_.saturations, 1u) << "it was saturated already";
  coverage_.Validate();
}

TEST_F(CoverageTest, SettledAgentsStandByTheirLatestKeys) {
  SetKey(a_, 30);
  SetKey(b_, 50);
  coverage_.MarkLowerable(a_);
  coverage_.MarkLowerable(b_);
  EXPECT_EQ(coverage_.LatestKey(), At(50));
  std::vector<AgentIndex> far;
  coverage_.AppendLowerableFrom(At(40), &far);
  EXPECT_EQ(far, std::vector{b_});
  coverage_.LowerKey(b_, a_, At(20));
  EXPECT_EQ(coverage_.LatestKey(), At(30));
  coverage_.Validate();
}

TEST_F(CoverageTest, AStateAheadOfItsKeyIsQueriedAtOnce) {
  SetKey(a_, 5);
  SetKey(b_, 30);
  agents_.Store(a_, State(6, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  coverage_.StateAdvanced(a_);
  EXPECT_EQ(coverage_.due().top(), a_);
  EXPECT_EQ(coverage_.due().top_key(), Instant::Always());
}

// Also after a query in the same step, and when one of its keys is lowered after that.
TEST_F(CoverageTest, AStateAheadIsQueriedAtOnceThoughItsKeyIsLowered) {
  SetKey(a_, 5);
  SetKey(b_, 30);
  agents_.Store(a_, State(6, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  coverage_.StateAdvanced(a_);
  coverage_.LowerKey(a_, b_, At(4));
  EXPECT_EQ(coverage_.due().top(), a_);
  EXPECT_EQ(coverage_.due().top_key(), Instant::Always());
}

TEST_F(CoverageTest, ValidateFindsAKeyThatIsAlreadyDue) {
  SetKey(a_, 30);
  SetKey(b_, 30);
  coverage_.Validate();
  SetKey(b_, 1);  // within announce_within: its pair should be tracked
  EXPECT_THROW(coverage_.Validate(), CheckFailure);
}

TEST_F(CoverageTest, ValidateFindsASettledAgentWhoseKeyWasChangedBehindItsBack) {
  SetKey(a_, 30);
  SetKey(b_, 30);
  coverage_.MarkLowerable(a_);
  coverage_[a_].keys.SetAll(At(25));
  EXPECT_THROW(coverage_.Validate(), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
