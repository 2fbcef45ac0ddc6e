// Goal:   in each step the agents that were renewed or whose key is due are queried, and no others;
//         a key is the first meeting with an untracked partner, never later and nearly tight.
// Method: unit balls without acceleration that come at 1 m/s, so that one at distance 2 + t is met
//         after t; the tables are walked after each step.
#include "collision_core/detection/clearance/clearance_queries.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/clearance/clearance_scene.h"

namespace collision::detection {
namespace {

class Scene : public ClearanceScene {
 public:
  using ClearanceScene::ClearanceScene;

  AgentIndex AddSettled(const Vector3d& p, const Vector3d& v,
                        const motion::MotionLimits& limits = {1}) {
    const AgentIndex agent = Add(p, v, limits);
    filter.Set(agent, agents[agent].wide_bound().bound);
    coverage[agent].queried_step = 0;
    return agent;
  }
  void Renew(AgentIndex agent) {
    coverage.Renew(agent, clock.now, ClearanceCause::kTeleport);
    filter.Set(agent, agents[agent].wide_bound().bound);
  }
  AgentIndex AddRenewed(const Vector3d& p, const Vector3d& v,
                        const motion::MotionLimits& limits = {1}) {
    const AgentIndex agent = AddSettled(p, v, limits);
    Renew(agent);
    return agent;
  }

  void Step(double now) {
    clock.now = At(now);
    ++clock.step;
    queries.QueryDueAgents();
    coverage.Validate();
  }

  Instant KeyOf(AgentIndex agent) const { return coverage[agent].keys.earliest(); }
  bool WasQueried(AgentIndex agent) const { return coverage[agent].queried_step == clock.step; }

  ClearanceFilter filter{0};
  ClearanceQueries queries{context, {&coverage, &reported, &pairs, &index, &former}, filter};
};

TEST(ClearanceQueries, ARenewedAgentGetsTheKeyOfItsFirstMeetingAndLowersThatOfThePartner) {
  Scene scene;
  const AgentIndex partner = scene.AddSettled({0, 0, 0}, {0, 0, 0});
  const AgentIndex apart = scene.AddSettled({0, 0, 500}, {0, 0, 0});
  const AgentIndex renewed = scene.AddRenewed({32, 0, 0}, {-1, 0, 0});
  scene.Step(0);
  ExpectNearlyAt(scene.KeyOf(renewed), 30);
  EXPECT_EQ(scene.coverage[renewed].next_partner, partner);
  EXPECT_EQ(scene.KeyOf(partner), scene.KeyOf(renewed));
  EXPECT_TRUE(scene.KeyOf(apart).is_never());
  EXPECT_TRUE(scene.WasQueried(renewed));
  EXPECT_FALSE(scene.WasQueried(partner)) << "its key is lowered without a query";
  EXPECT_EQ(scene.counters.queries, 1u);
}

TEST(ClearanceQueries, AfterItsQueryAnAgentIsSettled) {
  Scene scene;
  const AgentIndex renewed = scene.AddRenewed({32, 0, 0}, {-1, 0, 0});
  EXPECT_FALSE(scene.coverage.IsLowerable(renewed));
  scene.coverage.voided()->Clear();
  scene.Step(0);
  EXPECT_FALSE(scene.coverage[renewed].renewed_from.has_value());
  EXPECT_EQ(scene.coverage[renewed].renewed_cause, ClearanceCause::kNone);
  EXPECT_TRUE(scene.coverage.renewed()->empty());
  EXPECT_TRUE(scene.coverage.IsLowerable(renewed));
  EXPECT_TRUE(scene.coverage.voided()->Contains(renewed));
  scene.Step(1);
  EXPECT_EQ(scene.counters.queries, 1u) << "nothing else is due";
}

// The real meeting is at 30 s.
TEST(ClearanceQueries, AnAgentIsQueriedWhenItsKeyIsAsNearAsWhatIsAnnounced) {
  Scene scene;
  const AgentIndex agent = scene.AddSettled({0, 0, 0}, {0, 0, 0});
  const AgentIndex partner = scene.AddSettled({32, 0, 0}, {-1, 0, 0});
  scene.SetKey(agent, At(10));
  scene.SetKey(partner, At(30));
  scene.Step(7.999);
  EXPECT_FALSE(scene.WasQueried(agent));
  scene.Step(8);
  EXPECT_TRUE(scene.WasQueried(agent));
  ExpectNearlyAt(scene.KeyOf(agent), 30);
  EXPECT_FALSE(scene.WasQueried(partner));
  EXPECT_EQ(scene.counters.queries, 1u);
}

TEST(ClearanceQueries, APartnerThatIsMetSoonIsTrackedAndTheKeyIsOfTheNext) {
  Scene scene;
  const AgentIndex agent = scene.AddRenewed({0, 0, 0}, {0, 0, 0});
  const AgentIndex near = scene.AddRenewed({3.5, 0, 0}, {-1, 0, 0});
  scene.AddSettled({0, 0, 42}, {0, 0, -1});
  scene.Step(0);
  ASSERT_EQ(scene.pairs.table().Of(agent).size(), 1u);
  EXPECT_EQ(scene.pairs.table().Of(near).size(), 1u) << "tracked once, though both were renewed";
  ExpectNearlyAt(scene.KeyOf(agent), 40);
}

// Each is left out of what the other's renewal lowers: its own query sees the new bound.
TEST(ClearanceQueries, TwoThatAreRenewedInOneStepBothKnowOfTheirMeeting) {
  Scene scene;
  const AgentIndex a = scene.AddRenewed({0, 0, 0}, {0, 0, 0});
  const AgentIndex b = scene.AddRenewed({22, 0, 0}, {-1, 0, 0});
  scene.Step(0);
  ExpectNearlyAt(scene.KeyOf(a), 20);
  ExpectNearlyAt(scene.KeyOf(b), 20);
}

// Goal:   a partner that accelerates much harder is queried for by itself, as often as it must, and
//         the key of the comparable partners stays.
TEST(ClearanceQueries, WhereOnlyTheKeyOfATierIsDueTheComparableKeyStays) {
  Scene scene;
  const motion::MotionLimits slow{.radius = 1, .acceleration_max = 1e-9},
      fast{.radius = 1, .acceleration_max = 1};
  const AgentIndex agent = scene.AddRenewed({0, 0, 0}, {0, 0, 0}, slow);
  scene.AddRenewed({1002, 0, 0}, {-1, 0, 0}, slow);
  const AgentIndex harder = scene.AddRenewed({0, 52, 0}, {0, 0, 0}, fast);
  const int band = scene.coverage.tiers().BandOf(harder, agent);
  scene.Step(0);
  ClearanceKeys& keys = scene.coverage[agent].keys;
  ExpectNearlyAt(keys.Of(band), 10);  // ½ 1 10² = 50
  EXPECT_LE(keys.comparable(), At(1000));
  EXPECT_GT(keys.comparable(), At(990));
  const Instant tier = keys.Of(band);
  keys.SetAll(At(500));  // earlier than a query would set it
  keys.SetTier(band, tier);
  scene.coverage.KeysChanged(agent);
  scene.agents.Store(harder, State(8.5, {0, 52, 0}, {0, 0, 0}), Link::kFollows);
  scene.index.Tighten(harder.value(), scene.agents[harder].wide_bound());
  scene.Step(8.5);
  EXPECT_TRUE(scene.WasQueried(agent));
  EXPECT_EQ(keys.comparable(), At(500));
  ExpectNearlyAt(keys.Of(band), 18.5);
  EXPECT_EQ(scene.coverage[agent].next_partner, harder);
  EXPECT_TRUE(scene.coverage.IsLowerable(agent));
}

TEST(ClearanceQueries, ASaturatedAgentIsQueriedAgainAfterASixteenthOfWhatIsAnnounced) {
  Scene scene(1);
  const AgentIndex agent = scene.AddRenewed({0, 0, 0}, {0, 0, 0});
  scene.AddSettled({3.5, 0, 0}, {-1, 0, 0});
  const AgentIndex second = scene.AddSettled({0, 3.5, 0}, {0, -1, 0});
  scene.Step(0);
  ASSERT_TRUE(scene.coverage.IsSaturated(agent));
  EXPECT_EQ(scene.coverage[agent].crowded_with, second);
  EXPECT_FALSE(scene.coverage.IsLowerable(agent));
  scene.Step(0.124);
  EXPECT_FALSE(scene.WasQueried(agent)) << "the first of all agents waits for the shortest time";
  scene.Step(0.126);
  EXPECT_TRUE(scene.WasQueried(agent));
  EXPECT_TRUE(scene.coverage.IsSaturated(agent));
  scene.agents[second].declaration.filter.mask = 0;
  scene.index.Set(second.value(), scene.agents[second].wide_bound());
  scene.Step(0.6);
  EXPECT_FALSE(scene.coverage.IsSaturated(agent)) << "there is room for the other one";
  EXPECT_TRUE(scene.KeyOf(agent).is_never());
}

TEST(ClearanceQueries, AnAgentWhosePromisesRanOutIsNotQueried) {
  Scene scene;
  const AgentIndex agent = scene.AddRenewed({0, 0, 0}, {0, 0, 0});
  scene.coverage.Remove(agent);
  scene.agents.SetExpired(agent);
  scene.Step(0);
  EXPECT_FALSE(scene.WasQueried(agent));
  EXPECT_EQ(scene.counters.queries, 0u);
}

// Goal:   where very many are renewed, agents with far keys are queried anew instead; an earlier
//         key stays, and a lower one names the renewed agent.
// Method: 5000 agents at rest, of which one comes; two settled agents, of which it meets one.
TEST(ClearanceQueries, AfterVeryManyRenewalsFarKeysComeFromQueries) {
  constexpr int kRenewed = 5000;
  Scene scene(256, broad_phase::BroadPhaseMethod::kSpatialIndex);
  const AgentIndex met = scene.AddSettled({0, 0, 0}, {0, 0, 0});
  const AgentIndex apart = scene.AddSettled({0, 1000, 0}, {0, 0, 0});
  scene.SetKey(met, At(100));
  scene.SetKey(apart, At(100));
  const AgentIndex coming = scene.AddRenewed({52, 0, 0}, {-1, 0, 0});
  for (int k = 1; k < kRenewed; ++k) scene.AddRenewed({0, 0, 50.0 * k}, {0, 0, 0});
  scene.reported.TakeChanged();
  scene.Step(0);
  EXPECT_TRUE(scene.WasQueried(met) && scene.WasQueried(apart));
  EXPECT_EQ(scene.counters.queries, kRenewed + 2u);
  ExpectNearlyAt(scene.KeyOf(met), 50);
  EXPECT_EQ(scene.KeyOf(apart), At(100)) << "an earlier key stays";
  EXPECT_EQ(scene.coverage[coming].renewed_cause, ClearanceCause::kNone);
  const std::vector<AgentClearance> changed = scene.reported.TakeChanged();
  ASSERT_FALSE(changed.empty());
  EXPECT_EQ(changed[0].agent, scene.agents[met].id);
  EXPECT_EQ(changed[0].cause, ClearanceCause::kTeleport);
  EXPECT_EQ(changed[0].cause_agent, scene.agents[coming].id);
}

}  // namespace
}  // namespace collision::detection
