// Goal:   after a renewal each key that other partners rely on is no later than the meeting with
//         the renewed agent; no other key changes.
// Method: random agents, few enough that each key is looked at by itself, and so many that the
//         broad phase finds the near ones; each key is compared with the canonical routine.
#include "collision_core/detection/clearance/key_lowering.h"

#include <gtest/gtest.h>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

class KeyLoweringTest : public testing::Test {
 protected:
  /// An agent whose key was set in an earlier step.
  AgentIndex Add(const Vector3d& p, const Vector3d& v, double key) {
    const auto slot = static_cast<std::uint32_t>(agents_.size());
    const AgentIndex agent =
        agents_.Admit(Id(slot), {.limits = {.radius = 1, .acceleration_max = 1}}, At(0));
    agents_.Store(agent, State(0, p, v), Link::kJumped);
    pairs_.AddAgent(agent);
    coverage_.AddAgent(agent);
    reported_.AddAgent(agent);
    coverage_.Renew(agent, At(0), ClearanceCause::kAdmission);
    index_.Set(slot, agents_[agent].wide_bound());
    filter_.Set(agent, agents_[agent].wide_bound().bound);
    coverage_[agent].renewed_from.reset();
    coverage_[agent].keys.SetAll(At(key));
    coverage_.KeysChanged(agent);
    coverage_.MarkLowerable(agent);
    return agent;
  }

  /// The agent is renewed; `tracked` is the only partner that it is tracked with.
  void Lower(AgentIndex agent, double from = 0, AgentIndex tracked = AgentIndex::None()) {
    marks_.Start(agent, pairs_.table(), agents_.size());
    marks_.Add(agent);
    if (!tracked.is_none()) marks_.Add(tracked);
    coverage_.UnmarkLowerable(agent);
    lowering_.Lower(agent, At(from), marks_);
  }

  Instant KeyOf(AgentIndex agent) const { return coverage_[agent].keys.earliest(); }

  Instant MeetingOf(AgentIndex a, AgentIndex b, double from = 0) const {
    return intersection::EarliestIntersection(agents_[a].wide_bound().bound,
                                              agents_[b].wide_bound().bound, At(from))
        .instant();
  }

  /// Random agents around the renewed one; their keys lie before and after their meetings with it.
  void ExpectCanonicalKeys(std::uint32_t count) {
    Random random(count);
    const AgentIndex renewed = Add({0, 0, 0}, {0, 0, 0}, 50);
    std::vector<AgentIndex> partners;
    std::vector<Instant> before;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vector3d p = random.UnitVector() * random.LogUniform(50, 2000);
      const Vector3d v = random.UnitVector() * random.LogUniform(0.1, 5);
      partners.push_back(Add(p, v, random.LogUniform(5, 100)));
      before.push_back(KeyOf(partners.back()));
    }
    const AgentIndex tracked = partners.at(0), unsettled = partners.at(1);
    coverage_.UnmarkLowerable(unsettled);
    Lower(renewed, 0, tracked);
    std::uint32_t lowered = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const AgentIndex partner = partners[k];
      const bool excepted = partner == tracked || partner == unsettled;
      const Instant expected =
          excepted ? before[k] : std::min(before[k], MeetingOf(renewed, partner));
      ASSERT_EQ(KeyOf(partner), expected) << k;
      if (expected == before[k]) continue;
      ++lowered;
      EXPECT_EQ(coverage_[partner].next_partner, renewed) << k;
    }
    EXPECT_GT(lowered, count / 10) << "the scene tests something";
    EXPECT_LT(lowered, count - count / 10);
    EXPECT_EQ(KeyOf(renewed), At(50));
  }

  StepClock clock_{.now = At(0), .step = 1, .announce_within = 2};
  AgentTable agents_{{}};
  DetectorCounters counters_;
  IndexSet<AgentIndex> dirty_;
  const DetectorContext context_{clock_, agents_, &counters_, &dirty_};
  TrackedPairs pairs_{{}, context_};
  CoverageTable coverage_{context_};
  ReportedClearances reported_{context_, pairs_, coverage_};
  broad_phase::AllPairs index_;
  ClearanceFilter filter_{0};
  PartnerMarks marks_;
  KeyLowering lowering_{context_, {&coverage_, &reported_, &pairs_, &index_, nullptr}, filter_};
};

TEST_F(KeyLoweringTest, OfFewAgentsEachKeyIsLookedAt) {
  ExpectCanonicalKeys(30);
  EXPECT_EQ(lowering_.examined(), 29u) << "all but the one that is not settled";
}

TEST_F(KeyLoweringTest, OfManyAgentsTheBroadPhaseFindsTheNearOnes) { ExpectCanonicalKeys(400); }

TEST_F(KeyLoweringTest, ALowerKeyNamesTheRenewedAgentAsItsCause) {
  const AgentIndex renewed = Add({0, 0, 0}, {0, 0, 0}, 50),
                   partner = Add({100, 0, 0}, {0, 0, 0}, 50);
  reported_.TakeChanged();
  Lower(renewed);
  const std::vector<AgentClearance> changed = reported_.TakeChanged();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].agent, agents_[partner].id);
  EXPECT_EQ(changed[0].cause_agent, agents_[renewed].id);
  EXPECT_EQ(changed[0].clear_until, MeetingOf(renewed, partner));
}

TEST_F(KeyLoweringTest, MeetingsBeforeTheRenewalDoNotCount) {
  const AgentIndex renewed = Add({0, 0, 0}, {0, 0, 0}, 50),
                   partner = Add({30, 0, 0}, {0, 0, 0}, 50);
  ASSERT_LT(MeetingOf(renewed, partner), At(10));
  Lower(renewed, 10);
  EXPECT_EQ(KeyOf(partner), MeetingOf(renewed, partner, 10));
  EXPECT_GE(KeyOf(partner), At(10));
}

// There was no room to track the two, or they would be tracked.
TEST_F(KeyLoweringTest, APartnerThatIsMetByWhatIsAnnouncedIsSaturated) {
  const AgentIndex renewed = Add({0, 0, 0}, {0, 0, 0}, 50);
  const AgentIndex near = Add({3, 0, 0}, {0, 0, 0}, 50), far = Add({100, 0, 0}, {0, 0, 0}, 50);
  ASSERT_LE(MeetingOf(renewed, near), At(2));
  Lower(renewed);
  EXPECT_TRUE(coverage_.IsSaturated(near));
  EXPECT_EQ(coverage_[near].crowded_with, renewed);
  EXPECT_FALSE(coverage_.IsSaturated(far));
}

}  // namespace
}  // namespace collision::detection
