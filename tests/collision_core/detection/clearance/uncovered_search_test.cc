// Goal:   a partner that an agent may have met before both newest states, where neither key covers
//         it, is found with the time up to which the two were free; one that it cannot have met is
//         not.
// Method: balls on lines without acceleration, with states that lie ahead of what is covered;
//         random lines beside the canonical routine for every pair.
#include "collision_core/detection/clearance/search/uncovered_search.h"

#include <gtest/gtest.h>

#include "collision_core/intersection/earliest_intersection.h"
#include "tests/collision_core/detection/clearance/clearance_scene.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

class UncoveredSearchTest : public testing::Test {
 protected:
  /// A unit ball at rest at the origin whose owner was granted time up to 9 s.
  AgentIndex AddAhead() {
    const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
    scene_.Store(agent, 9, {0, 0, 0}, {0, 0, 0});
    return agent;
  }
  /// A unit ball that passes the origin 1 m beside it: the two touch between 5 s -+ 0.1732 s.
  AgentIndex AddPasser() { return scene_.Add({-50, 1, 0}, {10, 0, 0}); }

  /// What is found if the agent is covered up to `covered`, as are its partners.
  std::vector<UncoveredPartner> Find(AgentIndex agent, double covered, bool renewed = false) {
    for (std::uint32_t k = 0; k < scene_.agents.index_end(); ++k) {
      scene_.coverage[AgentIndex(k)].keys.SetAll(At(covered));
    }
    return FindUnderOwnKeys(agent, covered, renewed);
  }
  std::vector<UncoveredPartner> FindUnderOwnKeys(AgentIndex agent, double covered, bool renewed) {
    ClearanceQuery query = scene_.QueryOf(agent);
    query.covered = At(covered);
    query.from = std::min(query.from, query.covered);
    query.renewed = renewed;
    return search_.Find(query);
  }

  ClearanceScene scene_;
  UncoveredSearch search_{scene_.context, scene_.coverage, &scene_.index, &scene_.former};
};

TEST_F(UncoveredSearchTest, APartnerThatPassedSinceTheKeyIsFoundFreeUpToTheKey) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  const std::vector<UncoveredPartner> found = Find(agent, 2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].partner, passer);
  EXPECT_EQ(found[0].free_until, At(2));
}

TEST_F(UncoveredSearchTest, APartnerThatPassedBeforeTheKeyIsNot) {
  const AgentIndex agent = AddAhead();
  AddPasser();
  EXPECT_TRUE(Find(agent, 5.2).empty());
  EXPECT_EQ(Find(agent, 5.1).size(), 1u) << "they touch until 5.173 s";
}

TEST_F(UncoveredSearchTest, APartnerThatPassesAfterBothNewestStatesIsNot) {
  const AgentIndex agent = scene_.Add({0, 0, 0}, {0, 0, 0});
  AddPasser();
  scene_.Store(agent, 4.7, {0, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(Find(agent, 2).empty());
  scene_.Store(agent, 4.9, {0, 0, 0}, {0, 0, 0});
  EXPECT_EQ(Find(agent, 2).size(), 1u);
}

TEST_F(UncoveredSearchTest, APartnerThatPassedAtADistanceIsNot) {
  const AgentIndex agent = AddAhead();
  scene_.Add({-50, 2.01, 0}, {10, 0, 0});
  EXPECT_TRUE(Find(agent, 2).empty());
}

TEST_F(UncoveredSearchTest, ThePartnersOwnLaterKeyCoversThePair) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  for (const AgentIndex each : {agent, passer}) scene_.coverage[each].keys.SetAll(At(2));
  scene_.coverage[passer].keys.SetAll(At(9));
  EXPECT_TRUE(FindUnderOwnKeys(agent, 2, false).empty());
  EXPECT_EQ(FindUnderOwnKeys(agent, 2, true).size(), 1u) << "not if the agent was renewed";
  scene_.coverage[passer].keys.SetAll(At(3));
  const std::vector<UncoveredPartner> found = FindUnderOwnKeys(agent, 2, false);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].free_until, At(3));
}

TEST_F(UncoveredSearchTest, TheKeyOfASaturatedPartnerCoversNothing) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  for (const AgentIndex each : {agent, passer}) scene_.coverage[each].keys.SetAll(At(2));
  scene_.coverage.Saturate(passer, agent);
  scene_.coverage[passer].keys.SetAll(At(9));
  EXPECT_EQ(FindUnderOwnKeys(agent, 2, false).size(), 1u);
}

TEST_F(UncoveredSearchTest, AStateWithinItsKeyIsCovered) {
  const AgentIndex agent = AddAhead();
  AddPasser();
  EXPECT_TRUE(Find(agent, 9).empty());
}

TEST_F(UncoveredSearchTest, PartnersThatAreLeftOutOrCannotMeetAreNotFound) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  scene_.agents[passer].declaration.filter.mask = 0;
  EXPECT_TRUE(Find(agent, 2).empty());
  scene_.agents[passer].declaration.filter.mask = ~0u;
  ASSERT_EQ(Find(agent, 2).size(), 1u);
  scene_.agents.SetExpired(passer);
  EXPECT_TRUE(Find(agent, 2).empty());
  scene_.agents[passer].expired = false;
  ASSERT_TRUE(scene_.pairs.Track(agent, passer, At(0), Past::kKnown));
  EXPECT_TRUE(Find(agent, 2).empty());
}

// Its motion before the jump is held beside the newest bounds.
TEST_F(UncoveredSearchTest, APartnerThatHasJumpedAwaySinceItPassedIsFound) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  const broad_phase::AgentBound before(scene_.agents[passer].bound());
  scene_.Store(passer, 8, {1e5, 0, 0}, {0, 0, 1}, Link::kJumped);
  EXPECT_TRUE(Find(agent, 2).empty()) << "the test relies on the former motion";
  scene_.former.Record(passer, before, At(8));
  const std::vector<UncoveredPartner> found = Find(agent, 2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].partner, passer);
}

// Nothing is known of the time between an honest state and a breach.
TEST_F(UncoveredSearchTest, AfterABreachAPartnerWithinReachIsFoundThoughItsLinePassesBy) {
  const AgentIndex agent = AddAhead();
  const AgentIndex near = scene_.Add({-50, 20, 0}, {10, 0, 0});
  EXPECT_TRUE(Find(agent, 2).empty());
  scene_.Store(near, 5, {0, 20, 0}, {10, 0, 0}, Link::kBroken);
  EXPECT_EQ(Find(agent, 2).size(), 1u);
}

TEST_F(UncoveredSearchTest, BeforeBothWereAdmittedNothingIsUncovered) {
  const AgentIndex agent = AddAhead(), passer = AddPasser();
  const auto from = [&] {
    return UncoveredFrom(scene_.agents[agent], scene_.agents[passer], At(2));
  };
  EXPECT_EQ(from(), At(2));
  scene_.agents[passer].admitted_from = At(3);
  EXPECT_EQ(from(), At(3));
  scene_.agents[agent].admitted_from = At(4);
  EXPECT_EQ(from(), At(4));
  const std::vector<UncoveredPartner> found = Find(agent, 2, true);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].free_until, At(4));
}

// Goal:   of many partners exactly those are found that meet the agent while it is not covered.
// Method: lines without acceleration: each is certain, so a search that looks only at some of the
//         partners finds the same as a look at all.
TEST_F(UncoveredSearchTest, OfManyLinesExactlyThoseThatPassedAreFoundInOrder) {
  Random random(23);
  const AgentIndex agent = scene_.Add({0, 0, 0}, {1, 0, 0});
  for (int k = 0; k < 400; ++k) {
    const Vector3d v = random.UnitVector() * random.LogUniform(0.1, 30);
    const Vector3d meeting = Vector3d(5, 0, 0) + random.UnitVector() * random.Uniform(0, 60);
    scene_.Add(meeting - v * random.Uniform(0, 12), v, {.radius = random.Uniform(0.5, 4)});
  }
  const motion::SpaceTimeBound bound = scene_.agents[agent].bound();
  scene_.Store(agent, 9, {9, 0, 0}, {1, 0, 0});
  std::vector<std::uint32_t> expected, partners;
  for (std::uint32_t k = 1; k < scene_.agents.index_end(); ++k) {
    const motion::SpaceTimeBound& partner = scene_.agents[AgentIndex(k)].bound();
    if (intersection::EarliestIntersection(bound, partner, At(2)).instant() < At(9)) {
      expected.push_back(k);
    }
  }
  for (const UncoveredPartner& found : Find(agent, 2)) {
    partners.push_back(found.partner.value());
    EXPECT_EQ(found.free_until, At(2));
  }
  EXPECT_EQ(partners, expected);
  EXPECT_GT(expected.size(), 20u);
  EXPECT_LT(expected.size(), 300u);
}

}  // namespace
}  // namespace collision::detection
