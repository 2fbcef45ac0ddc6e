// Goal:   the rotation of the motion log, which is also published, keeps the declared bounds.
// Method: against constant rotations in closed form and Runge-Kutta steps in long double; bounds
//         in rationals.
#include "client/programs/simulators/motion/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/library/validation.h"
#include "tests/support/truth/exact.h"

namespace collision::client {
namespace {

using Long4 = std::array<long double, 4>;

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

// q' = ½ ω(t) q.
Long4 Slope(const Long4& q, const TurnPiece& turn, long double t) {
  long double w[3];
  for (int i = 0; i < 3; ++i) {
    w[i] = turn.angular_velocity_rad_s[i] + t * turn.angular_acceleration_rad_s2[i];
  }
  return {
      (-w[0] * q[1] - w[1] * q[2] - w[2] * q[3]) / 2, (w[0] * q[0] + w[1] * q[3] - w[2] * q[2]) / 2,
      (w[1] * q[0] + w[2] * q[1] - w[0] * q[3]) / 2, (w[2] * q[0] + w[0] * q[2] - w[1] * q[1]) / 2};
}

Long4 Plus(const Long4& q, const Long4& slope, long double factor) {
  Long4 sum = q;
  for (int i = 0; i < 4; ++i) sum[i] += factor * slope[i];
  return sum;
}

// The classical fourth order; 2000 steps of 1/30 s leave an error far below 1e-17.
Long4 Integrated(const TurnPiece& turn, std::int64_t stamp_ns) {
  constexpr int kSteps = 2000;
  Long4 q;
  for (int i = 0; i < 4; ++i) q[i] = turn.orientation[i];
  const long double h = static_cast<long double>(stamp_ns - turn.t0_ns) * 1e-9L / kSteps;
  for (int step = 0; step < kSteps; ++step) {
    const long double t = step * h;
    const Long4 a = Slope(q, turn, t);
    const Long4 b = Slope(Plus(q, a, h / 2), turn, t + h / 2);
    const Long4 c = Slope(Plus(q, b, h / 2), turn, t + h / 2);
    const Long4 d = Slope(Plus(q, c, h), turn, t + h);
    for (int i = 0; i < 4; ++i) q[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return q;
}

double Distance(const Quaternion& a, const Long4& b) {
  long double square = 0;
  for (int i = 0; i < 4; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return static_cast<double>(std::sqrt(square));
}

Exact Square(const Vector3& v) {
  return Exact(v[0]) * v[0] + Exact(v[1]) * v[1] + Exact(v[2]) * v[2];
}

TEST(RigidMotion, TheSeriesIsTheSolution) {
  SeededRandom random(11);
  for (int i = 0; i < 20; ++i) {
    TurnPiece turn;
    turn.t0_ns = 5'000'000'000;
    turn.t1_ns = turn.t0_ns + 33'333'333;
    turn.orientation = RandomOrientation(&random);
    turn.angular_velocity_rad_s = Scaled(random.InUnitBall(), 5);
    turn.angular_acceleration_rad_s2 = Scaled(random.InUnitBall(), 20);
    EXPECT_LE(Distance(OrientationAt(turn, turn.t1_ns), Integrated(turn, turn.t1_ns)), 5e-16);
    const std::int64_t within = turn.t0_ns + 12'345'678;
    EXPECT_LE(Distance(OrientationAt(turn, within), Integrated(turn, within)), 5e-16);
  }
}

// The corner of what is allowed: |ω| h = 1, α h² = 1.
TEST(RigidMotion, TheSeriesHoldsAtItsLimits) {
  TurnPiece turn;
  turn.t1_ns = std::llround(kRigidStepMax * 1e9);
  turn.angular_velocity_rad_s = {0, kTurnSpeedMax, 0};
  turn.angular_acceleration_rad_s2 = {kTurnAccelerationMax, 0, 0};
  EXPECT_LE(Distance(OrientationAt(turn, turn.t1_ns), Integrated(turn, turn.t1_ns)), 1e-15);
}

// About one axis the angle is ω t + ½ β t², whatever the order of the factors; a quarter turn about
// z takes x to y, in the world's frame and anticlockwise.
TEST(RigidMotion, TurnsAnticlockwiseInTheWorld) {
  TurnPiece turn;
  turn.t1_ns = 100'000'000;
  const double half_root = std::sqrt(0.5);
  turn.orientation = {half_root, half_root, 0, 0};  // body y is W's z, body z is W's −y
  turn.angular_velocity_rad_s = {0, 0, 0.5};
  turn.angular_acceleration_rad_s2 = {0, 0, 2};
  const double angle = 0.5 * 0.1 + 0.5 * 2 * 0.01;
  const Vector3 x = Rotated(OrientationAt(turn, turn.t1_ns), {1, 0, 0});
  EXPECT_NEAR(x[0], std::cos(angle), 1e-15);
  EXPECT_NEAR(x[1], std::sin(angle), 1e-15);
  EXPECT_NEAR(x[2], 0, 1e-15);
  const Vector3 y = Rotated(OrientationAt(turn, turn.t1_ns), {0, 1, 0});
  EXPECT_NEAR(y[2], 1, 1e-15);
  EXPECT_EQ(AngularVelocityAt(turn, turn.t1_ns), (Vector3{0, 0, 0.7}));
}

// Goal:   |Δω| <= α h without tolerance and used to the full; |ω| never above its cap.
TEST(RigidMotion, TurnsWithinItsLimitsExactly) {
  SeededRandom random(5);
  const TurnLimits limits{1.5, 2};
  RigidState state;
  const Exact bound(limits.angular_acceleration_max_rad_s2);
  Exact greatest = 0;
  double fastest = 0;
  Vector3 wanted{};
  for (int step = 0; step < 3000; ++step) {
    if (step % 90 == 0) wanted = Scaled(random.InUnitBall(), 5);
    const Exact h = Exact(StepTime(step + 1) - StepTime(step)) / 1000000000;
    const TurnPiece turn = TurnTowards(state, wanted, limits, StepTime(step), StepTime(step + 1));
    const Vector3 next = AngularVelocityAt(turn, turn.t1_ns);
    Exact change2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Exact change = Exact(next[axis]) - state.angular_velocity_rad_s[axis];
      change2 += change * change;
    }
    ASSERT_LE(change2, bound * bound * h * h) << "step " << step;
    ASSERT_LE(Square(turn.angular_acceleration_rad_s2), bound * bound) << "step " << step;
    greatest = std::max(greatest, Exact(change2 / (h * h)));
    state.angular_velocity_rad_s = next;
    state.orientation = OrientationAt(turn, turn.t1_ns);
    fastest = std::max(fastest, Norm(next));
  }
  EXPECT_GE(greatest, bound * bound * Exact(0.999));
  EXPECT_LE(fastest, limits.angular_speed_max_rad_s * (1 + 1e-15));
  EXPECT_GE(fastest, 0.95 * limits.angular_speed_max_rad_s);
}

// Goal:   |ω| τ + ½ α τ² = π/2 at the reported time, never beyond, and at most a millionth early.
TEST(RigidMotion, AQuarterTurnIsNeverReportedLate) {
  const long double quarter = std::acos(-1.0L) / 2;
  for (const double speed : {0.0, 1e-9, 0.3, 2.0, 10.0}) {
    for (const double alpha : {1e-6, 0.5, 2.0, 100.0}) {
      const long double t = QuarterTurnSeconds(speed, alpha);
      const long double turned = speed * t + 0.5L * alpha * t * t;
      EXPECT_LT(turned, quarter) << speed << " " << alpha;
      EXPECT_GT(turned, quarter - 2e-6L) << speed << " " << alpha;
    }
  }
  EXPECT_NEAR(QuarterTurnSeconds(1, 0), std::acos(-1.0) / 2, 2e-6);
  EXPECT_TRUE(std::isinf(QuarterTurnSeconds(0, 0)));
}

TEST(RigidMotion, LimitsAreThoseOfTheService) {
  EXPECT_LE(kTurnSpeedMax, kAngularSpeedMax);
  EXPECT_LE(kTurnAccelerationMax, kAccelerationMax);
}

}  // namespace
}  // namespace collision::client
