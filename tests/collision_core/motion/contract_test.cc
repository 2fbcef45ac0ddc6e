#include "collision_core/motion/contract.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::motion {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

SpaceTimeBound Resting(double acceleration_max) {
  SpaceTimeBound bound;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

MotionState After(const SpaceTimeBound& before, std::int64_t ns) {
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() + ns);
  const double s = numeric::SecondsBetween(before.state.stamp, next.stamp).middle();
  next.p_WA += s * next.v_WA;
  return next;
}

// Goal:   an integrator that honours M exactly in double arithmetic never breaches.
// Method: full thrust, the worst case, in one to 1000 steps of any length, near and far from the
//         origin; the excess is reported as drift, and the new horn lies inside the old one grown
//         by it (exactly).
TEST(Contract, HonestIntegratorsAreKept) {
  Random random(51);
  for (int i = 0; i < 3000; ++i) {
    SpaceTimeBound before = Resting(random.Chance(0.1) ? 0 : random.LogUniform(1e-3, 1e3));
    before.state.p_WA = random.LogUniform(1e-3, 1e9) * random.UnitVector();
    before.state.v_WA = random.LogUniform(1e-3, 1e4) * random.UnitVector();
    const bool is_euler = random.Chance(0.5);
    const int steps = static_cast<int>(1 + random.Below(1000));
    const double dt = random.LogUniform(1e-4, 1);
    before.limits.time_step = is_euler ? dt : 0;
    const Eigen::Vector3d a = before.limits.acceleration_max * (1 - 0x1p-52) * random.UnitVector();
    MotionState next = before.state;
    for (int step = 0; step < steps; ++step) {
      if (is_euler) {
        next.v_WA += a * dt;
        next.p_WA += next.v_WA * dt;
      } else {
        next.p_WA += next.v_WA * dt + 0.5 * a * dt * dt;
        next.v_WA += a * dt;
      }
    }
    next.stamp = Instant::FromNanoseconds(std::llround(steps * dt * 1e9));
    const ContractCheck check = CheckContract(before, next);
    ASSERT_EQ(check.verdict, ContractVerdict::kKept)
        << i << ": " << check.position_excess << " " << check.velocity_excess;

    for (const double later : {0.0, 1.0, 1000.0}) {
      const Instant t = numeric::AddRoundedDown(next.stamp, later);
      const ExactHorn inner({next, before.limits}, t), outer(before, t);
      Exact square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        square += (inner.p[axis] - outer.p[axis]) * (inner.p[axis] - outer.p[axis]);
      }
      const Exact room = outer.u[0] - inner.u[0] + Exact(check.position_drift) +
                         Exact(check.velocity_drift) * Exact(later);
      ASSERT_LE(square, room * room);
      ASSERT_GE(room, 0);
    }
  }
}

// Goal:   a breach of position or of velocity is found, each alone, when it exceeds the bound by
// 1e-6 of it. Method: s = 2, M = 3: ½ M s² = 6, M s = 6, both of full thrust all the way.
TEST(Contract, BreachesAreFoundFromBothSides) {
  const SpaceTimeBound before = Resting(3);
  MotionState next = After(before, 2 * kSecond);
  next.p_WA.x() += 6 * (1 - 1e-6);
  next.v_WA.x() = 6 * (1 - 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  EXPECT_EQ(CheckContract(before, next).position_drift, 0);
  next.p_WA.x() = 6 * (1 + 1e-6);
  ContractCheck check = CheckContract(before, next);
  EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
  EXPECT_NEAR(check.position_excess, 6e-6, 1e-9);
  EXPECT_EQ(check.velocity_excess, 0);

  next = After(before, 2 * kSecond);
  next.p_WA.y() = 6 * (1 - 1e-6);
  next.v_WA.y() = 6 * (1 - 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.v_WA.y() = 6 * (1 + 1e-6);
  check = CheckContract(before, next);
  EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
  EXPECT_EQ(check.position_excess, 0);
  EXPECT_NEAR(check.velocity_excess, 6e-6, 1e-9);
}

// Goal:   a declared step allows what Euler needs and no more: ½ M s (s + h) = 6.75 for h = 0.25.
TEST(Contract, StepWidensThePositionOnly) {
  SpaceTimeBound before = Resting(3);
  before.limits.time_step = 0.25;
  MotionState next = After(before, 2 * kSecond);
  next.p_WA.z() = 6.75 * (1 - 1e-6);
  next.v_WA.z() = 6 * (1 - 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.p_WA.z() = 6.75 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   errors of both states explain a deviation, but the horn is then no longer inside:
// widened. Method: M = 0, ε_p = 0.5 each, ε_v = 0.25, s = 2: 1.5 m explained, 0.5 m inside.
TEST(Contract, ErrorsExplainButWiden) {
  SpaceTimeBound before = Resting(0);
  before.state.position_error = 0.5;
  before.state.velocity_error = 0.25;
  MotionState next = After(before, 2 * kSecond);
  next.p_WA.x() = 0.5 * (1 - 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.p_WA.x() = 0.5 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next.p_WA.x() = 1.5 * (1 - 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next.p_WA.x() = 1.5 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);

  next = After(before, 0);
  next.position_error = 0.5 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next = After(before, 0);
  next.velocity_error = 0.25 * (1 + 1e-6);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
}

// Goal:   two stamps may be off by κ each, in opposite ways: 2 κ |v| is explained.
// Method: |v| = 7, κ = 0.5, M = 0: up to 7 m along the path.
TEST(Contract, SkewCountsTwice) {
  SpaceTimeBound before = Resting(0);
  before.state.v_WA = {2, 3, 6};
  before.skew = 0.5;
  MotionState next = After(before, kSecond);
  next.p_WA += (1 - 1e-6) * before.state.v_WA;
  EXPECT_NE(CheckContract(before, next).verdict, ContractVerdict::kBreached);
  next.p_WA += 2e-6 * before.state.v_WA;
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   a direction lost, changed or shortened widens, one that had ended or is kept does not,
//         and a motion against it is a breach.
TEST(Contract, ALostOrChangedDirectionWidens) {
  SpaceTimeBound before = Resting(2);
  before.state.direction = {1, 0, 0};
  before.state.direction_until = Instant::FromNanoseconds(3 * kSecond);
  const MotionState kept = After(before, kSecond);
  EXPECT_EQ(CheckContract(before, kept).verdict, ContractVerdict::kKept);
  MotionState next = kept;
  next.direction_until = Instant::Never();
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.direction_until = Instant::FromNanoseconds(3 * kSecond - 1);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next = kept;
  next.direction = {0, 1, 0};
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next.direction.setZero();
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next = After(before, 3 * kSecond);
  next.direction.setZero();
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next = kept;
  next.v_WA.x() = -1e-3;
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
  next = kept;
  next.p_WA.x() = -1e-3;
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   a later expiry widens: promises to others ended at the old one. An earlier one does not.
TEST(Contract, ALaterExpiryWidens) {
  SpaceTimeBound before = Resting(2);
  before.state.expiry = Instant::FromNanoseconds(3 * kSecond);
  MotionState next = After(before, kSecond);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
  next.expiry = Instant::FromNanoseconds(3 * kSecond + 1);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kWidened);
  next.expiry = Instant::FromNanoseconds(2 * kSecond);
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kKept);
}

/// What an owner knows, and how much of it may be wrong.
SpaceTimeBound Falling(double acceleration_max, double jerk_max) {
  SpaceTimeBound bound = Resting(acceleration_max);
  bound.state.v_WA = {3, 0, 0};
  bound.state.a_WA = {0, 0, -9.8};
  bound.limits.jerk_max = jerk_max;
  return bound;
}

MotionState AfterFalling(const SpaceTimeBound& before, double s) {
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() + std::llround(s * 1e9));
  next.p_WA += s * next.v_WA + 0.5 * s * s * next.a_WA;
  next.v_WA += s * next.a_WA;
  return next;
}

// Goal:   who falls as it said is kept although it accelerates; who does not is in breach, each of
//         the three quantities alone, when it exceeds the bound by 1e-6 of it.
// Method: D = 0.5, J = 0.3, s = 2: ½ D s² + ⅙ J s³ = 1.4, D s + ½ J s² = 1.6, 2 D + J s = 1.6.
TEST(ContractOfKnownMotion, BreachesAreFoundFromBothSides) {
  const SpaceTimeBound before = Falling(0.5, 0.3);
  const auto check = [&](double p, double v, double a) {
    MotionState next = AfterFalling(before, 2);
    next.p_WA.y() += p, next.v_WA.y() += v, next.a_WA.y() += a;
    return CheckContract(before, next);
  };
  EXPECT_EQ(check(0, 0, 0).verdict, ContractVerdict::kKept);
  EXPECT_EQ(check(1.4 * (1 - 1e-6), 1.6 * (1 - 1e-6), 0.6 * (1 - 1e-6)).verdict,
            ContractVerdict::kKept);
  EXPECT_NEAR(check(1.4 * (1 + 1e-6), 1.5, 0).position_excess, 1.4e-6, 1e-8);
  EXPECT_NEAR(check(1.3, 1.6 * (1 + 1e-6), 0).velocity_excess, 1.6e-6, 1e-8);
  EXPECT_NEAR(check(0, 0, 1.6 * (1 + 1e-6)).acceleration_excess, 1.6e-6, 1e-8);
  EXPECT_EQ(check(0, 0, 1.6 * (1 + 1e-6)).verdict, ContractVerdict::kBreached);
  // What D explains beyond J s is a new guess: the horn bends another way.
  EXPECT_EQ(check(0, 0, 0.6 * (1 + 1e-6)).verdict, ContractVerdict::kWidened);
  EXPECT_EQ(check(0, 0, 0.65).verdict, ContractVerdict::kWidened);
}

// Goal:   a known acceleration that is wrong is found: gravity that does not pull.
TEST(ContractOfKnownMotion, AWrongAccelerationIsABreach) {
  const SpaceTimeBound before = Falling(0, 0);
  MotionState next = After(before, kSecond);
  const ContractCheck check = CheckContract(before, next);
  EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
  EXPECT_NEAR(check.position_excess, 4.9, 1e-6);
  EXPECT_NEAR(check.velocity_excess, 9.8, 1e-6);
}

// Goal:   a motion that uses up D and J is kept by every integrator, near and far, and the new horn
//         lies inside the old one grown by the drift, exactly.
// Method: the unknown part is D + J t along a random direction; the next state's a is that of the
//         old one and what has aged, along it too.
TEST(ContractOfKnownMotion, HonestMotionsAreKeptAndNest) {
  Random random(58);
  for (int i = 0; i < 3000; ++i) {
    SpaceTimeBound before = Resting(random.Chance(0.3) ? 0 : random.LogUniform(1e-3, 10));
    before.limits.jerk_max = random.Chance(0.2) ? 0 : random.LogUniform(1e-3, 10);
    before.state.p_WA = random.LogUniform(1e-3, 1e7) * random.UnitVector();
    before.state.v_WA = random.LogUniform(1e-3, 1e4) * random.UnitVector();
    before.state.a_WA =
        std::ldexp(1.0, static_cast<int>(random.Below(8)) - 6) * Eigen::Vector3d(2, -3, 6);
    const double s = random.LogUniform(1e-3, 10);
    const double D = before.limits.acceleration_max, J = before.limits.jerk_max;
    const Eigen::Vector3d u = (1 - 1e-12) * random.UnitVector();
    MotionState next = AfterFalling(before, s);
    next.p_WA += (0.5 * D + J * s / 6) * s * s * u;
    next.v_WA += (D + 0.5 * J * s) * s * u;
    next.a_WA += J * s * u;
    const ContractCheck check = CheckContract(before, next);
    ASSERT_EQ(check.verdict, ContractVerdict::kKept)
        << i << ": " << check.position_excess << ' ' << check.velocity_excess << ' '
        << check.acceleration_excess << ' ' << check.between_excess;
    for (const double later : {0.0, 1.0, 1000.0}) {
      const Instant t = numeric::AddRoundedDown(next.stamp, later);
      const ExactHorn inner({next, before.limits}, t), outer(before, t);
      Exact square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        square += (inner.p[axis] - outer.p[axis]) * (inner.p[axis] - outer.p[axis]);
      }
      const Exact x(later);
      const Exact room = outer.u[0] - inner.u[0] + Exact(check.position_drift) +
                         Exact(check.velocity_drift) * x +
                         Exact(check.acceleration_drift) * x * x / 2;
      ASSERT_GE(room, 0) << i;
      ASSERT_LE(square, room * room) << i << ' ' << later;
    }
  }
}

}  // namespace
}  // namespace collision::motion
