// Goal:   the extremes of a scene are never narrower than the truth, and are the truth once a round
//         is over; the profile names exactly the parts of the mathematics that the scene uses.
// Method: random bounds against a walk over all of them; scenes with one feature each.
#include <gtest/gtest.h>

#include <algorithm>

#include "collision_core/detection/agents/scene_extremes.h"
#include "collision_core/detection/agents/scene_profile.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

motion::SpaceTimeBound Draw(double t, Random* random) {
  motion::SpaceTimeBound bound;
  bound.state = State(t, {0, 0, 0}, random->UnitVector() * random->LogUniform(0.1, 100));
  bound.state.position_error = random->Uniform(0, 1);
  bound.state.velocity_error = random->Uniform(0, 1);
  bound.limits.acceleration_max = random->LogUniform(0.01, 100);
  bound.limits.time_step = random->Uniform(0, 0.1);
  return bound;
}

TEST(SceneExtremes, AreTheTruthOnceARoundIsOver) {
  constexpr std::size_t kAgents = 500;
  Random random(9);
  std::vector<motion::SpaceTimeBound> bounds;
  SceneExtremes extremes;
  const auto bound_of = [&](std::size_t agent) { return &bounds[agent]; };
  const auto include = [&](const motion::SpaceTimeBound& bound) {
    extremes.Include(bound);
    return bound;
  };
  for (std::size_t k = 0; k < kAgents; ++k) bounds.push_back(include(Draw(0, &random)));
  for (int step = 1; step <= 200; ++step) {
    const std::size_t agent = random.Below(kAgents);
    if (step < 100) bounds[agent] = include(Draw(step, &random));
    extremes.ExamineNext(step < 100, kAgents, bound_of);
    SceneExtremes::Bounds truth;
    for (const motion::SpaceTimeBound& bound : bounds) truth.Include(bound);
    const SceneExtremes::Bounds& kept = extremes.bounds();
    EXPECT_LE(kept.oldest, truth.oldest);
    EXPECT_GE(kept.newest, truth.newest);
    EXPECT_GE(kept.speed_max, truth.speed_max);
    EXPECT_GE(kept.acceleration_max, truth.acceleration_max);
    EXPECT_GE(kept.position_error_max, truth.position_error_max);
    EXPECT_GE(kept.time_step_max, truth.time_step_max);
    if (step < 100 + 2 * static_cast<int>(kAgents / SceneExtremes::kAgentsPerStep) + 2) continue;
    EXPECT_EQ(kept.speed_max, truth.speed_max) << "two rounds after the last change";
    EXPECT_EQ(kept.oldest, truth.oldest);
    EXPECT_EQ(kept.acceleration_max, truth.acceleration_max);
  }
}

bool LeavesOut(const SceneProfile& profile, const std::string& what) {
  const std::vector<std::string> left_out = profile.LeftOut();
  return std::any_of(left_out.begin(), left_out.end(),
                     [&](const std::string& line) { return line.rfind(what, 0) == 0; });
}

TEST(SceneProfile, NamesWhatNoAgentNeeds) {
  SceneProfile profile;
  History::Sample plain;
  plain.bound.state = State(0, {0, 0, 0}, {1, 0, 0});
  History::Sample full = plain;
  full.bound.limits.acceleration_max = 1;
  full.bound.limits.speed_max = 10;
  full.bound.limits.time_step = 0.1;
  full.bound.state.direction = {1, 0, 0};
  full.bound.state.position_error = 0.1;
  full.bound.state.expiry = At(1);
  full.filter.mask = 2;
  full.bound.skew = 0.1;
  profile.Add(SceneProfile::Of(plain));
  const char* const parts[] = {"parabolic growth", "speed caps", "directional boxes",
                               "integrator step",  "growth by",  "clock skew",
                               "expiry",           "masks"};
  for (const char* part : parts) EXPECT_TRUE(LeavesOut(profile, part)) << part;
  EXPECT_FALSE(LeavesOut(profile, "meetings")) << "an agent moves";
  profile.Add(SceneProfile::Of(full));
  for (const char* part : parts) EXPECT_FALSE(LeavesOut(profile, part)) << part;
  EXPECT_TRUE(LeavesOut(profile, "sphere trees"));
  profile.Remove(SceneProfile::Of(full));
  for (const char* part : parts) EXPECT_TRUE(LeavesOut(profile, part)) << part;
}

}  // namespace
}  // namespace collision::detection
