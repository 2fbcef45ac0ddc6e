// Goal:   an orientation is never further from the predicted one than said, forward and backward,
//         and may be as far. Method: turning about a fixed axis with the greatest acceleration, in
//         closed form and long double; random motions otherwise. A clock that is off, an
//         integrator's step and an undeclared bound.
#include "collision_core/motion/moving_rotation.h"

#include <gtest/gtest.h>

#include "tests/support/truth/true_motion.h"

namespace collision::motion {
namespace {

SpaceTimeBound Turning(double w, double alpha, double seconds) {
  SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(seconds * 1e9));
  bound.state.w_WB = {0, 0, w};
  bound.limits.angular_acceleration_max = alpha;
  return bound;
}

const Instant kBase = Instant::FromNanoseconds(2000000000);

Real AngleBetweenTrue(const Quaternion& a, const numeric::IntervalQuaternion& b) {
  const Quaternion middle(b.w.middle(), b.x.middle(), b.y.middle(), b.z.middle());
  const Quaternion between = a.conjugate() * middle;
  return 2 * std::atan2(between.vec().norm(), std::abs(between.w()));
}

TEST(MovingRotation, AngleIsHalfAlphaTimesTheSquareOfTheTime) {
  const MovingRotation forward = ForwardRotation(Turning(0.5, 0.25, 1), kBase);
  const MovingRotation backward = BackwardRotation(Turning(0.5, 0.25, 4), kBase);
  for (const double delta : {0.0, 0.25, 1.0, 1.5}) {
    EXPECT_NEAR(forward.angle_error.At(delta).upper, 0.125 * (1 + delta) * (1 + delta), 1e-14);
    EXPECT_NEAR(backward.angle_error.At(delta).upper, 0.125 * (2 - delta) * (2 - delta), 1e-14);
    // The prediction: turned by ω from the stamp on.
    EXPECT_LT(
        AngleBetweenTrue(Exponential({0, 0, 0.5L * (1 + delta)}), forward.OrientationAt(delta)),
        1e-15L);
    EXPECT_LT(
        AngleBetweenTrue(Exponential({0, 0, 0.5L * (delta - 2)}), backward.OrientationAt(delta)),
        1e-15L);
  }
}

TEST(MovingRotation, ErrorsClockAndStepAreCounted) {
  SpaceTimeBound bound = Turning(-2, 0.25, 1);
  bound.state.rotation_error = 0.01;
  bound.skew = 0.125;
  bound.limits.time_step = 0.0625;
  const double sigma = 1.5 + 0.125;
  EXPECT_NEAR(ForwardRotation(bound, kBase).angle_error.At(0.5).upper,
              0.01 + 2 * 0.125 + 0.125 * sigma * (sigma + 0.0625), 1e-14);
  bound.state.stamp = Instant::FromNanoseconds(4000000000);
  EXPECT_NEAR(BackwardRotation(bound, kBase).angle_error.At(0.5).upper,
              0.01 + 2 * 0.125 + 0.125 * sigma * (sigma + 0.0625), 1e-14);
}

TEST(MovingRotation, UndeclaredSaysNothing) {
  const MovingRotation turn = ForwardRotation(Turning(1, -1, 1), kBase);
  EXPECT_GE(turn.angle_error.At(0).lower, std::numbers::pi);
  EXPECT_GE(turn.angle_error.At(100).lower, std::numbers::pi);
  const MovingRotation still = ForwardRotation(Turning(1, 0, 1), kBase);
  EXPECT_EQ(still.angle_error.At(100).upper, 0);
}

// A state taken from the motion at 1 s or at 3 s holds at every instant before or after.
TEST(MovingRotation, NoMotionWithinTheBoundIsOutside) {
  Random random(7);
  double closest = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const double alpha = random.LogUniform(1e-3, 2);
    TrueMotion motion;
    motion.start.q = RandomTurn(random);
    motion.start.w = random.LogUniform(1e-2, 5) * RandomUnit(random);
    const Vector axis =
        random.Chance(0.3) ? Vector(motion.start.w.normalized()) : RandomUnit(random);
    motion.pieces = {{random.Uniform(0, 3), Vector::Zero(), alpha * axis},
                     {3, Vector::Zero(), -alpha * axis}};
    MotionLimits limits;
    limits.angular_acceleration_max = alpha;
    for (const bool is_forward : {true, false}) {
      SpaceTimeBound bound = BoundAt(motion, is_forward ? 1 : 3, limits);
      // ω is rounded too, which no state declares.
      bound.state.rotation_error = 1e-14;
      const Instant base = Instant::FromNanoseconds(1500000000);
      const MovingRotation turn =
          is_forward ? ForwardRotation(bound, base) : BackwardRotation(bound, base);
      for (const double delta : {0.0, 0.5, 1.0, 1.5}) {
        const Real angle = AngleBetweenTrue(motion.At(1.5L + delta).q, turn.OrientationAt(delta));
        const double allowed = turn.angle_error.At(delta).upper;
        EXPECT_LE(angle, allowed + 1e-15);
        closest = std::max(closest, static_cast<double>(angle) / allowed);
      }
    }
  }
  EXPECT_GT(closest, 0.99) << "the bound is reached where the axis stays";
}

}  // namespace
}  // namespace collision::motion
