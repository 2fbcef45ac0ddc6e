// Goal:   the earliest possible intersection of all is that of the canonical routine over all pairs
//         that are not in contact, or the other time that the header names; few pairs are queried.
// Method: unit balls without acceleration that come at 1 m/s, so that one at distance 2 + t is met
//         after t; the test plays the façade. Random scenes beside the canonical routine for every
//         pair.
#include "collision_core/detection/earliest/earliest_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

class Scene {
 public:
  explicit Scene(std::uint32_t pairs_per_agent_max = 256)
      : options_{.announce_within = 2, .pairs_per_agent_max = pairs_per_agent_max} {}

  AgentIndex Add(const Vector3d& p, const Vector3d& v,
                 const AgentDeclaration& declaration = {.limits = {.radius = 1}}) {
    const auto slot = static_cast<std::uint32_t>(agents.index_end());
    const AgentIndex agent = agents.Admit(Id(slot), declaration, At(0));
    pairs.AddAgent(agent);
    clearances.AddAgent(agent);
    agents.Store(agent, State(0, p, v), Link::kJumped);
    Renew(agent, ClearanceCause::kAdmission);
    return agent;
  }
  void Renew(AgentIndex agent, ClearanceCause cause) {
    agents[agent].margin = BoundMargin(agents[agent].bound());
    agents.RecordBound(agent);
    clearances.Renew(agent, {agents[agent].stamp(), cause, At(0)});
  }

  /// All owners have reported everything up to `now`.
  void Step(double now) {
    for (std::uint32_t k = 0; k < agents.index_end(); ++k) {
      agents.SetHeardUntil(OwnerOf(Id(k)), At(now));
    }
    clock.now = At(now);
    ++clock.step;
    pairs.StartStep();
    clearances.QueryDueAgents();
    pairs.EvaluateDuePairs();
    clearances.Cover(pairs.TakeReleased());
    agents.EndStep([](AgentIndex) { return Instant::Always(); });
  }

  EarliestAnswer Find(std::size_t queries_max = std::numeric_limits<std::size_t>::max()) {
    const EarliestAnswer answer = search.Find(queries_max);
    search.Validate();
    return answer;
  }

  Instant CanonicalOf(AgentIndex a, AgentIndex b) const {
    return intersection::EarliestIntersection(agents[a].bound(), agents[b].bound(), clock.now)
        .instant();
  }

 private:
  const DetectorOptions options_;

 public:
  StepClock clock{.now = At(0), .announce_within = 2};
  AgentTable agents{{}};
  DetectorCounters counters;
  IndexSet<AgentIndex> dirty;
  const DetectorContext context{clock, agents, &counters, &dirty};
  TrackedPairs pairs{options_, context};
  Clearances clearances{options_, context, &pairs};
  EarliestSearch search{context, &pairs, &clearances};
};

void ExpectIs(const EarliestAnswer& answer, double seconds, std::uint32_t a, std::uint32_t b) {
  ASSERT_TRUE(answer.found);
  EXPECT_LE(answer.earliest, At(seconds));
  EXPECT_GE(answer.earliest, At(seconds - 1e-6));
  EXPECT_EQ(answer.lower, Id(a));
  EXPECT_EQ(answer.higher, Id(b));
}

TEST(EarliestSearch, NothingIsFoundWhereNoTwoMeet) {
  Scene scene;
  scene.Step(0);
  EXPECT_FALSE(scene.Find().found);
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({10, 0, 0}, {1, 0, 0});
  scene.Step(1);
  const EarliestAnswer answer = scene.Find();
  EXPECT_FALSE(answer.found);
  EXPECT_TRUE(answer.earliest.is_never());
}

TEST(EarliestSearch, OfUntrackedPairsTheEarliestIsFound) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({32, 0, 0}, {-1, 0, 0});
  scene.Add({0, 22, 0}, {0, -1, 0});
  scene.Add({0, 0, 42}, {0, 0, -1});
  scene.Step(0);
  ASSERT_EQ(scene.pairs.table().size(), 0u);
  const EarliestAnswer answer = scene.Find();
  ExpectIs(answer, 20, 0, 2);
  EXPECT_EQ(answer.earliest, scene.CanonicalOf(AgentIndex(0u), AgentIndex(2u)));
}

TEST(EarliestSearch, ATrackedPairCountsAsAnyOther) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({32, 0, 0}, {-1, 0, 0});
  scene.Add({0, 3.5, 0}, {0, -1, 0});
  scene.Step(0);
  ASSERT_EQ(scene.pairs.table().size(), 1u);
  const EarliestAnswer answer = scene.Find();
  ExpectIs(answer, 1.5, 0, 2);
  EXPECT_EQ(answer.earliest, scene.CanonicalOf(AgentIndex(0u), AgentIndex(2u)));
}

TEST(EarliestSearch, OfEqualOnesThatOfTheLowestIdsIsFound) {
  Scene scene;
  for (const double y : {0.0, 100.0}) {
    scene.Add({0, y, 0}, {0, 0, 0});
    for (const double side : {1.0, -1.0}) scene.Add({side * 18, y, 0}, {-side, 0, 0});
  }
  scene.Step(0);
  ASSERT_EQ(scene.CanonicalOf(AgentIndex(3u), AgentIndex(5u)),
            scene.CanonicalOf(AgentIndex(0u), AgentIndex(1u)));
  ExpectIs(scene.Find(), 16, 0, 1);
}

TEST(EarliestSearch, APairInContactDoesNotCountUntilItIsFreeAgain) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({1, 0, 0}, {1, 0, 0});
  scene.Add({0, 32, 0}, {0, -1, 0});
  for (const double now : {0.25, 0.5}) scene.Step(now);
  ASSERT_TRUE(scene.pairs.table()[scene.pairs.table().Of(AgentIndex(1u)).at(0)].in_contact);
  ExpectIs(scene.Find(), 30, 0, 2);
}

// There is room for one of two pairs.
TEST(EarliestSearch, ASaturatedAgentCountsWithNowAndThePartnerThatWasNotTracked) {
  Scene scene(1);
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({3.5, 0, 0}, {-1, 0, 0});
  const AgentIndex second = scene.Add({0, 3.75, 0}, {0, -1, 0});
  scene.Step(0.125);
  ASSERT_FALSE(scene.clearances.coverage().saturated().empty());
  ExpectIs(scene.Find(), 0.125, 0, 2);

  scene.agents.Remove(second);
  scene.agents.SetExpired(second);
  scene.clearances.Remove(second);
  scene.clearances.Forget(second);
  scene.agents.Release(second);
  ExpectIs(scene.Find(), 0.125, 0, 0);
}

TEST(EarliestSearch, AnExpiredAgentDoesNotCount) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  scene.Add({32, 0, 0}, {-1, 0, 0});
  const AgentIndex expired = scene.Add({0, 22, 0}, {0, -1, 0});
  scene.Step(0);
  ExpectIs(scene.Find(), 20, 0, 2);
  scene.agents.SetExpired(expired);
  scene.clearances.Remove(expired);
  ExpectIs(scene.Find(), 30, 0, 1);
}

// One owner was granted time up to 9 s. The two are certified free up to 1 s.
TEST(EarliestSearch, APairWithAStateAheadCountsWithTheEndOfItsFreedom) {
  Scene scene;
  const AgentIndex a = scene.Add({0, 0, 0}, {0, 0, 0}), b = scene.Add({22, 0, 0}, {-1, 0, 0});
  scene.Step(0);
  scene.agents.Store(a, State(9, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  ASSERT_TRUE(scene.pairs.Track(a, b, At(1), Past::kKnown));
  ExpectIs(scene.Find(), 1, 0, 1);
}

// Both have reported up to 5.25 s that they touched from 4.8 s to 5.2 s: a contact ahead of now.
// Then one jumped, so that they meet again at 5.375 s and stay tracked.
TEST(EarliestSearch, AContactAheadOfNowCountsWithItsBegin) {
  Scene scene;
  const AgentIndex a = scene.Add({0, 0, 0}, {0, 0, 0}), b = scene.Add({50, 0, 0}, {-10, 0, 0});
  scene.agents.Store(a, State(5.25, {0, 0, 0}, {0, 0, 0}), Link::kFollows);
  scene.agents.Store(b, State(5.25, {-2.5, 0, 0}, {-10, 0, 0}), Link::kFollows);
  scene.agents.Store(b, State(5.25, {2.125, 0, 0}, {-1, 0, 0}), Link::kJumped);
  for (const AgentIndex agent : {a, b}) scene.Renew(agent, ClearanceCause::kTeleport);
  scene.Step(3);
  ASSERT_EQ(scene.pairs.table().size(), 1u);
  EarliestAnswer answer = scene.Find();
  ASSERT_TRUE(answer.found);
  EXPECT_LE(answer.earliest, At(4.8));
  EXPECT_GE(answer.earliest, At(4.79));
  scene.Step(5);
  EXPECT_EQ(scene.Find().earliest, At(5)) << "not before now";
  scene.Step(5.25);
  ExpectIs(scene.Find(), 5.375, 0, 1);
}

// Their balls overlap, but of the cubes the faces meet after 1.5 s.
TEST(EarliestSearch, APairOfKnownShapesCountsWithItsCertifiedFreedom) {
  AgentDeclaration cube;
  cube.limits = {.radius = 10, .angular_acceleration_max = 0};
  cube.shape = shape::Shape::Build(Cube(1));
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0}, cube);
  scene.Add({3.5, 0, 0}, {-1, 0, 0}, cube);
  scene.Step(0);
  ASSERT_EQ(scene.CanonicalOf(AgentIndex(0u), AgentIndex(1u)), At(0));
  const EarliestAnswer answer = scene.Find();
  ASSERT_TRUE(answer.found);
  EXPECT_LE(answer.earliest, At(1.5));
  EXPECT_GT(answer.earliest, At(1.4));
}

TEST(EarliestSearch, AJumpSinceTheLastStepCountsAtOnce) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex b = scene.Add({0, 500, 0}, {0, 0, 1});
  scene.Step(0);
  EXPECT_FALSE(scene.Find().found);
  scene.agents.Store(b, State(0, {7, 0, 0}, {-1, 0, 0}), Link::kJumped);
  scene.Renew(b, ClearanceCause::kTeleport);
  ExpectIs(scene.Find(), 5, 0, 1);
  EXPECT_TRUE(scene.clearances.coverage()[b].renewed_from.has_value()) << "the step is to come";
}

// It passes the other 1.75 m beside it, about 5 s from now. Its state lies beyond its key, and the
// next step is to find that the two touched.
TEST(EarliestSearch, AStateBeyondItsKeyCountsWithTheKeyAtOnce) {
  Scene scene;
  scene.Add({0, 0, 0}, {0, 0, 0});
  const AgentIndex b = scene.Add({-50, 1.75, 0}, {10, 0, 0});
  scene.Step(0);
  const double touch = 5 - std::sqrt(4 - 1.75 * 1.75) / 10;
  ExpectIs(scene.Find(), touch, 0, 1);
  scene.agents.Store(b, State(9, {40, 1.75, 0}, {10, 0, 0}), Link::kFollows);
  scene.agents.RecordBound(b);
  scene.clearances.Tighten(b);
  scene.clearances.StateAdvanced(b);
  ExpectIs(scene.Find(), touch, 0, 1);
}

// Goal:   the answer is the canonical one at each time, and comes from bounds that mostly still
//         hold.
// Method: no new states: what is known of the agents grows older.
TEST(EarliestSearch, AsTimePassesTheAnswerIsThatOfAllPairsFromFewQueries) {
  Random random(29);
  constexpr std::uint32_t kAgents = 40;
  constexpr int kSteps = 30;
  Scene scene;
  for (std::uint32_t k = 0; k < kAgents; ++k) {
    const Vector3d p(random.Uniform(0, 1000), random.Uniform(0, 1000), random.Uniform(0, 1000));
    scene.Add(p, random.UnitVector() * random.Uniform(0, 3),
              {.limits = {.radius = 1, .acceleration_max = random.LogUniform(1e-3, 1e-1)}});
  }
  std::uint64_t spent = 0;
  for (int step = 0; step < kSteps; ++step) {
    scene.Step(step / 16.0);
    ASSERT_EQ(scene.pairs.table().size(), 0u);
    EarliestAnswer expected;
    for (std::uint32_t a = 0; a < kAgents; ++a) {
      for (std::uint32_t b = a + 1; b < kAgents; ++b) {
        const Instant when = scene.CanonicalOf(AgentIndex(a), AgentIndex(b));
        if (when < expected.earliest) expected = {true, when, Id(a), Id(b)};
      }
    }
    const std::uint64_t before = scene.counters.queries;
    const EarliestAnswer answer = scene.Find();
    ASSERT_EQ(answer.earliest, expected.earliest) << step;
    ASSERT_EQ(answer.lower, expected.lower);
    ASSERT_EQ(answer.higher, expected.higher);
    spent += scene.counters.queries - before;
  }
  EXPECT_LT(spent, kSteps * 4u) << "queries of the search's own";
}

}  // namespace
}  // namespace collision::detection
