// Goal:   the partners that must be tracked now are found, as far as there is room: those with the
//         lowest indices, without the ones that are full; the first without room is named.
// Method: unit balls without acceleration that come at 1 m/s, so that one at distance 2 + t is met
//         after t; random scenes beside a model, with methods that offer partners in other orders.
#include "collision_core/detection/clearance/search/due_neighbour_search.h"

#include <gtest/gtest.h>

#include <utility>

#include "collision_core/intersection/earliest_intersection.h"
#include "tests/collision_core/detection/clearance/clearance_scene.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

class Scene : public ClearanceScene {
 public:
  using ClearanceScene::ClearanceScene;

  /// A partner that agent 0, at the origin, meets after `seconds`, from a direction of its own.
  AgentIndex AddMetAfter(double seconds) {
    const double turn = static_cast<double>(agents.size());
    const Vector3d n(std::cos(turn), std::sin(turn), 0);
    return Add(n * (2 + seconds), -n);
  }

  /// Fills the agent with pairs that nothing else is in.
  void Fill(AgentIndex agent) {
    while (!pairs.table().IsFull(agent)) {
      ASSERT_TRUE(pairs.Track(agent, Add({1e6, 1e6, 0}, {0, 0, 1}), At(0), Past::kKnown));
    }
  }

  AgentIndex Find(AgentIndex agent, double horizon = 100) {
    found_.clear();
    return search_.Find(QueryOf(agent), At(horizon), &found_);
  }

  std::vector<std::uint32_t> FoundPartners() const {
    std::vector<std::uint32_t> partners;
    for (const broad_phase::Neighbour& neighbour : found_) partners.push_back(neighbour.partner);
    return partners;
  }

  std::vector<broad_phase::Neighbour> found_;
  DueNeighbourSearch search_{&index, coverage.tiers(), pairs.table(), clock};
};

using Partners = std::vector<std::uint32_t>;

TEST(DueNeighbourSearch, AllThatAreMetWhileTheyAreAnnouncedAndTheNextAreFound) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  for (const double t : {1.999, 7.0, 0.5, 5.0, 2.001}) scene.AddMetAfter(t);
  EXPECT_TRUE(scene.Find(agent).is_none());
  EXPECT_EQ(scene.FoundPartners(), (Partners{1, 3, 5})) << "5 is the earliest of the others";
  ExpectNearlyAt(scene.found_[0].time.instant(), 1.999);
  ExpectNearlyAt(scene.found_[2].time.instant(), 2.001);
}

TEST(DueNeighbourSearch, NoPartnerBeyondTheHorizonIsFound) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  scene.AddMetAfter(7);
  EXPECT_TRUE(scene.Find(agent, 6.9).is_none());
  EXPECT_TRUE(scene.found_.empty());
  scene.Find(agent, 7.1);
  EXPECT_EQ(scene.FoundPartners(), Partners{1});
}

TEST(DueNeighbourSearch, TrackedPartnersAreLeftOut) {
  Scene scene;
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex tracked = scene.AddMetAfter(1);
  scene.AddMetAfter(1.5);
  ASSERT_TRUE(scene.pairs.Track(agent, tracked, At(0), Past::kKnown));
  EXPECT_TRUE(scene.Find(agent).is_none());
  EXPECT_EQ(scene.FoundPartners(), Partners{2});
}

TEST(DueNeighbourSearch, WithoutRoomForAllThoseWithTheLowestIndicesAreTaken) {
  Scene scene(2);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  for (const double t : {1.5, 1.0, 0.5, 0.2}) scene.AddMetAfter(t);
  EXPECT_EQ(scene.Find(agent), AgentIndex(3u));
  EXPECT_EQ(scene.FoundPartners(), (Partners{1, 2}));
}

TEST(DueNeighbourSearch, AsManyAsFitDoNotSaturate) {
  Scene scene(2);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  for (const double t : {1.5, 1.0, 5.0}) scene.AddMetAfter(t);
  EXPECT_TRUE(scene.Find(agent).is_none());
  EXPECT_EQ(scene.FoundPartners(), (Partners{1, 2, 3}));
}

TEST(DueNeighbourSearch, AFullPartnerIsNamedAndLeftOutIfItMustBeTracked) {
  Scene scene(2);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  scene.AddMetAfter(1);
  const AgentIndex full = scene.AddMetAfter(1.5);
  scene.AddMetAfter(0.5);
  scene.Fill(full);
  EXPECT_EQ(scene.Find(agent), full);
  EXPECT_EQ(scene.FoundPartners(), (Partners{1, 3})) << "there is room for both others";
}

TEST(DueNeighbourSearch, AFullPartnerThatIsMetLaterCountsAsAnyOther) {
  Scene scene(2);
  const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex full = scene.AddMetAfter(5);
  scene.Fill(full);
  EXPECT_TRUE(scene.Find(agent).is_none());
  EXPECT_EQ(scene.FoundPartners(), Partners{full.value()});
}

/// What is promised of a search, from one pair query for each partner.
AgentIndex ModelOf(const Scene& scene, AgentIndex agent, Partners* taken) {
  const PairTable& pairs = scene.pairs.table();
  AgentIndex no_room = AgentIndex::None();
  for (std::uint32_t k = 0; k < scene.agents.index_end(); ++k) {
    const AgentIndex partner(k);
    const Instant when = intersection::EarliestIntersection(scene.agents[agent].bound(),
                                                            scene.agents[partner].bound(), At(0))
                             .instant();
    if (partner == agent || when > scene.clock.announce_until()) continue;
    if (pairs.IsFull(partner)) {
      no_room = std::min(no_room, partner);
    } else if (taken->size() < pairs.RoomFor(agent)) {
      taken->push_back(k);
    } else {
      no_room = std::min(no_room, partner);
    }
  }
  return no_room;
}

TEST(DueNeighbourSearch, TheResultIsTheModelsWhateverTheOrderOfOffers) {
  for (const auto method :
       {broad_phase::BroadPhaseMethod::kAllPairs, broad_phase::BroadPhaseMethod::kSpatialIndex,
        broad_phase::BroadPhaseMethod::kExhaustive}) {
    Random random(17);
    int saturated = 0, clear = 0;
    for (std::uint32_t room = 1; room < 40; ++room) {
      Scene scene(room, method);
      const AgentIndex agent = scene.Add({0, 0, 0}, {0, 0, 0});
      std::vector<AgentIndex> partners;
      for (int k = 0; k < 40; ++k) partners.push_back(scene.AddMetAfter(random.Uniform(0, 6)));
      for (int k = 0; k < 3; ++k) scene.Fill(partners[random.Below(40)]);
      Partners expected;
      const AgentIndex no_room = ModelOf(scene, agent, &expected);
      ASSERT_EQ(scene.Find(agent, 2), no_room) << room;
      ASSERT_EQ(scene.FoundPartners(), expected) << room;
      ++(no_room.is_none() ? clear : saturated);
    }
    EXPECT_GT(saturated, 5);
    EXPECT_GT(clear, 1);
  }
}

}  // namespace
}  // namespace collision::detection
