// Goal:   the relative velocity of an event holds for every motion within the bounds, and names the
//         states that it comes from.
// Method: balls that accelerate as hard as they may, and a shape that turns, whose point's velocity
//         is known in closed form.
#include "collision_core/detection/encounter/event_facts.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"
#include "tests/support/solids.h"

namespace collision::detection {
namespace {

History Of(const motion::SpaceTimeBound& bound,
           const std::shared_ptr<const shape::Shape>& shape = nullptr) {
  History history;
  history.Push({.bound = bound, .shape = shape}, 4);
  return history;
}

TEST(RelativeVelocity, ContainsThatOfEveryMotionWithinTheBounds) {
  Random random(1);
  for (int round = 0; round < 500; ++round) {
    motion::SpaceTimeBound a, b;
    for (motion::SpaceTimeBound* bound : {&a, &b}) {
      bound->state = State(random.Uniform(0, 1), random.UnitVector(),
                           random.UnitVector() * random.Uniform(0, 9));
      bound->state.a_WA = random.UnitVector() * random.Uniform(0, 2);
      bound->state.velocity_error = random.Uniform(0, 0.1);
      bound->limits = {.radius = 1, .acceleration_max = random.Uniform(0, 3)};
      bound->limits.jerk_max = random.Uniform(0, 1);
    }
    const double t = 1 + random.Uniform(0, 2);
    const auto found = RelativeVelocityAt(Of(a), Of(b), At(t), Vector3d::Zero(), 0.1);
    ASSERT_TRUE(found);
    const auto fastest = [&](const motion::SpaceTimeBound& bound, const Vector3d& n) -> Vector3d {
      const double s =
          1e-9 * static_cast<double>(At(t).nanoseconds() - bound.state.stamp.nanoseconds());
      return bound.state.v_WA + bound.state.a_WA * s +
             n * (bound.state.velocity_error + bound.limits.acceleration_max * s +
                  bound.limits.jerk_max * s * s / 2);
    };
    const Vector3d n = random.UnitVector();
    const double off = (fastest(b, n) - fastest(a, -n) - found->v_AB).norm();
    EXPECT_LE(off, found->error * (1 + 1e-12)) << round;
    EXPECT_GE(off, found->error * (1 - 1e-9)) << round << ": nothing is added to it";
  }
}

// At 2 rad/s about z, a point 3 m along x moves at 6 m/s along y.
TEST(RelativeVelocity, OfAShapeIsThatOfItsPoint) {
  const auto bar = shape::Shape::Compound(nullptr, {SolidBox({-3, -0.1, -0.1}, {3, 0.1, 0.1})});
  motion::SpaceTimeBound turning, still;
  turning.state = State(0, {0, 0, 0}, {0, 0, 0});
  turning.state.w_WB = {0, 0, 2};
  turning.limits = {.radius = bar->facts().radius, .angular_acceleration_max = 0.5};
  still.state = State(0, {4, 0, 0}, {0, 0, 0});
  still.limits.radius = 1;
  const auto found = RelativeVelocityAt(Of(turning, bar), Of(still), At(0.25), {3, 0, 0}, 0.125);
  ASSERT_TRUE(found);
  EXPECT_LE((found->v_AB - Vector3d(0, -6, 0)).norm(), 1e-12);
  EXPECT_NEAR(found->error, 2 * 0.125 + 0.5 * 0.25 * 3.125, 1e-9);
  turning.limits.angular_acceleration_max = -1;
  EXPECT_FALSE(RelativeVelocityAt(Of(turning, bar), Of(still), At(0.25), {3, 0, 0}, 0.125));
}

TEST(RelativeVelocity, NoneBeforeTheFirstState) {
  motion::SpaceTimeBound late;
  late.state = State(1, {0, 0, 0}, {0, 0, 0});
  EXPECT_FALSE(RelativeVelocityAt(Of(late), Of(late), At(0.5), Vector3d::Zero(), 0));
}

}  // namespace
}  // namespace collision::detection
