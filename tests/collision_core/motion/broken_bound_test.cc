#include "collision_core/motion/broken_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "collision_core/base/check.h"
#include "tests/support/random.h"

namespace collision::motion {
namespace {

using Eigen::Vector3d;
using Long = long double;
using LongVector = std::array<Long, 3>;

constexpr std::int64_t kSecond = 1'000'000'000;

/// A true motion to 64 bits, in pieces of constant jerk.
class TrueMotion {
 public:
  explicit TrueMotion(const MotionState& state) {
    for (int axis = 0; axis < 3; ++axis) {
      p_[axis] = state.p_WA[axis];
      v_[axis] = state.v_WA[axis];
    }
    NoteSpeed();
  }

  void Go(Long seconds, const Vector3d& acceleration, const Vector3d& jerk = Vector3d::Zero()) {
    for (int axis = 0; axis < 3; ++axis) {
      const Long a = acceleration[axis], j = jerk[axis];
      p_[axis] += seconds * (v_[axis] + seconds * (a / 2 + seconds * j / 6));
      v_[axis] += seconds * (a + seconds * j / 2);
    }
    NoteSpeed();
  }

  /// Where it is, with errors of the sender, as the next state.
  MotionState Told(const SpaceTimeBound& before, std::int64_t ns) const {
    MotionState next = before.state;
    next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() + ns);
    for (int axis = 0; axis < 3; ++axis) {
      next.p_WA[axis] = static_cast<double>(p_[axis]);
      next.v_WA[axis] = static_cast<double>(v_[axis]);
    }
    return next;
  }

  /// The greatest speed so far. While the acceleration is constant it is greatest at an end.
  Long speed_max() const { return speed_max_; }

 private:
  void NoteSpeed() { speed_max_ = std::max(speed_max_, std::hypot(v_[0], v_[1], v_[2])); }

  LongVector p_{}, v_{};
  Long speed_max_ = 0;
};

Long Length(const Vector3d& v) { return std::hypot(Long{v.x()}, Long{v.y()}, Long{v.z()}); }

SpaceTimeBound RandomStart(Random* random) {
  SpaceTimeBound before;
  before.limits.acceleration_max = random->Chance(0.2) ? 0 : random->LogUniform(1e-2, 1e2);
  if (random->Chance(0.5)) before.limits.jerk_max = random->LogUniform(1e-3, 1);
  before.state.p_WA = random->LogUniform(1e-3, 1e4) * random->UnitVector();
  before.state.v_WA = random->LogUniform(1e-3, 1e2) * random->UnitVector();
  if (random->Chance(0.5)) {
    before.state.a_WA = random->LogUniform(1e-1, 1e2) * random->UnitVector();
  }
  return before;
}

// Goal:   the acceleration seen never exceeds the one that truly was, and a motion within what is
//         declared is no breach at all.
// Method: true motions in one to six pieces of constant acceleration, in 64 bits; the deviation
//         from the known acceleration is up to eight times what is declared, and told states have
//         errors within their declaration.
TEST(BrokenBound, NeverExceedsWhatTrulyHappened) {
  Random random(2101);
  int breaches = 0, honest = 0;
  for (int i = 0; i < 4000; ++i) {
    SpaceTimeBound before = RandomStart(&random);
    const double most = std::max(before.limits.acceleration_max, 1e-2) * random.Uniform(0.1, 8);
    const double error = random.Chance(0.3) ? random.LogUniform(1e-4, 1e-1) : 0;
    before.state.position_error = before.state.velocity_error = error;
    const std::int64_t ns = 1'000'000 + static_cast<std::int64_t>(random.Below(3 * kSecond));
    const int pieces = static_cast<int>(1 + random.Below(6));
    TrueMotion motion(before.state);
    Long deviation = 0;
    for (int piece = 0; piece < pieces; ++piece) {
      const Vector3d unknown = most * random.Uniform(0.5, 1) * random.UnitVector();
      const Vector3d acceleration = before.state.a_WA + unknown;
      deviation = std::max(deviation, Length(acceleration - before.state.a_WA));
      motion.Go(Long(ns) / 1'000'000'000 / pieces, acceleration);
    }
    MotionState next = motion.Told(before, ns);
    next.p_WA += error * random.UnitVector();
    next.v_WA += error * random.UnitVector();
    const bool breached =
        CheckContract(before, next, OrientationUse::kIgnored).verdict == ContractVerdict::kBreached;
    if (deviation <= before.limits.acceleration_max) {
      ++honest;
      ASSERT_FALSE(breached) << i;
    }
    if (!breached) continue;
    ++breaches;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kIgnored);
    ASSERT_EQ(broken.bound, DeclaredBound::kAccelerationMax) << i;
    ASSERT_EQ(broken.declared, before.limits.acceleration_max) << i;
    ASSERT_GE(broken.seen, broken.declared) << i;
    ASSERT_LE(Long(broken.seen), deviation) << i;
    ASSERT_EQ(broken.from, before.state.stamp);
    ASSERT_EQ(broken.at, next.stamp);
  }
  EXPECT_GT(breaches, 500);
  EXPECT_GT(honest, 300);
}

// Goal:   a known acceleration that is wrong is found, and what is seen is nearly what was.
// Method: one constant acceleration that differs from the told one by 1.001 to 1000 times what is
//         declared, without errors and jerk; slow and near the origin, so that rounding explains
//         little.
TEST(BrokenBound, IsNearlyTightForAKnownAccelerationThatIsWrong) {
  Random random(2102);
  for (int i = 0; i < 2000; ++i) {
    SpaceTimeBound before;
    before.limits.acceleration_max = random.LogUniform(1e-1, 1e1);
    before.state.v_WA = random.Uniform(0, 10) * random.UnitVector();
    before.state.a_WA = random.Uniform(0, 20) * random.UnitVector();
    const double beyond = random.LogUniform(1e-3, 1e3);
    const Vector3d acceleration =
        before.state.a_WA + before.limits.acceleration_max * (1 + beyond) * random.UnitVector();
    const std::int64_t ns = kSecond / 10 + static_cast<std::int64_t>(random.Below(2 * kSecond));
    TrueMotion motion(before.state);
    motion.Go(Long(ns) / 1'000'000'000, acceleration);
    const MotionState next = motion.Told(before, ns);
    ASSERT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached) << i;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kMatters);
    ASSERT_EQ(broken.bound, DeclaredBound::kAccelerationMax) << i;
    const Long truth = Length(acceleration - before.state.a_WA);
    ASSERT_LE(Long(broken.seen), truth) << i;
    const Long excess = truth - broken.declared, rounding = 1e-6L;
    ASSERT_GE(Long(broken.seen), broken.declared + (1 - 2 * kSeenShortfall) * excess - rounding)
        << i;
  }
}

// Goal:   what the declared jerk explains is not counted as seen.
// Method: a deviation that grows as the jerk allows, from a start beyond what is declared.
TEST(BrokenBound, LeavesToTheJerkWhatItExplains) {
  Random random(2107);
  for (int i = 0; i < 1000; ++i) {
    SpaceTimeBound before;
    before.limits.acceleration_max = random.LogUniform(1e-1, 1e1);
    before.limits.jerk_max = random.LogUniform(1e-1, 1e1);
    before.state.v_WA = random.Uniform(0, 10) * random.UnitVector();
    before.state.a_WA = random.Uniform(0, 20) * random.UnitVector();
    const Vector3d along = random.UnitVector();
    const Vector3d unknown =
        before.limits.acceleration_max * (1 + random.LogUniform(1e-2, 1e2)) * along;
    const Vector3d acceleration = before.state.a_WA + unknown;
    const std::int64_t ns = kSecond / 10 + static_cast<std::int64_t>(random.Below(2 * kSecond));
    TrueMotion motion(before.state);
    const Vector3d jerk = before.limits.jerk_max * (1 - 1e-9) * along;
    motion.Go(Long(ns) / 1'000'000'000, acceleration, jerk);
    MotionState next = motion.Told(before, ns);
    next.a_WA += static_cast<double>(ns) * 1e-9 * jerk;  // as far off as the state before
    ASSERT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached) << i;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kIgnored);
    ASSERT_EQ(broken.bound, DeclaredBound::kAccelerationMax) << i;
    const Long truth = Length(acceleration - before.state.a_WA);
    ASSERT_LE(Long(broken.seen), truth) << i;
    ASSERT_GE(Long(broken.seen), truth - 2 * kSeenShortfall * (truth - broken.declared) - 1e-6L)
        << i;
  }
}

// Goal:   a speed above the cap is named, never above the greatest true speed and nearly tight.
// Method: speeding up under the declared acceleration from below the cap to above it.
TEST(BrokenBound, NamesASpeedAboveTheCap) {
  Random random(2103);
  int breaches = 0;
  for (int i = 0; i < 1000; ++i) {
    SpaceTimeBound before;
    before.limits.acceleration_max = 4;
    before.limits.speed_max = random.Uniform(5, 10);
    const Vector3d along = random.UnitVector();
    before.state.v_WA = (before.limits.speed_max - 1e-3) * along;
    const std::int64_t ns = kSecond + static_cast<std::int64_t>(random.Below(kSecond));
    TrueMotion motion(before.state);
    motion.Go(Long(ns) / 1'000'000'000, random.Uniform(-0.5, 3.9) * along);
    const MotionState next = motion.Told(before, ns);
    const bool breached = CheckContract(before, next).verdict == ContractVerdict::kBreached;
    if (!breached) {
      ASSERT_LE(motion.speed_max(), before.limits.speed_max + 1e-6L) << i;
      continue;
    }
    ASSERT_GT(motion.speed_max(), before.limits.speed_max) << i;
    ++breaches;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kIgnored);
    ASSERT_EQ(broken.bound, DeclaredBound::kSpeedMax) << i;
    ASSERT_EQ(broken.declared, before.limits.speed_max) << i;
    ASSERT_LE(Long(broken.seen), motion.speed_max()) << i;
    const Long excess = motion.speed_max() - broken.declared;
    ASSERT_GE(Long(broken.seen), broken.declared + (1 - 2 * kSeenShortfall) * excess - 1e-6L) << i;
  }
  EXPECT_GT(breaches, 500);
}

// Goal:   an acceleration against the declared direction, within the declared bound, is named.
// Method: constantly b against it, b from nearly 0 to the bound, beside a part across it.
TEST(BrokenBound, NamesAnAccelerationAgainstTheDirection) {
  Random random(2104);
  for (int i = 0; i < 1000; ++i) {
    SpaceTimeBound before;
    before.limits.acceleration_max = 5;
    before.limits.speed_max = random.Chance(0.5) ? 100 : numeric::kInfinity;
    before.state.v_WA = random.Uniform(0, 10) * random.UnitVector();
    before.state.a_WA = random.Uniform(0, 5) * random.UnitVector();
    const Vector3d d = before.state.direction = random.UnitVector();
    const Vector3d across = d.cross(random.UnitVector());
    const Vector3d acceleration =
        before.state.a_WA - random.Uniform(1e-2, 3) * d + random.Uniform(0, 3) * across;
    const std::int64_t ns = kSecond / 10 + static_cast<std::int64_t>(random.Below(2 * kSecond));
    TrueMotion motion(before.state);
    motion.Go(Long(ns) / 1'000'000'000, acceleration);
    const MotionState next = motion.Told(before, ns);
    ASSERT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached) << i;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kIgnored);
    ASSERT_EQ(broken.bound, DeclaredBound::kThrustDirection) << i;
    ASSERT_EQ(broken.declared, 0) << i;
    Long against = 0;
    for (int axis = 0; axis < 3; ++axis) {
      against -= (Long(acceleration[axis]) - before.state.a_WA[axis]) * d[axis];
    }
    against /= Length(d);
    ASSERT_LE(Long(broken.seen), against) << i;
    ASSERT_GE(Long(broken.seen), (1 - 2 * kSeenShortfall) * against - 1e-6L) << i;
  }
}

// Goal:   a turn faster than declared is named, where the orientation matters.
// Method: a constant angular acceleration about one axis: the turn and the velocity are exact.
TEST(BrokenBound, NamesAnAngularAcceleration) {
  Random random(2105);
  for (int i = 0; i < 500; ++i) {
    SpaceTimeBound before;
    before.limits.angular_acceleration_max = random.LogUniform(1e-2, 1);
    const double truth = before.limits.angular_acceleration_max * random.Uniform(1.01, 3);
    const std::int64_t ns = kSecond / 10 + static_cast<std::int64_t>(random.Below(kSecond / 2));
    const double s = static_cast<double>(ns) * 1e-9;
    const Vector3d axis = random.UnitVector().normalized();
    MotionState next = before.state;
    next.stamp = Instant::FromNanoseconds(ns);
    next.w_WB = truth * s * axis;
    next.q_WB = Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * truth * s * s, axis));
    EXPECT_NE(CheckContract(before, next, OrientationUse::kIgnored).verdict,
              ContractVerdict::kBreached);
    ASSERT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached) << i;
    const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kMatters);
    ASSERT_EQ(broken.bound, DeclaredBound::kAngularAccelerationMax) << i;
    ASSERT_LE(broken.seen, truth) << i;
    ASSERT_GE(broken.seen, truth - 2 * kSeenShortfall * (truth - broken.declared) - 1e-6) << i;
  }
}

// Goal:   where no acceleration explains two states, none is given.
TEST(BrokenBound, IsInfiniteForAnotherPositionAtTheSameInstant) {
  SpaceTimeBound before;
  before.limits.acceleration_max = 2;
  MotionState next = before.state;
  next.p_WA.x() = 1;
  const BrokenBound broken = ExplainBreach(before, next, OrientationUse::kIgnored);
  EXPECT_EQ(broken.bound, DeclaredBound::kAccelerationMax);
  EXPECT_EQ(broken.seen, std::numeric_limits<double>::infinity());
  next.stamp = Instant::FromNanoseconds(1);
  const double seen = ExplainBreach(before, next, OrientationUse::kIgnored).seen;
  EXPECT_TRUE(std::isfinite(seen));
  EXPECT_LE(seen, 2e18);  // ½ D s² = 1 m
  EXPECT_GE(seen, 1e17);
}

TEST(BrokenBound, IsOnlyOfABreach) {
  const SpaceTimeBound before;
  EXPECT_THROW(ExplainBreach(before, before.state, OrientationUse::kIgnored), CheckFailure);
}

}  // namespace
}  // namespace collision::motion
