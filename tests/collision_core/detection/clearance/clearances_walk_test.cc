// Goal:   the broad phase holds the agents that have not expired, and the walk finds one too many
//         or too few.
// Method: two agents by hand; the broad phase is changed behind the back of its owner.
#include <gtest/gtest.h>

#include "collision_core/detection/clearance/clearances.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class ClearancesWalkTest : public testing::Test {
 protected:
  ClearancesWalkTest() {
    for (const AgentIndex agent : {a_, b_}) {
      agents_.Admit(Id(agent.value()), {.limits = {.radius = 1}}, At(0));
      agents_.Store(agent, State(0, {10.0 * agent.value(), 0, 0}, {0, 0, 0}), Link::kJumped);
      agents_.RecordBound(agent);
      pairs_.AddAgent(agent);
      clearances_.AddAgent(agent);
      clearances_.Renew(agent, {At(0), ClearanceCause::kAdmission, At(0)});
    }
  }

  const AgentIndex a_{0u}, b_{1u};
  StepClock clock_{.now = At(0), .step = 1, .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  const DetectorContext context_{clock_, agents_, &counters_, &dirty_};
  TrackedPairs pairs_{{}, context_};
  Clearances clearances_{{}, context_, &pairs_};
};

TEST_F(ClearancesWalkTest, HoldsAnAgentUntilItExpires) {
  clearances_.Validate();
  agents_.SetExpired(a_);
  clearances_.Remove(a_);
  clearances_.Validate();
  agents_[a_].expired = false;
  clearances_.Readmit(a_);
  clearances_.Renew(a_, {At(1), ClearanceCause::kAdmission, At(1)});
  clearances_.Validate();
}

TEST_F(ClearancesWalkTest, ValidateFindsAnAgentThatTheBroadPhaseDoesNotHold) {
  clearances_.broad_phase()->Remove(b_.value());
  EXPECT_THROW(clearances_.Validate(), CheckFailure);
}

TEST_F(ClearancesWalkTest, ValidateFindsAnAgentOfTheBroadPhaseThatIsNotThere) {
  clearances_.broad_phase()->Set(7, agents_[a_].wide_bound());
  EXPECT_THROW(clearances_.Validate(), CheckFailure);
}

TEST_F(ClearancesWalkTest, ValidateFindsAnotherAgentInsteadOfOneThatIsThere) {
  clearances_.broad_phase()->Remove(b_.value());
  clearances_.broad_phase()->Set(7, agents_[a_].wide_bound());
  EXPECT_THROW(clearances_.Validate(), CheckFailure);
}

TEST_F(ClearancesWalkTest, ValidateWalksTheBroadPhase) {
  clearances_.broad_phase()->Tighten(7, agents_[a_].wide_bound());
  EXPECT_THROW(clearances_.Validate(), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
