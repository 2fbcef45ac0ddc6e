// Goal:   a clearance is published when it differs from the last one or its promises are void; a
//         lower one names its cause, and of several causes the breach that voids most.
// Method: three agents by hand; the test sets their keys as queries would leave them.
#include "collision_core/detection/clearance/keys/reported_clearances.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class ReportedClearancesTest : public testing::Test {
 protected:
  void SetUp() override {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const AgentIndex agent = agents_.Admit(Id(k), {.limits = {.radius = 1}}, At(0));
      agents_.Store(agent, State(0, {10.0 * k, 0, 0}, {0, 0, 0}), Link::kJumped);
      pairs_.AddAgent(agent);
      coverage_.AddAgent(agent);
      reported_.AddAgent(agent);
      Renew(agent, ClearanceCause::kAdmission);
      SetKey(agent, 30);
    }
  }

  /// The agent's own promises are void, for this cause.
  void Renew(AgentIndex agent, ClearanceCause cause) {
    coverage_.Renew(agent, clock_.now, cause);
    reported_.RecordRenewal(agent);
  }
  void Break(AgentIndex agent, double from) {
    reported_.RecordBreach(agent, At(from));
    Renew(agent, ClearanceCause::kBreach);
  }

  /// As a query leaves the agent: with one key for all.
  void SetKey(AgentIndex agent, double key) {
    AgentCoverage& record = coverage_[agent];
    record.renewed_from.reset();
    record.keys.SetAll(At(key));
    coverage_.KeysChanged(agent);
  }

  /// The only clearance that is published now.
  AgentClearance TakeOnly() {
    const std::vector<AgentClearance> changed = reported_.TakeChanged();
    EXPECT_EQ(changed.size(), 1u);
    return changed.empty() ? AgentClearance{} : changed[0];
  }

  const AgentIndex a_{0u}, b_{1u}, c_{2u};
  StepClock clock_{.now = At(0), .step = 1, .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  const DetectorContext context_{clock_, agents_, &counters_, &dirty_};
  TrackedPairs pairs_{{}, context_};
  CoverageTable coverage_{context_};
  ReportedClearances reported_{context_, pairs_, coverage_};
};

TEST_F(ReportedClearancesTest, FirstClearancesNameTheAdmissionInTheOrderOfIds) {
  dirty_.Clear();
  for (const AgentIndex agent : {c_, a_, b_}) dirty_.Insert(agent);
  const std::vector<AgentClearance> first = reported_.TakeChanged();
  ASSERT_EQ(first.size(), 3u);
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_EQ(first[k].agent, Id(k));
    EXPECT_EQ(first[k].clear_until, At(30));
    EXPECT_EQ(first[k].unannounced_until, At(30));
    EXPECT_FALSE(first[k].not_clear || first[k].in_contact || first[k].saturated);
    EXPECT_EQ(first[k].cause, ClearanceCause::kAdmission);
    EXPECT_EQ(first[k].cause_agent, Id(k));
    EXPECT_TRUE(first[k].void_from.is_never());
  }
}

TEST_F(ReportedClearancesTest, ClearancesThatAreTheSameAreNotPublished) {
  reported_.TakeChanged();
  for (const AgentIndex agent : {a_, b_, c_}) SetKey(agent, 30);
  EXPECT_TRUE(reported_.TakeChanged().empty());
}

TEST_F(ReportedClearancesTest, ALowerClearanceNamesThePartnerThatLowersIt) {
  reported_.TakeChanged();
  coverage_.Renew(b_, At(0), ClearanceCause::kTeleport);
  SetKey(b_, 30);
  reported_.NotifyPartner(a_, b_);
  coverage_.LowerKey(a_, b_, At(10));
  const AgentClearance lower = TakeOnly();
  EXPECT_EQ(lower.agent, Id(0));
  EXPECT_EQ(lower.clear_until, At(10));
  EXPECT_EQ(lower.cause, ClearanceCause::kTeleport);
  EXPECT_EQ(lower.cause_agent, Id(1));
  EXPECT_TRUE(lower.void_from.is_never());
}

TEST_F(ReportedClearancesTest, AHigherClearanceNamesNoPartnerButItsOwnRenewal) {
  reported_.TakeChanged();
  coverage_.Renew(b_, At(0), ClearanceCause::kTeleport);
  SetKey(b_, 30);
  reported_.NotifyPartner(a_, b_);
  SetKey(a_, 40);
  EXPECT_EQ(TakeOnly().cause, ClearanceCause::kNone);
  coverage_.LowerKey(a_, b_, At(20));
  EXPECT_EQ(TakeOnly().cause, ClearanceCause::kNone) << "a cause counts in one step";
  Renew(a_, ClearanceCause::kWidening);
  SetKey(a_, 50);
  const AgentClearance own = TakeOnly();
  EXPECT_EQ(own.cause, ClearanceCause::kWidening);
  EXPECT_EQ(own.cause_agent, Id(0));
}

TEST_F(ReportedClearancesTest, ABreachVoidsThePromisesOfTheBreakerAndOfThoseItLowers) {
  reported_.TakeChanged();
  Break(b_, 3);
  SetKey(b_, 30);
  reported_.NotifyPartner(a_, b_);
  coverage_.LowerKey(a_, b_, At(10));
  const std::vector<AgentClearance> changed = reported_.TakeChanged();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[1].clear_until, At(30)) << "published though it is as high as before";
  for (const AgentClearance& clearance : changed) {
    EXPECT_EQ(clearance.cause, ClearanceCause::kBreach);
    EXPECT_EQ(clearance.cause_agent, Id(1));
    EXPECT_EQ(clearance.void_from, At(3));
  }
  EXPECT_TRUE(reported_.TakeChanged().empty());
}

TEST_F(ReportedClearancesTest, OfSeveralCausesTheEarliestBreachIsNamed) {
  reported_.TakeChanged();
  Break(b_, 3);
  reported_.NotifyPartner(a_, b_);
  coverage_.Renew(c_, At(0), ClearanceCause::kTeleport);
  reported_.NotifyPartner(a_, c_);
  coverage_.LowerKey(a_, b_, At(10));
  AgentClearance lower = reported_.TakeChanged().at(0);
  EXPECT_EQ(lower.cause_agent, Id(1)) << "a jump after the breach";
  EXPECT_EQ(lower.void_from, At(3));

  Break(c_, 2);
  reported_.NotifyPartner(a_, c_);
  Break(b_, 5);
  reported_.NotifyPartner(a_, b_);
  coverage_.LowerKey(a_, b_, At(9));
  lower = reported_.TakeChanged().at(0);
  EXPECT_EQ(lower.cause_agent, Id(2)) << "a later breach";
  EXPECT_EQ(lower.void_from, At(2));
}

TEST_F(ReportedClearancesTest, PromisesCountFromTheLatestOfSeveralInstants) {
  reported_.TakeChanged();
  reported_.SetEffectiveFrom(a_, At(4));
  reported_.SetEffectiveFrom(a_, At(2));
  EXPECT_EQ(reported_.Of(a_).effective_from, At(4));
  SetKey(a_, 30);
  EXPECT_EQ(TakeOnly().effective_from, At(4)) << "a change by itself";
}

TEST_F(ReportedClearancesTest, ATrackedPairLimitsTheClearancesOfItsTwoAgents) {
  reported_.TakeChanged();
  ASSERT_TRUE(pairs_.Track(a_, b_, At(12), Past::kKnown));
  const std::vector<AgentClearance> changed = reported_.TakeChanged();
  ASSERT_EQ(changed.size(), 2u);
  for (const AgentClearance& clearance : changed) {
    EXPECT_EQ(clearance.clear_until, At(12));
    EXPECT_EQ(clearance.unannounced_until, At(12));
    EXPECT_EQ(clearance.cause, ClearanceCause::kNone);
  }
  EXPECT_EQ(reported_.Of(c_).clear_until, At(30));
}

// They meet at 1 s.
TEST_F(ReportedClearancesTest, AnAnnouncedPairLimitsOnlyTheClearance) {
  agents_.Store(b_, State(0, {10, 0, 0}, {-8, 0, 0}), Link::kJumped);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kKnown));
  pairs_.EvaluateDuePairs();
  const AgentClearance clearance = reported_.Of(a_);
  EXPECT_LE(clearance.clear_until, At(1));
  EXPECT_GT(clearance.clear_until, At(0.999));
  EXPECT_EQ(clearance.unannounced_until, At(30));
}

// A contact that is known limits no promise about new ones.
TEST_F(ReportedClearancesTest, AContactIsReportedAndDoesNotLimitTheClearance) {
  agents_.Store(b_, State(0, {1, 0, 0}, {0, 0, 0}), Link::kJumped);
  ASSERT_TRUE(pairs_.Track(a_, b_, At(0), Past::kUnknown));
  for (std::uint32_t k = 0; k < 2; ++k) agents_.SetHeardUntil(OwnerOf(Id(k)), At(1));
  clock_.now = At(1);
  pairs_.EvaluateDuePairs();
  const AgentClearance clearance = reported_.Of(a_);
  EXPECT_TRUE(clearance.in_contact);
  EXPECT_EQ(clearance.clear_until, At(30));
  EXPECT_FALSE(clearance.not_clear);
}

// Also if its state, and with it its key, lies ahead of now.
TEST_F(ReportedClearancesTest, ASaturatedAgentIsClearUntilNow) {
  reported_.TakeChanged();
  agents_.Store(a_, State(5, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  coverage_.Saturate(a_, b_);
  const AgentClearance clearance = TakeOnly();
  EXPECT_TRUE(clearance.saturated);
  EXPECT_TRUE(clearance.not_clear);
  EXPECT_EQ(clearance.clear_until, At(0));
  clock_.now = At(1);
  EXPECT_EQ(reported_.Of(a_).clear_until, At(1));
}

TEST_F(ReportedClearancesTest, ARemovedAgentHasNoClearance) {
  agents_.Remove(b_);
  const std::vector<AgentClearance> changed = reported_.TakeChanged();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].agent, Id(0));
  EXPECT_EQ(changed[1].agent, Id(2));
}

}  // namespace
}  // namespace collision::detection
