// Goal:   what the baselines and the libraries are given is right: the pair test in plain double,
//         the swept boxes, and the scenes.
// Method: the canonical routine and positions sampled along the horns are the oracles; scenes are
//         drawn small, and asked by the plainest method.
#include "tests/baselines/ball_scene.h"

#include <gtest/gtest.h>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/numeric/seconds.h"
#include "tests/baselines/ball_bound.h"
#include "tests/baselines/scenes.h"
#include "tests/support/random_points.h"

namespace collision::baselines {
namespace {

BallAgent Draw(Random& random) {
  // Whole nanoseconds, so that the bound's stamp is the same.
  const double stamp = static_cast<double>(random.Below(500'000'000)) * 1e-9;
  return {InCube(random, 5), InCube(random, 4), random.Uniform(0, 1),
          random.Chance(0.3) ? 0 : random.Uniform(0, 5), stamp};
}

// The canonical time is certified: plain double may differ by rounding, and by nothing else.
TEST(ReferenceIntersectionTime, AgreesWithTheCanonicalRoutine) {
  Random random(1);
  int meetings = 0;
  for (int i = 0; i < 20'000; ++i) {
    const BallAgent a = Draw(random), b = Draw(random);
    const double limit = random.Uniform(0.5, 3);
    const intersection::IntersectionTime exact =
        intersection::EarliestIntersection(BoundOf(a), BoundOf(b), Instant());
    const double expected = std::max(a.stamp, b.stamp) + exact.seconds;
    const double plain = ReferenceIntersectionTime(a, b, limit);
    if (std::abs(expected - limit) < 1e-6) continue;
    if (expected > limit) {
      EXPECT_GT(plain, limit) << i;
    } else {
      ++meetings;
      // Grazing pairs move most: half the digits are left.
      EXPECT_NEAR(plain, expected, 1e-6) << i;
    }
  }
  EXPECT_GT(meetings, 3000);
}

TEST(SweptBox, HoldsTheHornAndTouchesIt) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const BallAgent agent = Draw(random);
    const double end = agent.stamp + random.Uniform(0, 2);
    const SweptBox box = SweptBoxOf(agent, end);
    double least = 1e300, most = -1e300;
    for (int step = 0; step <= 50; ++step) {
      const double t = (end - agent.stamp) * step / 50;
      const double reach = agent.radius + 0.5 * agent.acceleration_max * t * t;
      least = std::min(least, agent.p_WA.x() + agent.v_WA.x() * t - reach);
      most = std::max(most, agent.p_WA.x() + agent.v_WA.x() * t + reach);
    }
    EXPECT_NEAR(box.lower[0], least, 1e-9);
    EXPECT_NEAR(box.upper[0], most, 1e-9);
  }
}

double FirstMeeting(const BallScene& scene) {
  broad_phase::AllPairs all;
  for (std::uint32_t i = 0; i < scene.size(); ++i) all.Set(i, BoundOf(scene[i]));
  const auto first = all.Earliest(
      {intersection::BoundKind::kHorn, Instant(), numeric::AddRoundedDown(Instant(), 10)});
  return first ? static_cast<double>(first->time.instant().nanoseconds()) * 1e-9 : 10;
}

TEST(Scenes, TheFirstHitComesWhenItsNameSays) {
  constexpr std::uint32_t kCount = 2000;
  const BallScene at_once = FirstHitScene(kCount, FirstHit::kAtOnce);
  const BallScene half = FirstHitScene(kCount, FirstHit::kHalf);
  const BallScene never = FirstHitScene(kCount, FirstHit::kNever);
  EXPECT_EQ(at_once.size(), kCount);
  EXPECT_EQ(half.size(), kCount);
  EXPECT_EQ(never.size(), kCount);
  EXPECT_GT(FirstMeeting(at_once), 0);
  EXPECT_LT(FirstMeeting(at_once), 0.05 * kHorizon);
  EXPECT_GT(FirstMeeting(half), 0.5 * kHorizon);
  EXPECT_LT(FirstMeeting(half), 0.6 * kHorizon);
  EXPECT_GT(FirstMeeting(never), kHorizon);
  EXPECT_LT(FirstMeeting(never), 1.2 * kHorizon);
}

class NamedScenes : public testing::TestWithParam<std::string> {};

TEST_P(NamedScenes, AreReproducibleAndWithoutOverlap) {
  const BallScene scene = MakeScene(GetParam(), 500, 3), again = MakeScene(GetParam(), 500, 3);
  ASSERT_EQ(scene.size(), again.size());
  EXPECT_GT(scene.size(), 400u);
  EXPECT_LE(scene.size(), 500u);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    EXPECT_EQ(scene[i].p_WA, again[i].p_WA);
    for (std::size_t k = i + 1; k < scene.size(); ++k) {
      EXPECT_GT((scene[i].p_WA - scene[k].p_WA).norm(), scene[i].radius + scene[k].radius)
          << i << " " << k;
    }
  }
  EXPECT_GT(FirstMeeting(scene), 0);
}

INSTANTIATE_TEST_SUITE_P(All, NamedScenes, testing::ValuesIn(SceneNames()));

TEST(Scenes, AnUnknownNameIsRefused) {
  EXPECT_THROW(MakeScene("moonbase", 10, 1), std::invalid_argument);
}

TEST(Scenes, MixedSizesAreMixed) {
  double least = 1e300, most = 0;
  for (const BallAgent& agent : MakeScene("mixed-sizes", 500, 3)) {
    least = std::min(least, agent.radius), most = std::max(most, agent.radius);
  }
  EXPECT_EQ(least, 1e-3);
  EXPECT_EQ(most, 1e3);
}

}  // namespace
}  // namespace collision::baselines
