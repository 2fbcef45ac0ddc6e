// Goal:   a placed ball is rounded up and has the slack that SphereFilter asks for, and no more.
// Method: random agents of all scales that fly in all directions, so that the frame rests; the
//         promise for each in exact rational arithmetic.
#include "collision_core/broad_phase/filter/placement_frame.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = kSanitized ? 20 : 200;
constexpr std::uint32_t kAgents = 50;

constexpr Instant kStart = Instant::FromNanoseconds(5'000'000'000'000);

motion::SpaceTimeBound Draw(double size, double time, Random* random) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = numeric::AddRoundedDown(kStart, time * random->Uniform(-2, 0));
  bound.state.p_WA = random->UnitVector() * (size * random->Uniform(0, 10));
  bound.state.v_WA = random->UnitVector() * (size / time * random->LogUniform(0.1, 10));
  bound.limits.radius = random->Chance(0.2) ? 0 : size * random->LogUniform(1e-6, 1);
  bound.limits.acceleration_max =
      random->Chance(0.3) ? 0 : size / (time * time) * random->LogUniform(1e-4, 1e4);
  return bound;
}

/// Rounded up, by a few units in the last place.
void ExpectRoundedUp(float value, const Exact& exact) {
  EXPECT_GE(Exact(value), exact);
  EXPECT_LE(Exact(value), exact * Exact(1 + 2e-6));
}

TEST(PlacementFrame, PlacedBallsAreRoundedUpWithTheSlackOfTheFilter) {
  const Exact slack(kFilterSlack), least(kReachLeast);
  for (int seed = 0; seed < kScenes; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(1e-6, 1e6), time = random.LogUniform(1e-3, 1e3);
    HornTable table;
    for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
      table.Set(agent, Draw(size, time, &random));
    }
    const PlacementFrame frame(table, {intersection::BoundKind::kHorn, kStart, Instant::Never()},
                               kWindowMax);
    for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
      const numeric::QuickBall at = table.At(agent, kStart);
      const PlacedBall horn = frame.Place(table, agent);
      Exact square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(horn.v[axis], static_cast<float>(at.v[axis])) << "the frame moves";
        square += Exact(at.v[axis]) * Exact(at.v[axis]);
      }
      const Exact speed = Exact(horn.speed) / (1 + slack), middle(frame.middle());
      EXPECT_GE(speed * speed, square);
      EXPECT_LE(speed * speed, square * Exact(1 + 4e-6));

      // The slack of the way to the middle is a part of s0, that of the way from the begin of s1.
      const Exact reach = (1 + slack) * (Exact(at.s0) + least);
      ExpectRoundedUp(horn.s0, reach + middle * (slack * Exact(horn.speed) + least));
      const Exact growth = Exact(horn.s1) / (1 + slack) - Exact(at.s1) - least;
      EXPECT_GE(growth, 0);
      EXPECT_GE(growth * growth, slack * slack * square);
      EXPECT_LE(Exact(horn.s1),
                (1 + slack) * (Exact(at.s1) + slack * speed + least) * Exact(1 + 2e-6));
      ExpectRoundedUp(horn.s2, (1 + slack) * Exact(at.s2));
    }
  }
}

}  // namespace
}  // namespace collision::broad_phase
