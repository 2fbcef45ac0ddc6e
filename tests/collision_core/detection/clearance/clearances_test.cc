// Goal:   what the façade reports about agents reaches the broad phase, the keys and the published
//         clearances: a clearance is never later than the first meeting, and nearly tight.
// Method: unit balls without acceleration that come at 1 m/s, so that one at distance 2 + t is met
//         after t; the test plays the façade.
#include "collision_core/detection/clearance/clearances.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/clearance/clearance_scene.h"

namespace collision::detection {
namespace {

class ClearancesTest : public testing::Test {
 protected:
  AgentIndex Add(const Vector3d& p, const Vector3d& v, double acceleration_max = 0) {
    const auto slot = static_cast<std::uint32_t>(agents_.index_end());
    const AgentIndex agent = agents_.Admit(
        Id(slot), {.limits = {.radius = 1, .acceleration_max = acceleration_max}}, clock_.now);
    pairs_.AddAgent(agent);
    clearances_.AddAgent(agent);
    Store(agent, 0, p, v, Link::kJumped);
    Renew(agent, ClearanceCause::kAdmission);
    return agent;
  }
  void Store(AgentIndex agent, double t, const Vector3d& p, const Vector3d& v, Link link) {
    agents_.Store(agent, State(t, p, v), link);
    agents_.RecordBound(agent);
  }
  void Renew(AgentIndex agent, ClearanceCause cause, double effective_from = 0) {
    clearances_.Renew(agent, {clock_.now, cause, At(effective_from)});
  }
  void Step(double now) {
    clock_.now = At(now);
    ++clock_.step;
    clearances_.QueryDueAgents();
    clearances_.Validate();
  }
  Instant ClearUntil(AgentIndex agent) const { return clearances_.Of(agent).clear_until; }

  StepClock clock_{.now = At(0), .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  const DetectorContext context_{clock_, agents_, &counters_, &dirty_};
  TrackedPairs pairs_{{}, context_};
  Clearances clearances_{{}, context_, &pairs_};
};

TEST_F(ClearancesTest, AfterAStepBothAgentsAreClearUntilTheirMeeting) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({32, 0, 0}, {-1, 0, 0});
  const AgentIndex apart = Add({0, 0, 500}, {0, 0, 0});
  Step(0);
  ExpectNearlyAt(ClearUntil(a), 30);
  ExpectNearlyAt(ClearUntil(b), 30);
  EXPECT_TRUE(ClearUntil(apart).is_never());
  const std::vector<AgentClearance> first = clearances_.TakeChanged();
  ASSERT_EQ(first.size(), 3u);
  EXPECT_EQ(first[0].clear_until, ClearUntil(a));
  EXPECT_EQ(first[0].cause, ClearanceCause::kAdmission);
  EXPECT_TRUE(clearances_.TakeChanged().empty());
}

TEST_F(ClearancesTest, AMeetingToBeAnnouncedIsLeftToATrackedPair) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({3.5, 0, 0}, {-1, 0, 0});
  Step(0);
  EXPECT_EQ(pairs_.table().Of(a).size(), 1u);
  EXPECT_TRUE(clearances_.coverage()[a].keys.earliest().is_never());
  ExpectNearlyAt(ClearUntil(b), 1.5);
}

TEST_F(ClearancesTest, ARenewedAgentLowersItsPartnersClearanceAndIsNamed) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({0, 0, 500}, {0, 0, 0});
  Step(0);
  clearances_.TakeChanged();
  Store(b, 0, {12, 0, 0}, {-1, 0, 0}, Link::kJumped);
  Renew(b, ClearanceCause::kTeleport, 0.5);
  Step(0);
  const std::vector<AgentClearance> changed = clearances_.TakeChanged();
  ASSERT_EQ(changed.size(), 2u);
  for (const AgentClearance& clearance : changed) {
    ExpectNearlyAt(clearance.clear_until, 10);
    EXPECT_EQ(clearance.cause, ClearanceCause::kTeleport);
    EXPECT_EQ(clearance.cause_agent, agents_[b].id);
  }
  EXPECT_EQ(clearances_.Of(b).effective_from, At(0.5));
  EXPECT_EQ(clearances_.Of(a).effective_from, At(0));
}

// ½ 1 t² = 50 at 10 s; a state at 5 s with nothing gained leaves 15 s.
TEST_F(ClearancesTest, ATighterBoundKeepsAllKeysAndCountsInLaterQueries) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({52, 0, 0}, {0, 0, 0}, 1);
  Step(0);
  const Instant key = ClearUntil(a);
  ExpectNearlyAt(key, 10);
  const std::uint64_t queries = counters_.queries;
  Store(b, 5, {52, 0, 0}, {0, 0, 0}, Link::kFollows);
  clearances_.Tighten(b);
  clearances_.StateAdvanced(b);
  Step(5);
  EXPECT_EQ(ClearUntil(a), key);
  EXPECT_EQ(ClearUntil(b), key);
  EXPECT_EQ(counters_.queries, queries);
  Step(8);
  ExpectNearlyAt(ClearUntil(a), 15);
}

TEST_F(ClearancesTest, AStateBeyondItsKeyIsQueriedAtOnce) {
  Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex b = Add({52, 0, 0}, {0, 0, 0}, 1);
  Step(0);
  const std::uint64_t queries = counters_.queries;
  Store(b, 11, {52, 0, 0}, {0, 0, 0}, Link::kFollows);
  clearances_.Tighten(b);
  clearances_.StateAdvanced(b);
  Step(1);
  EXPECT_EQ(counters_.queries, queries + 1);
  ExpectNearlyAt(clearances_.coverage()[b].keys.earliest(), 21);
}

TEST_F(ClearancesTest, AnAgentThatExpiredIsMetByNoneUntilItIsBack) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({32, 0, 0}, {-1, 0, 0});
  Step(0);
  dirty_.Clear();
  agents_.SetExpired(b);
  clearances_.Remove(b);
  EXPECT_TRUE(dirty_.Contains(b));
  Renew(a, ClearanceCause::kWidening);
  clearances_.Readmit(a);
  Step(0);
  EXPECT_TRUE(ClearUntil(a).is_never());

  agents_[b].expired = false;
  clearances_.Readmit(b);
  Renew(b, ClearanceCause::kAdmission);
  Step(0);
  ExpectNearlyAt(ClearUntil(a), 30);
  ExpectNearlyAt(ClearUntil(b), 30);
}

TEST_F(ClearancesTest, AReleasedPairIsCoveredByBothKeys) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({0, 500, 0}, {0, 0, 0});
  const AgentIndex other = Add({0, 0, 500}, {0, 0, 0});
  Step(0);
  clearances_.voided()->Clear();
  clearances_.Cover({{a, b, At(10)}});
  EXPECT_EQ(ClearUntil(a), At(10));
  EXPECT_EQ(ClearUntil(b), At(10));
  EXPECT_TRUE(ClearUntil(other).is_never());
  EXPECT_TRUE(clearances_.voided()->Contains(a) && clearances_.voided()->Contains(b));
  EXPECT_FALSE(clearances_.voided()->Contains(other));
  clearances_.Cover({{a, b, At(20)}});
  EXPECT_EQ(ClearUntil(a), At(10)) << "no key becomes later";
}

TEST_F(ClearancesTest, OfARenewalOnlyTrackedPartnersAreToldAtOnce) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0}), b = Add({3.5, 0, 0}, {-1, 0, 0});
  const AgentIndex other = Add({0, 0, 50}, {0, 0, 0});
  Step(0);
  clearances_.TakeChanged();
  Renew(b, ClearanceCause::kWidening);
  dirty_.Clear();
  clearances_.NotifyPartners(b);
  EXPECT_TRUE(dirty_.Contains(a));
  EXPECT_FALSE(dirty_.Contains(other));
}

TEST_F(ClearancesTest, ABreachVoidsPromisesFromTheLastHonestState) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0});
  Step(0);
  clearances_.TakeChanged();
  clearances_.RecordBreach(a, At(3));
  Renew(a, ClearanceCause::kBreach);
  Step(4);
  const std::vector<AgentClearance> changed = clearances_.TakeChanged();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].void_from, At(3));
  EXPECT_EQ(changed[0].cause, ClearanceCause::kBreach);
}

TEST_F(ClearancesTest, FormerMotionsAreKeptUntilTheyAreForgotten) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0});
  clearances_.RecordFormerMotion(a, agents_[a].wide_bound(), At(5));
  EXPECT_EQ(clearances_.former()->size(), 1u);
  clearances_.ForgetBefore(At(4.9));
  EXPECT_EQ(clearances_.former()->size(), 1u);
  clearances_.ForgetBefore(At(5));
  EXPECT_EQ(clearances_.former()->size(), 0u);
}

TEST_F(ClearancesTest, EachPairQueryOfTheBroadPhaseIsCountedOnce) {
  const AgentIndex a = Add({0, 0, 0}, {0, 0, 0});
  for (int k = 1; k < 9; ++k) Add({5.0 * k, 0, 0}, {-1, 0, 0});
  Step(0);
  const std::uint64_t by_pair_queries =
      counters_.pair_queries - clearances_.broad_phase()->work().pair_queries;
  Renew(a, ClearanceCause::kWidening);
  std::vector<broad_phase::Neighbour> found;
  const std::uint64_t before = clearances_.broad_phase()->work().pair_queries;
  clearances_.broad_phase()->FindNeighbours(
      0, {At(0), At(9), At(9)}, [](std::uint32_t) { return false; }, &found);
  ASSERT_GT(clearances_.broad_phase()->work().pair_queries, before);
  for (int k = 0; k < 2; ++k) {
    clearances_.UpdateCounters();
    EXPECT_EQ(counters_.pair_queries,
              clearances_.broad_phase()->work().pair_queries + by_pair_queries);
  }
  EXPECT_GE(counters_.filter_tests, clearances_.broad_phase()->work().filter_tests);
}

}  // namespace
}  // namespace collision::detection
