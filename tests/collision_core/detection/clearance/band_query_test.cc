// Goal:   a query tracks the partners that may be met while they are announced, marks them, and
//         returns the first intersection with one of the others; without room it saturates the
//         agent, in a crowd with one pair query.
// Method: unit balls without acceleration that come at 1 m/s, so that one at distance 2 + t is met
//         after t.
#include "collision_core/detection/clearance/search/band_query.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/clearance/clearance_scene.h"

namespace collision::detection {
namespace {

class Scene : public ClearanceScene {
 public:
  using ClearanceScene::ClearanceScene;

  /// A partner that agent 0, at rest at the origin, meets after `seconds`, from above. No two
  /// partners are at the same place.
  AgentIndex AddMetAfter(double seconds) {
    const double shift = 0x1p-20 * static_cast<double>(agents.size());
    return Add({shift, 0, 2 + seconds}, {0, 0, -1});
  }

  const PairRecord* PairOf(AgentIndex a, AgentIndex b) const {
    for (const PairSlot slot : pairs.table().Of(a)) {
      if (pairs.table()[slot].PartnerOf(a) == b) return &pairs.table()[slot];
    }
    return nullptr;
  }
  bool AreTracked(AgentIndex a, AgentIndex b) const { return PairOf(a, b) != nullptr; }

  BandQuery band_query{context, {&coverage, &reported, &pairs, &index, &former}};
};

TEST(BandQuery, PartnersToBeAnnouncedAreTrackedAndTheNextIsReturned) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex near = scene.AddMetAfter(1.5), far = scene.AddMetAfter(50),
                   next = scene.AddMetAfter(20);
  const NextNeighbour found = scene.band_query.Find(scene.QueryOf(agent));
  EXPECT_EQ(found.partner, next);
  ExpectNearlyAt(found.when, 20);
  ASSERT_TRUE(scene.AreTracked(agent, near));
  EXPECT_EQ(scene.pairs.table().size(), 1u);
  EXPECT_TRUE(scene.marks.Contains(near));
  EXPECT_FALSE(scene.marks.Contains(next) || scene.marks.Contains(far));
  ExpectNearlyAt(scene.PairOf(agent, near)->clear_until, 1.5);
  EXPECT_FALSE(scene.PairOf(agent, near)->tracker.began_before());
}

TEST(BandQuery, AnAgentThatMeetsNoPartnerHasNoNext) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(scene.band_query.Find(scene.QueryOf(agent)).when.is_never());
  scene.AddMetAfter(1);
  EXPECT_TRUE(scene.band_query.Find(scene.QueryOf(agent)).when.is_never());
  EXPECT_EQ(scene.pairs.table().size(), 1u);
}

// The first look reaches 2.5 s ahead.
TEST(BandQuery, APartnerThatIsMetJustAfterWhatIsAnnouncedIsTheNextAndNotTracked) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex next = scene.AddMetAfter(2.25);
  const NextNeighbour found = scene.band_query.Find(scene.QueryOf(agent));
  EXPECT_EQ(found.partner, next);
  ExpectNearlyAt(found.when, 2.25);
  EXPECT_FALSE(scene.AreTracked(agent, next));
}

// It is the same search whether answers lie near, as at first, or far, as later.
TEST(BandQuery, AnswersDoNotDependOnWhereEarlierOnesLay) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex next = scene.AddMetAfter(300);
  const Instant first = scene.band_query.Find(scene.QueryOf(agent)).when;
  for (int k = 0; k < 10; ++k) {
    const NextNeighbour found = scene.band_query.Find(scene.QueryOf(agent));
    EXPECT_EQ(found.when, first) << k;
    EXPECT_EQ(found.partner, next);
  }
}

TEST(BandQuery, PartnersOfAnotherBandAreNotQueried) {
  Scene scene;
  const motion::MotionLimits slow{.radius = 1, .acceleration_max = 1e-9},
      fast{.radius = 1, .acceleration_max = 1};
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0}, slow);
  const AgentIndex alike = scene.Add({3, 0, 0}, {-1, 0, 0}, slow);
  const AgentIndex harder = scene.Add({0, 3, 0}, {0, -1, 0}, fast);
  const int band = scene.coverage.tiers().BandOf(harder, agent);
  ClearanceQuery query = scene.QueryOf(agent);
  query.band = band;
  scene.band_query.Find(query);
  EXPECT_TRUE(scene.AreTracked(agent, harder));
  EXPECT_FALSE(scene.AreTracked(agent, alike));
  EXPECT_TRUE(scene.band_query.TracksAll(agent, band));
  query.band = AccelerationTiers::kComparable;
  scene.band_query.Find(query);
  EXPECT_TRUE(scene.AreTracked(agent, alike));
}

TEST(BandQuery, ATierIsTrackedAsAWholeOnlyWithEachOfItsAgents) {
  Scene scene;
  const motion::MotionLimits fast{.radius = 1, .acceleration_max = 1};
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0}, {.radius = 1, .acceleration_max = 1e-9});
  const AgentIndex near = scene.Add({3, 0, 0}, {0, 0, 0}, fast);
  const int band = scene.coverage.tiers().BandOf(near, agent);
  EXPECT_FALSE(scene.band_query.TracksAll(agent, band));
  ASSERT_TRUE(scene.pairs.Track(agent, near, At(0), Past::kKnown));
  EXPECT_TRUE(scene.band_query.TracksAll(agent, band));
  scene.Add({1e6, 0, 0}, {0, 0, 0}, fast);
  EXPECT_FALSE(scene.band_query.TracksAll(agent, band));
}

TEST(BandQuery, WithoutRoomForAPartnerTheAgentIsSaturatedWithIt) {
  Scene scene(1);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex first = scene.AddMetAfter(1.5), second = scene.AddMetAfter(0.5);
  scene.AddMetAfter(20);
  EXPECT_TRUE(scene.band_query.Find(scene.QueryOf(agent)).when.is_never());
  EXPECT_TRUE(scene.AreTracked(agent, first));
  EXPECT_FALSE(scene.AreTracked(agent, second));
  EXPECT_TRUE(scene.coverage.IsSaturated(agent));
  EXPECT_EQ(scene.coverage[agent].crowded_with, second);
  EXPECT_FALSE(scene.coverage.IsSaturated(second)) << "its own query finds that out";
}

TEST(BandQuery, WithRoomForExactlyItsPartnersTheAgentIsNotSaturated) {
  Scene scene(1);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  scene.AddMetAfter(1.5);
  const AgentIndex next = scene.AddMetAfter(20);
  EXPECT_EQ(scene.band_query.Find(scene.QueryOf(agent)).partner, next);
  EXPECT_FALSE(scene.coverage.IsSaturated(agent));
}

// Goal:   an agent that stays saturated costs one pair query, not one for each partner.
TEST(BandQuery, InACrowdThePartnerThatSaturatedTheAgentIsTestedFirst) {
  Scene scene(1);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  for (int k = 0; k < 50; ++k) scene.AddMetAfter(1);
  scene.band_query.Find(scene.QueryOf(agent));
  ASSERT_TRUE(scene.coverage.IsSaturated(agent));
  scene.coverage.EndSaturation(agent);
  ClearanceQuery query = scene.QueryOf(agent);
  query.was_saturated = true;
  const std::uint64_t searches = scene.index.work().searches, pairs = scene.counters.pair_queries;
  scene.band_query.Find(query);
  EXPECT_TRUE(scene.coverage.IsSaturated(agent));
  EXPECT_EQ(scene.counters.pair_queries, pairs + 1);
  EXPECT_EQ(scene.index.work().searches, searches);
}

TEST(BandQuery, AnAgentWithoutRoomIsNotSaturatedByAPartnerThatIsFarByNow) {
  Scene scene(1);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  scene.AddMetAfter(1);
  const AgentIndex second = scene.AddMetAfter(1.5);
  scene.band_query.Find(scene.QueryOf(agent));
  ASSERT_EQ(scene.coverage[agent].crowded_with, second);
  scene.coverage.EndSaturation(agent);
  scene.Store(second, 0, {0, 0, 52}, {0, 0, -1}, Link::kJumped);
  ClearanceQuery query = scene.QueryOf(agent);
  query.was_saturated = true;
  const NextNeighbour next = scene.band_query.Find(query);
  EXPECT_FALSE(scene.coverage.IsSaturated(agent));
  EXPECT_EQ(next.partner, second);
  ExpectNearlyAt(next.when, 50);
}

// They may have touched at any time since both were there.
TEST(BandQuery, AnOverlapAfterARenewalIsFreeOnlyUpToTheRenewal) {
  Scene scene;
  scene.clock.now = At(5);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex overlapping = scene.Add({1, 0, 0}, {0, 0.001, 0});
  scene.agents[overlapping].admitted_from = At(4);
  ClearanceQuery query = scene.QueryOf(agent);
  query.renewed = true;
  query.covered = query.from = At(3);
  scene.band_query.Find(query);
  const PairRecord* pair = scene.PairOf(agent, overlapping);
  ASSERT_NE(pair, nullptr);
  EXPECT_EQ(pair->clear_until, At(3)) << "the intersection is found from there on";
  EXPECT_TRUE(pair->tracker.began_before());
}

// Admitted with states ahead of now, they are queried for the second time at that instant.
TEST(BandQuery, AnOverlapFromTheAdmissionOnMayHaveBegunBefore) {
  for (const int admitted : {4, 5}) {
    Scene scene;
    scene.clock.now = At(5);
    const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
    const AgentIndex overlapping = scene.Add({1, 0, 0}, {0, 0.001, 0});
    scene.agents[overlapping].admitted_from = At(admitted);
    ClearanceQuery query = scene.QueryOf(agent);
    query.covered = query.from = At(5);
    scene.band_query.Find(query);
    const PairRecord* pair = scene.PairOf(agent, overlapping);
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(pair->tracker.began_before(), admitted == 5) << admitted;
  }
}

TEST(BandQuery, APartnerThatARenewedAgentIsTrackedWithLearnsTheCause) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex near = scene.AddMetAfter(1);
  scene.reported.TakeChanged();
  scene.coverage.Renew(agent, At(0), ClearanceCause::kTeleport);
  ClearanceQuery query = scene.QueryOf(agent);
  query.renewed = true;
  scene.band_query.Find(query);
  const std::vector<AgentClearance> changed = scene.reported.TakeChanged();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[1].agent, scene.agents[near].id);
  EXPECT_EQ(changed[1].cause, ClearanceCause::kTeleport);
  EXPECT_EQ(changed[1].cause_agent, scene.agents[agent].id);
}

// They met between 4.8 s and 5.2 s; the agent has reported up to 9 s but is covered up to 2 s.
TEST(BandQuery, APartnerThatWasMetBeforeTheNewestStatesIsTracked) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex passer = scene.Add({-50, 0, 0}, {10, 0, 0});
  for (const AgentIndex each : {agent, passer}) scene.SetKey(each, At(2));
  scene.Store(agent, 9, {0, 0, 0}, {0, 0, 0});
  scene.clock.now = At(9);
  ClearanceQuery query = scene.QueryOf(agent);
  query.covered = query.from = At(2);
  scene.band_query.Find(query);
  ASSERT_TRUE(scene.AreTracked(agent, passer));
  EXPECT_EQ(scene.PairOf(agent, passer)->clear_until, At(2));
}

TEST(BandQuery, WithoutRoomForAPartnerThatWasMetBothAreSaturated) {
  Scene scene(1);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex passer = scene.Add({-50, 0, 0}, {10, 0, 0});
  const AgentIndex other = scene.Add({0, 1000, 0}, {0, 0, 0});
  for (const AgentIndex each : {agent, passer, other}) scene.SetKey(each, At(2));
  ASSERT_TRUE(scene.pairs.Track(agent, other, At(0), Past::kKnown));
  scene.Store(agent, 9, {0, 0, 0}, {0, 0, 0});
  scene.clock.now = At(9);
  ClearanceQuery query = scene.QueryOf(agent);
  query.covered = query.from = At(2);
  scene.band_query.Find(query);
  EXPECT_TRUE(scene.coverage.IsSaturated(agent));
  EXPECT_TRUE(scene.coverage.IsSaturated(passer));
  EXPECT_FALSE(scene.coverage.IsSaturated(other));
}

}  // namespace
}  // namespace collision::detection
