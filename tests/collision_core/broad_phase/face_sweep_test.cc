#include "collision_core/broad_phase/face_sweep/face_sweep.h"

#include <gtest/gtest.h>

#include "tests/collision_core/broad_phase/face_sweep_scenes.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = kSanitized ? 40 : 250;

/// The same pair, at the same time, bit for bit.
void ExpectSame(const std::optional<intersection::IntersectingPair>& expected,
                const std::optional<intersection::IntersectingPair>& answer) {
  ASSERT_EQ(expected.has_value(), answer.has_value());
  if (!expected) return;
  EXPECT_EQ(expected->lower, answer->lower);
  EXPECT_EQ(expected->higher, answer->higher);
  EXPECT_EQ(expected->time.base, answer->time.base);
  EXPECT_EQ(expected->time.seconds, answer->time.seconds);
}

class EveryLayout : public testing::TestWithParam<std::tuple<int, intersection::BoundKind>> {};

// Goal:   the sweep answers as a plain loop over all pairs does, bit for bit, in every kind of
//         scene, for both bounds; and it finds answers at all, and scenes without one.
// Method: 250 seeded scenes each of 2 to 60 agents, now and then 300.
TEST_P(EveryLayout, AnswersAsThePlainLoopDoes) {
  const auto [layout, kind] = GetParam();
  Random random(100 + layout);
  int with_answer = 0, at_start = 0;
  for (int i = 0; i < kScenes; ++i) {
    const int count = static_cast<int>(i % 100 == 99 ? 300 : 2 + random.Below(59));
    const SweepScene scene = RandomScene(static_cast<SweepLayout>(layout), kind, count, &random);
    const auto filled = Filled(scene);
    FaceSweep& sweep = *filled;
    const std::optional<intersection::IntersectingPair> expected = PlainEarliest(scene);
    with_answer += expected.has_value();
    at_start += expected && expected->time.instant() == scene.query.from;
    ExpectSame(expected, sweep.Earliest(scene.query));
    EXPECT_LE(sweep.queued_max(), 2u * scene.agents.size());
    if (testing::Test::HasFailure()) FAIL() << "scene " << i << " of " << count;
  }
  RecordProperty("with_answer", with_answer);
  RecordProperty("at_start", at_start);
  EXPECT_GT(with_answer, kScenes / 8);
  EXPECT_LT(at_start, kScenes / 2);
}

INSTANTIATE_TEST_SUITE_P(
    FaceSweep, EveryLayout,
    testing::Combine(testing::Range(0, kLayouts),
                     testing::Values(intersection::BoundKind::kHorn,
                                     intersection::BoundKind::kHypertrapezoid)));

// Goal:   of two meetings within the same nanosecond that of the lower indices counts, though it
//         comes later.
// Method: two pairs at 10 m/s, 0.1 ns and 0.7 ns after the same microsecond, in a window so short
//         that a tick is far below a nanosecond; both orders.
TEST(FaceSweep, TiesAreBrokenByIndexNotByCrossing) {
  for (const bool is_later_lower : {false, true}) {
    for (const intersection::BoundKind kind :
         {intersection::BoundKind::kHorn, intersection::BoundKind::kHypertrapezoid}) {
      SweepScene scene;
      scene.query = {kind, At(0), At(3000)};
      for (const bool is_first : {true, false}) {
        const double gap = 10 * (is_first != is_later_lower ? 1.0001e-6 : 1.0007e-6);
        const double y = is_first ? 0 : 5;
        scene.agents.push_back(Agent({0, y, 0}, {10, 0, 0}, 0.0625));
        scene.agents.push_back(Agent({0.125 + gap, y, 0}, {0, 0, 0}, 0.0625));
      }
      const std::optional<intersection::IntersectingPair> expected = PlainEarliest(scene);
      EXPECT_EQ(0u, expected->lower);
      EXPECT_EQ(At(1000), expected->time.instant());
      ExpectSame(expected, Filled(scene)->Earliest(scene.query));
    }
  }
}

// Goal:   agents with no place on the grid are tested against all, once, and do not coarsen it.
// Method: 200 slow agents of which one lies in the path of another that comes from very far: from
//         1e15 m, or so fast that its faces are infinite by the window's end.
TEST(FaceSweep, AgentsSetApartAreAskedAgainstAll) {
  for (const double far : {1e15, 1e307}) {
    Random random(11);
    SweepScene scene;
    scene.query = {intersection::BoundKind::kHypertrapezoid, At(0), At(100 * kSecond)};
    if (far == 1e307) scene.query.bound = intersection::BoundKind::kHorn;
    scene.agents.push_back(Agent({0, 0, 0}, {0, 0, 0}, 1));
    while (scene.agents.size() < 200) {
      const Eigen::Vector3d above(0, 0, 1e3 + 10.0 * static_cast<double>(scene.agents.size()));
      scene.agents.push_back(Agent(above + RandomVector(&random, 1), {0, 0, 0}, 1));
    }
    scene.agents.push_back(Agent({-far, 0, 0}, {far, 0, 0}, 1));
    const std::optional<intersection::IntersectingPair> expected = PlainEarliest(scene);
    ASSERT_TRUE(expected);
    EXPECT_EQ(200u, expected->higher);
    const auto filled = Filled(scene);
    FaceSweep& sweep = *filled;
    ExpectSame(expected, sweep.Earliest(scene.query));
    EXPECT_EQ(200u, sweep.work().pair_queries);
  }
}

/// Spheres of 0.5 m with no M, 8 m apart on average: what their crossings cost, not what they meet.
SweepScene Passing(int count, std::int64_t until, Random* random) {
  SweepScene scene;
  for (int i = 0; i < count; ++i) {
    scene.agents.push_back(Agent(RandomVector(random, 40), RandomVector(random, 1), 0.5));
    scene.agents.back().filter.mask = 0;
  }
  scene.query = {intersection::BoundKind::kHypertrapezoid, At(0), At(until)};
  return scene;
}

double Crossings(int count, std::int64_t until) {
  Random random(7);
  const SweepScene scene = Passing(count, until, &random);
  const auto filled = Filled(scene);
  FaceSweep& sweep = *filled;
  EXPECT_FALSE(sweep.Earliest(scene.query));
  EXPECT_LE(sweep.queued_max(), 2u * count);
  return static_cast<double>(sweep.work().visits);
}

// Goal:   the sweep's known cost is what it is said to be: crossings grow as N² t.
// Method: counted, nothing meets; twice the agents in the same space, twice the time.
TEST(FaceSweepCost, CrossingsGrowAsSquareOfAgentsTimesTime) {
  const double once = Crossings(1000, kSecond);
  EXPECT_NEAR(4, Crossings(2000, kSecond) / once, 0.2);
  EXPECT_NEAR(2, Crossings(1000, 2 * kSecond) / once, 0.1);
  EXPECT_GT(once, 1000);
}

// Goal:   the sweep stops at the answer, and tests few pairs on the way.
// Method: the same agents, with M, and with one pair that meets after a hundredth of the window.
TEST(FaceSweepCost, StopsAtTheFirstMeeting) {
  Random random(7);
  SweepScene scene = Passing(1000, kSecond, &random);
  const double all = Crossings(1000, kSecond);
  scene.agents.push_back(Agent({100, 0, 0}, {1, 0, 0}, 0.5));
  scene.agents.push_back(Agent({101.02, 0, 0}, {-1, 0, 0}, 0.5));
  const auto filled = Filled(scene);
  FaceSweep& sweep = *filled;
  const std::optional<intersection::IntersectingPair> meeting = sweep.Earliest(scene.query);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(1000u, meeting->lower);
  EXPECT_NEAR(0.01, meeting->time.seconds, 1e-9);
  EXPECT_LT(sweep.work().visits, 0.02 * all);
  EXPECT_EQ(1u, sweep.work().pair_queries);
  EXPECT_EQ(1u, sweep.work().rebuilds);
}

// Goal:   no quadratic surprise where everything is at one point: the answer is found at once.
// Method: 20,000 agents, in order of index and against it; counted.
TEST(FaceSweepCost, EverythingAtOnePoint) {
  for (const bool turned : {false, true}) {
    FaceSweep sweep;
    constexpr std::uint32_t kAgents = 20'000;
    Random random(9);
    for (std::uint32_t i = 0; i < kAgents; ++i) {
      const double offset = turned ? 1e-3 * (kAgents - i) / kAgents : 0;
      sweep.Set(i, Agent({offset, 2, 3}, RandomVector(&random, 5), 1, 5));
    }
    const auto meeting = sweep.Earliest({intersection::BoundKind::kHorn, At(0), Instant::Never()});
    ASSERT_TRUE(meeting);
    EXPECT_EQ(0u, meeting->lower);
    EXPECT_EQ(1u, meeting->higher);
    EXPECT_EQ(0, meeting->time.seconds);
    EXPECT_LT(sweep.work().filter_tests + sweep.work().pair_queries, 200u * kAgents);
  }
}

// Goal:   nothing of an earlier query stays behind: the answer is that of the present bounds.
// Method: one sweep through changes, removals and queries of both kinds; one made anew beside it.
TEST(FaceSweep, RemembersNothing) {
  Random random(8);
  FaceSweep sweep;
  BoundList bounds(80);
  for (int step = 0; step < kScenes; ++step) {
    const auto kind = random.Chance(0.5) ? intersection::BoundKind::kHorn
                                         : intersection::BoundKind::kHypertrapezoid;
    const auto layout = static_cast<SweepLayout>(random.Below(kLayouts));
    for (const motion::SpaceTimeBound& bound :
         LayOut(layout, 1 + static_cast<int>(random.Below(20)), &random)) {
      const auto agent = static_cast<std::uint32_t>(random.Below(bounds.size()));
      bounds[agent] = bound;
      sweep.Set(agent, bound);
    }
    const auto removed = static_cast<std::uint32_t>(random.Below(bounds.size()));
    if (bounds[removed]) sweep.Remove(removed);
    bounds[removed].reset();
    const intersection::BroadQuery query{kind, At(0), At(random.Below(10 * kSecond))};
    FaceSweep fresh;
    for (std::uint32_t i = 0; i < bounds.size(); ++i) {
      if (bounds[i]) fresh.Set(i, *bounds[i]);
    }
    ExpectSame(fresh.Earliest(query), sweep.Earliest(query));
  }
}

TEST(FaceSweep, OfNoneOrOneIsNone) {
  FaceSweep sweep;
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, At(0), Instant::Never()};
  EXPECT_FALSE(sweep.Earliest(query));
  sweep.Set(5, Agent({0, 0, 0}, {0, 0, 0}, 1));
  EXPECT_FALSE(sweep.Earliest(query));
}

}  // namespace
}  // namespace collision::broad_phase
