#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "collision_core/motion/contract.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"

namespace collision::motion {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Real = boost::multiprecision::cpp_bin_float_50;
using RealQuaternion = std::array<Real, 4>;

constexpr std::int64_t kSecond = 1'000'000'000;

SpaceTimeBound Turning(double angular_acceleration_max, const Vector3d& w_WB = Vector3d::Zero()) {
  SpaceTimeBound bound;
  bound.limits.angular_acceleration_max = angular_acceleration_max;
  bound.state.w_WB = w_WB;
  return bound;
}

/// exp(turn), for a turn in W.
Quaterniond Turn(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Quaterniond::Identity();
  const Vector3d v = std::sin(0.5 * angle) / angle * turn;
  return {std::cos(0.5 * angle), v.x(), v.y(), v.z()};
}

/// The state after `ns` of constant angular velocity.
MotionState After(const SpaceTimeBound& before, std::int64_t ns) {
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() + ns);
  next.q_WB = Turn(static_cast<double>(ns) * 1e-9 * before.state.w_WB) * before.state.q_WB;
  return next;
}

MotionState AfterAndTurned(const SpaceTimeBound& before, std::int64_t ns, const Vector3d& turn) {
  MotionState next = After(before, ns);
  next.q_WB = Turn(turn) * next.q_WB;
  return next;
}

RealQuaternion Times(const RealQuaternion& a, const RealQuaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// The prediction exp(ω τ) q, to fifty digits (not normalised).
RealQuaternion Predicted(const MotionState& state, const Real& tau) {
  const Vector3d& w = state.w_WB;
  const Real x = w.x(), y = w.y(), z = w.z(), speed = sqrt(x * x + y * y + z * z);
  const RealQuaternion q = {state.q_WB.w(), state.q_WB.x(), state.q_WB.y(), state.q_WB.z()};
  if (speed == 0) return q;
  const Real s = sin(speed * tau / 2) / speed;
  return Times({cos(speed * tau / 2), s * x, s * y, s * z}, q);
}

Real Angle(const RealQuaternion& a, const RealQuaternion& b) {
  const RealQuaternion c = Times({a[0], -a[1], -a[2], -a[3]}, b);
  return 2 * atan2(sqrt(c[1] * c[1] + c[2] * c[2] + c[3] * c[3]), abs(c[0]));
}

Real Seconds(Instant from, Instant to) {
  return Real(to.nanoseconds() - from.nanoseconds()) / kSecond;
}

/// The part of the bound on the orientation that differs between two states of an agent.
Real TurnBound(const SpaceTimeBound& bound, Instant t) {
  const Real sigma = Seconds(bound.state.stamp, t);
  return Real(bound.state.rotation_error) + Real(bound.limits.angular_acceleration_max) / 2 *
                                                sigma * (sigma + Real(bound.limits.time_step));
}

// Goal:   an integrator that honours α exactly in double arithmetic never breaches.
// Method: full angular acceleration, steadily about one axis (any) or in a new direction every
//         step, 1 to 1000 steps of semi-implicit Euler; slow and fast turning. The excess is
//         reported as drift, and the new bound lies inside the old one grown by it.
TEST(ContractRotation, HonestIntegratorsAreKept) {
  Random random(71);
  for (int i = 0; i < 600; ++i) {
    SpaceTimeBound before = Turning(random.Chance(0.3) ? 0 : random.LogUniform(1e-4, 10),
                                    random.LogUniform(1e-8, 20) * random.UnitVector());
    before.state.q_WB = Turn(3 * random.UnitVector());
    const int steps = static_cast<int>(1 + random.Below(1000));
    const double dt = random.LogUniform(1e-4, 1e-2);
    before.limits.time_step = dt;
    const double full = before.limits.angular_acceleration_max * (1 - 0x1p-50);
    const bool steady = random.Chance(0.5);
    const Vector3d direction = random.UnitVector();
    MotionState next = before.state;
    for (int step = 0; step < steps; ++step) {
      next.w_WB += dt * full * (steady ? direction : random.UnitVector());
      next.q_WB = Turn(dt * next.w_WB) * next.q_WB;
      next.q_WB.normalize();
    }
    next.stamp = Instant::FromNanoseconds(std::llround(steps * dt * 1e9));
    const ContractCheck check = CheckContract(before, next);
    ASSERT_EQ(check.verdict, ContractVerdict::kKept)
        << i << ": " << check.rotation_excess << " " << check.angular_velocity_excess;
    ASSERT_LE(check.rotation_drift, 1e-7);

    for (const double later : {0.0, 0.1, 10.0}) {
      const Instant t = numeric::AddRoundedDown(next.stamp, later);
      const Real apart = Angle(Predicted(before.state, Seconds(before.state.stamp, t)),
                               Predicted(next, Seconds(next.stamp, t)));
      const Real room = TurnBound(before, t) - TurnBound({next, before.limits}, t) +
                        Real(check.rotation_drift) +
                        Real(check.angular_velocity_drift) * Real(later);
      ASSERT_LE(apart, room + Real(1e-40));
    }
  }
}

// Goal:   full acceleration about the axis of rotation is the worst case, and it is just kept.
// Method: continuous motion, angle ω s + ½ α s²; the bound is tight to 1e-9.
TEST(ContractRotation, FullAccelerationIsJustKept) {
  Random random(72);
  for (int i = 0; i < 500; ++i) {
    const Vector3d axis = random.UnitVector();
    SpaceTimeBound before = Turning(random.LogUniform(0.1, 1), random.Uniform(0.1, 5) * axis);
    before.state.q_WB = Turn(random.UnitVector());
    const double a = before.limits.angular_acceleration_max, s = 1.5;
    MotionState next = AfterAndTurned(before, 3 * kSecond / 2, (0.5 * a * s * s) * axis);
    next.w_WB += a * s * axis;
    EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
    const double more = 0.5 * a * s * s * (1 + 1e-6) + 1e-7;
    EXPECT_EQ(CheckContract(before, AfterAndTurned(before, 3 * kSecond / 2, more * axis)).verdict,
              ContractVerdict::kBreached);
  }
}

// Goal:   a breach of orientation or of angular velocity is found, each alone, when it exceeds the
//         bound by 1e-6 of it. Method: s = 2, α = ½: ½ α s² = 1, α s = 1; across the rotation.
TEST(ContractRotation, BreachesAreFoundFromBothSides) {
  SpaceTimeBound before = Turning(0.5, {0, 0, 3});
  before.state.q_WB = Quaterniond(1, 2, 3, 4);
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 0, -1), Vector3d(0, 1, 0)}) {
    MotionState next = AfterAndTurned(before, 2 * kSecond, (1 - 1e-6) * axis);
    EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
    EXPECT_EQ(CheckContract(before, next).rotation_drift, 0);
    next = AfterAndTurned(before, 2 * kSecond, (1 + 1e-6) * axis);
    ContractCheck check = CheckContract(before, next);
    EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
    EXPECT_NEAR(check.rotation_excess, 1e-6, 1e-9);
    EXPECT_EQ(check.angular_velocity_excess, 0);
    EXPECT_EQ(check.position_excess, 0);

    next = After(before, 2 * kSecond);
    next.w_WB += (1 - 1e-6) * axis;
    EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
    next = After(before, 2 * kSecond);
    next.w_WB += (1 + 1e-6) * axis;
    check = CheckContract(before, next);
    EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
    EXPECT_EQ(check.rotation_excess, 0);
    EXPECT_NEAR(check.angular_velocity_excess, 1e-6, 1e-9);
  }
}

// Goal:   the angular velocity is in W: turning about the body's axis instead is a breach.
TEST(ContractRotation, AngularVelocityIsInTheWorldFrame) {
  SpaceTimeBound before = Turning(0.1, {0, 0, 1});
  before.state.q_WB = Turn({1, 0, 0});
  MotionState next = After(before, kSecond);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.q_WB = before.state.q_WB * Turn({0, 0, 1});
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   a declared step allows what Euler needs and no more: ½ α s (s + h) = 1.125 for h = ¼.
TEST(ContractRotation, StepWidensTheOrientationOnly) {
  SpaceTimeBound before = Turning(0.5);
  before.limits.time_step = 0.25;
  const Vector3d turn(0, 0, 1.125);
  EXPECT_EQ(CheckContract(before, AfterAndTurned(before, 2 * kSecond, (1 - 1e-6) * turn)).verdict,
            ContractVerdict::kKept);
  EXPECT_EQ(CheckContract(before, AfterAndTurned(before, 2 * kSecond, (1 + 1e-6) * turn)).verdict,
            ContractVerdict::kBreached);
  MotionState next = After(before, 2 * kSecond);
  next.w_WB.x() = 1 + 1e-6;
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   an angular velocity that only the clocks explain widens, though the orientation is as was
//         predicted. Method: s = 2, α = ½, κ = 0.1: α s = 1, and α (s + 2κ) = 1.1.
TEST(ContractRotation, ClocksExplainAngularVelocityButWiden) {
  SpaceTimeBound before = Turning(0.5);
  before.skew = 0.1;
  const auto verdict = [&before](double w) {
    MotionState next = After(before, 2 * kSecond);
    next.w_WB.x() = w;
    return CheckContract(before, next).verdict;
  };
  EXPECT_EQ(verdict(0.95), ContractVerdict::kKept);
  EXPECT_EQ(verdict(1.05), ContractVerdict::kWidened);
  EXPECT_EQ(verdict(1.15), ContractVerdict::kBreached);
}

// Goal:   errors of both states explain a deviation, but the bound is then no longer inside:
//         widened; and an error that grows widens by itself. Method: α = 0, 0.1 rad each.
TEST(ContractRotation, ErrorsExplainButWiden) {
  SpaceTimeBound before = Turning(0, {1, 0, 0});
  before.state.rotation_error = 0.1;
  const auto verdict = [&before](double angle, double error) {
    MotionState next = AfterAndTurned(before, kSecond, {0, angle, 0});
    next.rotation_error = error;
    return CheckContract(before, next).verdict;
  };
  EXPECT_EQ(verdict(0.1 * (1 - 1e-6), 0), ContractVerdict::kKept);
  EXPECT_EQ(verdict(0.1 * (1 + 1e-6), 0), ContractVerdict::kBreached);
  EXPECT_EQ(verdict(0.1 * (1 + 1e-6), 0.1), ContractVerdict::kWidened);
  EXPECT_EQ(verdict(0.2 * (1 - 1e-6), 0.1), ContractVerdict::kWidened);
  EXPECT_EQ(verdict(0.2 * (1 + 1e-6), 0.1), ContractVerdict::kBreached);
  EXPECT_EQ(verdict(0, 0.1), ContractVerdict::kKept);
  EXPECT_EQ(verdict(0, 0.1 * (1 + 1e-6)), ContractVerdict::kWidened);
}

// Goal:   two stamps may be off by κ each, in opposite ways: 2 κ |ω| and α 2 κ are explained.
// Method: |ω| = 7, κ = 1/32: 7/16 rad along the rotation, with α = 0.
TEST(ContractRotation, SkewCountsTwice) {
  SpaceTimeBound before = Turning(0, {2, 3, 6});
  before.skew = 1.0 / 32;
  const Vector3d turn = before.state.w_WB / 16;
  EXPECT_NE(CheckContract(before, AfterAndTurned(before, kSecond, (1 - 1e-6) * turn)).verdict,
            ContractVerdict::kBreached);
  EXPECT_EQ(CheckContract(before, AfterAndTurned(before, kSecond, (1 + 1e-6) * turn)).verdict,
            ContractVerdict::kBreached);

  before = Turning(2);
  before.skew = 0.5;
  MotionState next = After(before, kSecond);
  next.w_WB.y() = 2 * 2 * (1 - 1e-6);
  EXPECT_NE(CheckContract(before, next).verdict, ContractVerdict::kBreached);
  next.w_WB.y() = 2 * 2 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   with skew, a faster rotation of the new state leaves less room: its bound grows by |ω'|
// κ. Method: α = ½, s = 1, κ = ¼: ½ α s (s + 2 κ) = 0.375 rad, less (1.4 − 1) κ = 0.1 rad.
TEST(ContractRotation, FasterRotationUnderSkewWidens) {
  SpaceTimeBound before = Turning(0.5, {0, 0, 1});
  before.skew = 0.25;
  const auto verdict = [&before](double angle, double speed) {
    MotionState next = AfterAndTurned(before, kSecond, {angle, 0, 0});
    next.w_WB.z() = speed;
    return CheckContract(before, next).verdict;
  };
  EXPECT_EQ(verdict(0.375 * (1 - 1e-6), 1), ContractVerdict::kKept);
  EXPECT_EQ(verdict(0.375 * (1 + 1e-6), 1), ContractVerdict::kWidened);
  EXPECT_EQ(verdict(0.275 * (1 - 1e-6), 1.4), ContractVerdict::kKept);
  EXPECT_EQ(verdict(0.275 * (1 + 1e-6), 1.4), ContractVerdict::kWidened);
}

// Goal:   the rotation does not count for a ball, or where nothing is declared.
TEST(ContractRotation, OnlyOfShapesThatDeclareIt) {
  SpaceTimeBound before = Turning(0);
  MotionState next = AfterAndTurned(before, kSecond, {0, 0, 1});
  next.w_WB = {9, 9, 9};
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
  EXPECT_EQ(CheckContract(before, next, OrientationUse::kIgnored).verdict, ContractVerdict::kKept);
  before = Turning(-1);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
}

// Goal:   a rotation too fast to follow is no breach, but no certainty either; where the bound is
//         more than half a turn, any orientation is kept.
TEST(ContractRotation, BeyondWhatCanBeFollowed) {
  SpaceTimeBound before = Turning(0.1, {0, 0, 1e7});
  EXPECT_EQ(CheckContract(before, After(before, kSecond)).verdict, ContractVerdict::kWidened);
  before = Turning(10, {0, 0, 1e7});
  MotionState next = AfterAndTurned(before, kSecond, {3, 0, 0});
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  EXPECT_EQ(CheckContract(before, next).rotation_drift, 0);
}

}  // namespace
}  // namespace collision::motion
