#include "collision_core/motion/space_time_bound.h"

#include <gtest/gtest.h>

#include "collision_core/motion/horn_box.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::motion {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

SpaceTimeBound AnyBound(Random& random) {
  SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(kSecond)));
  bound.state.p_WA = random.LogUniform(1e-3, 1e9) * random.UnitVector();
  bound.state.v_WA = random.LogUniform(1e-3, 1e3) * Eigen::Vector3d(2, -3, 6);
  bound.state.position_error = random.Uniform(0, 1);
  bound.state.velocity_error = random.Uniform(0, 1);
  bound.limits.radius = random.Uniform(0, 10);
  bound.limits.acceleration_max = random.LogUniform(1e-3, 1e3);
  bound.limits.time_step = random.Chance(0.5) ? 0 : random.Uniform(0, 0.1);
  return bound;
}

void ExpectSame(const numeric::MovingBall& ball, const ExactHorn& horn) {
  EXPECT_TRUE(Contains(ball.centre().x, horn.p[0]));
  EXPECT_TRUE(Contains(ball.centre().y, horn.p[1]));
  EXPECT_TRUE(Contains(ball.centre().z, horn.p[2]));
  EXPECT_TRUE(Contains(ball.u.c0, horn.u[0]));
  EXPECT_TRUE(Contains(ball.u.c1, horn.u[1]));
  EXPECT_TRUE(Contains(ball.u.c2, horn.u[2]));
  EXPECT_TRUE(Contains(ball.u.c3, horn.u.size() > 3 ? horn.u[3] : Exact(0)));
  for (int axis = 0; axis < 3; ++axis) {
    const auto of = [axis](const numeric::IntervalVector& v) {
      return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
    };
    EXPECT_TRUE(Contains(of(ball.velocity), horn.v[axis]));
    EXPECT_TRUE(Contains(of(ball.bend), horn.h[axis]));
    const Exact later = horn.p[axis] + 3 * horn.v[axis] + 9 * horn.h[axis];
    EXPECT_TRUE(Contains(of(ball.centre() + ball.PathTo(3)), later));
    EXPECT_TRUE(Contains(of(ball.VelocityAt(3)), horn.v[axis] + 6 * horn.h[axis]));
  }
  EXPECT_LE(ball.u.c0.width(), 32 * 0x1p-52 * ball.u.c0.upper);
  EXPECT_LE(ball.u.c2.width(), horn.u.size() > 3 ? 8 * 0x1p-52 * ball.u.c2.upper : 0);
}

// Goal:   the coefficients of both horns contain the exact ones, with errors, step and skew.
// Method: the definition in exact rationals; v a multiple of (2, −3, 6), whose length is 7.
TEST(SpaceTimeBound, CoefficientsContainTheExactOnes) {
  Random random(31);
  for (int i = 0; i < 2000; ++i) {
    SpaceTimeBound bound = AnyBound(random);
    bound.state.v_WA = Eigen::Vector3d(2, -3, 6) * std::ldexp(1, static_cast<int>(random.Below(9)));
    bound.skew = random.Chance(0.5) ? 0 : random.Uniform(0, 0.01);
    if (random.Chance(0.5)) {
      bound.state.a_WA =
          Eigen::Vector3d(6, 2, -3) * std::ldexp(1, static_cast<int>(random.Below(9)) - 6);
    }
    if (random.Chance(0.5)) bound.limits.jerk_max = random.LogUniform(1e-3, 1e3);
    const auto apart = static_cast<std::int64_t>(random.Below(100 * kSecond));
    const std::int64_t stamp = bound.state.stamp.nanoseconds();
    const Instant later = Instant::FromNanoseconds(stamp + apart);
    const Instant earlier = Instant::FromNanoseconds(stamp - apart);
    ExpectSame(ForwardBall(bound, later), ExactHorn(bound, later));
    ExpectSame(BackwardBall(bound, earlier), ExactHorn(bound, earlier, -1));
    ASSERT_FALSE(HasFailure());
  }
}

// Goal:   u is what the documented formula says, at a value known by hand.
// Method: M = 2, σ = 3 + 1 after the stamp, h = 0.5: 0.25 + 7·1 + 0.5·4 + ½·2·4·4.5 = 27.25.
TEST(SpaceTimeBound, FormulaByHand) {
  SpaceTimeBound bound;
  bound.state.v_WA = {2, 3, 6};
  bound.state.position_error = 0.25;
  bound.state.velocity_error = 0.5;
  bound.limits.acceleration_max = 2;
  bound.limits.time_step = 0.5;
  bound.skew = 1;
  const numeric::Interval u = ForwardBall(bound, Instant()).u.At(3);
  EXPECT_EQ(u.lower, 27.25);
  EXPECT_EQ(u.upper, 27.25);
}

// Goal:   likewise with a known acceleration and a jerk, at a value known by hand.
// Method: beside the above a = (0, 6, 8), J = 3; σ = 4, h = 0.5 and κ = 1 make it
//         10·(1 + 0.25)·4 + 3/6·4·(16 + 6 + 0.75) = 50 + 45.5 more.
TEST(SpaceTimeBound, FormulaOfKnownAccelerationByHand) {
  SpaceTimeBound bound;
  bound.state.v_WA = {2, 3, 6};
  bound.state.a_WA = {0, 6, 8};
  bound.state.position_error = 0.25;
  bound.state.velocity_error = 0.5;
  bound.limits.acceleration_max = 2;
  bound.limits.jerk_max = 3;
  bound.limits.time_step = 0.5;
  bound.skew = 1;
  const numeric::MovingBall ball = ForwardBall(bound, Instant());
  EXPECT_EQ(ball.u.At(3).lower, 27.25 + 95.5);
  EXPECT_EQ(ball.u.At(3).upper, 27.25 + 95.5);
  EXPECT_EQ(ball.PathTo(3).z.lower, 6 * 3 + 0.5 * 8 * 9);
  EXPECT_EQ(ball.VelocityAt(3).z.upper, 6 + 8 * 3);
}

// Goal:   semi-implicit Euler with |a| = M never leaves the horn with its step, and leaves the one
// without. Method: full thrust along +x; exact in doubles with h = 1/8.
TEST(SpaceTimeBound, StepOfSemiImplicitEuler) {
  SpaceTimeBound bound;
  bound.limits.acceleration_max = 2;
  bound.limits.time_step = 0.125;
  SpaceTimeBound without = bound;
  without.limits.time_step = 0;
  double p = 0, v = 0;
  for (int step = 1; step <= 100; ++step) {
    v += 2 * 0.125;
    p += v * 0.125;
    const Instant t = Instant::FromNanoseconds(step * kSecond / 8);
    EXPECT_LE(p, ForwardBall(bound, t).u.c0.upper);
    EXPECT_GT(p, ForwardBall(without, t).u.c0.upper);
  }
}

// Goal:   while the direction holds the box contains every motion with a·d >= 0, is smaller than
//         the ball's where the direction says so, and is the ball's box from its end on.
// Method: random piecewise constant accelerations in the half space; extents known by hand for d =
//         (0.6, 0.8, 0).
TEST(SpaceTimeBound, BoxWithDirection) {
  SpaceTimeBound bound;
  bound.limits.acceleration_max = 2;
  bound.state.direction = {0.6, 0.8, 0};
  bound.state.direction_until = Instant::FromNanoseconds(4 * kSecond);
  const FaceBox box = BoxAt(bound, Instant::FromNanoseconds(4 * kSecond));
  EXPECT_NEAR(box.upper[0].upper, 16, 1e-12);
  EXPECT_NEAR(box.lower[0].lower, -16 * 0.8, 1e-12);
  EXPECT_NEAR(box.lower[1].lower, -16 * 0.6, 1e-12);
  EXPECT_NEAR(box.lower[2].lower, -16, 1e-12);
  const FaceBox after = BoxAt(bound, Instant::FromNanoseconds(4 * kSecond + 1));
  EXPECT_LT(after.lower[0].lower, -16);
  bound.skew = 0.5;
  EXPECT_LT(BoxAt(bound, Instant::FromNanoseconds(4 * kSecond)).lower[1].lower, -16);

  Random random(32);
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector3d p(0, 0, 0), v(0, 0, 0);
    for (int piece = 0; piece < 4; ++piece) {
      Eigen::Vector3d a = 2 * random.UnitVector();
      if (a.dot(bound.state.direction) < 0) a = -a;
      p += v + 0.5 * a;
      v += a;
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LE(p[axis], box.upper[axis].upper + 1e-12);
      ASSERT_GE(p[axis], box.lower[axis].lower - 1e-12);
    }
  }
}

}  // namespace
}  // namespace collision::motion
