// Goal:   the next intersection is the earliest of all partners that are not left out, however far
//         ahead and with however many of them; most pairs are spared the canonical routine.
// Method: unit balls on a line without acceleration, which meet at exact times; random swarms
//         beside the canonical routine for every pair.
#include "collision_core/detection/clearance/search/next_neighbour_search.h"

#include <gtest/gtest.h>

#include "collision_core/intersection/earliest_intersection.h"
#include "tests/collision_core/detection/clearance/clearance_scene.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

class NextNeighbourSearchTest : public testing::Test {
 protected:
  NextNeighbour Find(AgentIndex agent) {
    return search_.Find(scene_.QueryOf(agent), scene_.clock.now);
  }

  ClearanceScene scene_;
  NextNeighbourSearch search_{&scene_.index, scene_.coverage.tiers(), scene_.clock};
};

TEST_F(NextNeighbourSearchTest, TheEarliestOfSeveralPartnersIsFound) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  scene_.Add({-102, 0, 0}, {1, 0, 0});
  const AgentIndex next = scene_.Add({32, 0, 0}, {-1, 0, 0});
  scene_.Add({0, 52, 0}, {0, -1, 0});
  const NextNeighbour found = Find(agent);
  EXPECT_EQ(found.partner, next);
  ExpectNearlyAt(found.when, 30);
}

// The last horizon with a limit lies less than 500 s ahead.
TEST_F(NextNeighbourSearchTest, APartnerBeyondAllHorizonsIsFound) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex far = scene_.Add({1e6 + 2, 0, 0}, {-1, 0, 0});
  const NextNeighbour found = Find(agent);
  EXPECT_EQ(found.partner, far);
  EXPECT_LE(found.when, At(1e6));
  EXPECT_GT(found.when, At(1e6 - 0.01));
}

TEST_F(NextNeighbourSearchTest, AnAgentThatMeetsNoPartnerIsToldSo) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(Find(agent).when.is_never());
  scene_.Add({10, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(Find(agent).when.is_never());
}

TEST_F(NextNeighbourSearchTest, TrackedPartnersAreLeftOut) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex tracked = scene_.Add({12, 0, 0}, {-1, 0, 0});
  const AgentIndex next = scene_.Add({52, 0, 0}, {-1, 0, 0});
  ASSERT_TRUE(scene_.pairs.Track(agent, tracked, At(0), Past::kKnown));
  const NextNeighbour found = Find(agent);
  EXPECT_EQ(found.partner, next);
  ExpectNearlyAt(found.when, 50);
}

TEST_F(NextNeighbourSearchTest, PartnersOfAnotherBandAreLeftOut) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0}, {.radius = 1, .acceleration_max = 1});
  const AgentIndex alike = scene_.Add({502, 0, 0}, {0, 0, 0}, {.radius = 1, .acceleration_max = 1});
  const AgentIndex harder =
      scene_.Add({0, 502, 0}, {0, 0, 0}, {.radius = 1, .acceleration_max = 100});
  const int band = scene_.coverage.tiers().BandOf(harder, agent);
  ASSERT_NE(band, AccelerationTiers::kComparable);
  ClearanceQuery query = scene_.QueryOf(agent);
  query.band = band;
  EXPECT_EQ(search_.Find(query, At(0)).partner, harder);
  query.band = AccelerationTiers::kComparable;
  EXPECT_EQ(search_.Find(query, At(0)).partner, alike);
  query.band = kEveryBand;
  EXPECT_EQ(search_.Find(query, At(0)).partner, harder);
}

TEST_F(NextNeighbourSearchTest, ASearchBeginsWhereAnswersOfItsKindLie) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  scene_.Add({1002, 0, 0}, {-1, 0, 0});
  const ClearanceQuery query = scene_.QueryOf(agent);
  const int begin = search_.Begin(query);
  search_.Find(query, At(0));
  EXPECT_EQ(search_.Begin(query), begin + 1);
  search_.Record(query, Instant::Never());
  EXPECT_EQ(search_.Begin(query), begin + 2);
  search_.Record(query, At(0));
  EXPECT_EQ(search_.Begin(query), begin + 1);
}

// Goal:   where more partners than a sample are offered, the answer is the canonical one of all.
// Method: swarms that come from all sides, so that many are met within one horizon.
TEST_F(NextNeighbourSearchTest, OfASwarmTheCanonicalEarliestIsFoundWithFewPairQueries) {
  Random random(41);
  constexpr int kSwarm = 600;
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0}, {.radius = 1, .acceleration_max = 0.1});
  for (int k = 0; k < kSwarm; ++k) {
    scene_.Add(random.UnitVector() * random.Uniform(590, 600), random.UnitVector(),
               {.radius = 1, .acceleration_max = 0.1});
  }
  NextNeighbour earliest;
  for (std::uint32_t k = 1; k <= kSwarm; ++k) {
    const Instant when =
        intersection::EarliestIntersection(scene_.agents[agent].bound(),
                                           scene_.agents[AgentIndex(k)].bound(), At(0))
            .instant();
    if (when < earliest.when) earliest = {when, AgentIndex(k)};
  }
  const std::uint64_t before = scene_.index.work().pair_queries;
  const NextNeighbour found = Find(agent);
  EXPECT_EQ(found.when, earliest.when);
  EXPECT_EQ(found.partner, earliest.partner);
  EXPECT_GT(search_.examined(), 64u) << "more than what is queried at once";
  EXPECT_LT(scene_.index.work().pair_queries - before, kSwarm / 4);
}

TEST_F(NextNeighbourSearchTest, TheEarliestOfGivenNeighboursIsTheFirstThatIsNotTracked) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  for (int k = 0; k < 4; ++k) scene_.Add({100.0 * k, 0, 0}, {0, 0, 0});
  const auto neighbour = [](std::uint32_t partner, double seconds) {
    return broad_phase::Neighbour{partner, {At(0), seconds}};
  };
  PartnerMarks& tracked = *scene_.QueryOf(agent).tracked;
  tracked.Add(AgentIndex(1u));
  const NextNeighbour next = NextNeighbourSearch::EarliestOf(
      {neighbour(1, 3), neighbour(2, 9), neighbour(3, 5), neighbour(4, 5)}, tracked);
  EXPECT_EQ(next.partner, AgentIndex(3u));
  EXPECT_EQ(next.when, At(5));
  EXPECT_TRUE(NextNeighbourSearch::EarliestOf({neighbour(1, 3)}, tracked).when.is_never());
}

}  // namespace
}  // namespace collision::detection
