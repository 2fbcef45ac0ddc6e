#include "collision_core/motion/speed_cap.h"

#include <gtest/gtest.h>

#include "collision_core/intersection/earliest_intersection.h"
#include "collision_core/motion/contract.h"
#include "collision_core/motion/horn_box.h"
#include "collision_core/motion/hypertrapezoid.h"
#include "tests/support/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/exact_bound.h"

namespace collision::motion {
namespace {

constexpr int kMotions = kSanitized ? 100 : 1000;

constexpr std::int64_t kSecond = 1'000'000'000;

SpaceTimeBound Capped(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double acceleration_max,
                      double speed_max) {
  SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = 0.5;
  bound.limits.acceleration_max = acceleration_max;
  bound.limits.speed_max = speed_max;
  return bound;
}

/// An honest agent: semi-implicit Euler, any acceleration up to M, slowed down to V if need be.
class Honest {
 public:
  static constexpr std::int64_t kStep = kSecond / 100;

  Honest(Random* random, const SpaceTimeBound& bound, const Eigen::Vector3d& favourite)
      : random_(*random), limits_(bound.limits), state_(bound.state), favourite_(favourite) {}

  const MotionState& state() const { return state_; }

  void Step() {
    const double h = limits_.time_step;
    if (random_.Chance(0.05)) wish_ = random_.UnitVector();
    if (random_.Chance(0.02)) wish_ = favourite_;
    const Eigen::Vector3d v = state_.v_WA + limits_.acceleration_max * h * wish_;
    // The nearest allowed velocity is no further from the old one, which is allowed.
    const double speed = v.norm();
    state_.v_WA = speed <= limits_.speed_max ? v : v * (limits_.speed_max / speed);
    state_.p_WA += h * state_.v_WA;
    state_.stamp = Instant::FromNanoseconds(state_.stamp.nanoseconds() + kStep);
  }

 private:
  Random& random_;
  MotionLimits limits_;
  MotionState state_;
  Eigen::Vector3d favourite_;
  Eigen::Vector3d wish_ = Eigen::Vector3d::Zero();
};

SpaceTimeBound AnyCapped(Random& random) {
  const double speed_max = random.Uniform(1, 20);
  SpaceTimeBound bound =
      Capped(100 * random.UnitVector(), random.Uniform(0, 1) * speed_max * random.UnitVector(),
             random.LogUniform(0.5, 20), speed_max);
  bound.limits.time_step = 0.01;
  return bound;
}

/// The radius about p_WA + shift at t.
double CappedRadius(const CappedBall& ball, Instant t) { return ball.UFrom(t).c0.upper; }

// Goal:   a step of Euler's at the cap may go ½ M h² too far: V + ½ M h. Method: 4 + ½ 8 ¼ = 5.
TEST(SpeedCap, StepAddsHalfOfWhatItGains) {
  SpaceTimeBound bound = Capped({0, 0, 0}, {4, 0, 0}, 8, 4);
  bound.limits.time_step = 0.25;
  EXPECT_EQ(CappedSpeed(bound).lower, 5);
  EXPECT_EQ(CappedSpeed(bound).upper, 5);
}

// Goal:   the cap takes over when the definition says, to the nanosecond below.
// Method: |(2, 3, 6)| = 7, in exact arithmetic; a face likewise with half the deviation.
TEST(SpeedCap, TakesOverWhenTheSlopeReachesIt) {
  Random random(21);
  for (int i = 0; i < kMotions; ++i) {
    const double k = random.Uniform(0, 3);
    SpaceTimeBound bound = Capped({0, 0, 0}, {2, 3, 6}, random.LogUniform(1e-3, 1e3),
                                  7 + random.LogUniform(1e-3, 1e3));
    bound.state.stamp = Instant::FromNanoseconds(static_cast<std::int64_t>(random.Below(kSecond)));
    bound.state.velocity_error = 1e-4 * k;
    bound.limits.time_step = 0.25;
    bound.skew = 1e-3 * k;
    const Exact V(bound.limits.speed_max), M(bound.limits.acceleration_max);
    const Exact errors = Exact(bound.state.velocity_error), kappa(bound.skew);
    const auto expect = [&](Instant from, const Exact& exact) {
      const Exact after = ExactSeconds(bound.state.stamp, from) - (exact < 0 ? Exact(0) : exact);
      EXPECT_LE(after, 0);
      EXPECT_GE(after, Exact(-1.000001e-9) - abs(exact) * Exact(1e-15));
    };
    expect(CapStartOf(bound), (V - 7 - errors) / M - kappa);
    expect(FaceCapStartOf(bound, {2, -1}, 0.5), (V + 6 - errors + M / 16) / (M / 2) - kappa);
  }
}

// Goal:   extremes are defined: no acceleration, at the cap, above it, no cap.
TEST(SpeedCap, Extremes) {
  EXPECT_FALSE(HasSpeedCap(MotionLimits()));
  EXPECT_TRUE(CapStartOf(Capped({0, 0, 0}, {1, 0, 0}, 0, 2)).is_never());
  EXPECT_EQ(CapStartOf(Capped({0, 0, 0}, {2, 0, 0}, 0, 2)), Instant());
  EXPECT_EQ(CapStartOf(Capped({0, 0, 0}, {2, 0, 0}, 5, 2)), Instant());
  EXPECT_EQ(CapStartOf(Capped({0, 0, 0}, {3, 0, 0}, 5, 2)), Instant());
  EXPECT_TRUE(CapStartOf(Capped({0, 0, 0}, {1, 0, 0}, 1e-12, 1e6)).is_never());
  EXPECT_TRUE(NeverMoves(Capped({0, 0, 0}, {0, 0, 0}, 5, 0)));
  EXPECT_FALSE(NeverMoves(Capped({0, 0, 0}, {0, 0, 0}, 5, 1)));
  EXPECT_FALSE(NeverMoves(Capped({0, 0, 0}, {1, 0, 0}, 5, 0)));
}

// Goal:   no honest motion leaves the capped ball, the capped box or its hypertrapezoid, and
//         straight ahead it comes as far as they say. Method: seeded motions; full thrust along x.
TEST(SpeedCap, ContainsHonestMotions) {
  Random random(22);
  for (int i = 0; i < kMotions; ++i) {
    const SpaceTimeBound bound = AnyCapped(random);
    const CappedBall ball = CappedBallOf(bound);
    Honest honest(&random, bound, random.UnitVector());
    const Instant end = Instant::FromNanoseconds(10 * kSecond);
    const Hypertrapezoid h = MakeHypertrapezoid(bound, Instant(), end);
    for (int step = 1; step <= 1000; ++step) {
      honest.Step();
      const MotionState& now = honest.state();
      if (now.stamp >= ball.from) {
        const Eigen::Vector3d away = now.p_WA - bound.state.p_WA - ball.shift.middle();
        ASSERT_LE(away.norm(), CappedRadius(ball, now.stamp) + 1e-9);
      }
      if (step % 50 != 0) continue;
      const FaceBox box = BoxAt(bound, now.stamp);
      const double share = step / 1000.0;
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_LE(now.p_WA[axis] + 0.5, box.upper[axis].upper + 1e-9);
        ASSERT_GE(now.p_WA[axis] - 0.5, box.lower[axis].lower - 1e-9);
        ASSERT_LE(now.p_WA[axis] + 0.5,
                  h.upper_start[axis] * (1 - share) + h.upper_end[axis] * share + 1e-9);
      }
    }
  }
  SpaceTimeBound ahead = Capped({0, 0, 0}, {1, 0, 0}, 2, 5);
  ahead.limits.time_step = 0;
  // 2 s of thrust to 5 m/s, 6 m on the way, and 8 s at 5 m/s; backward 3 s, −6 m, and 7 s.
  const FaceBox box = BoxAt(ahead, Instant::FromNanoseconds(10 * kSecond));
  EXPECT_NEAR(box.upper[0].upper, 46.5, 1e-7);
  EXPECT_NEAR(box.lower[0].lower, -41.5, 1e-7);
  EXPECT_NEAR(CappedRadius(CappedBallOf(ahead), Instant::FromNanoseconds(10 * kSecond)), 44, 1e-7);
}

// Goal:   what an honest agent reports is kept, and takes no answer back: neither its ball nor its
//         box grows beyond the old one, nor does a meeting come earlier by more than the drift
//         explains.
// Method: reports at random times up to 5 s, also long after the cap took over; another agent
//         waits.
TEST(SpeedCap, HonestReportsAreKeptAndTakeNothingBack) {
  Random random(23);
  int postponed = 0;
  for (int i = 0; i < kMotions; ++i) {
    SpaceTimeBound before = AnyCapped(random);
    if (random.Chance(0.5)) before.skew = random.LogUniform(1e-6, 1e-2);
    const SpaceTimeBound other =
        Capped(20 * random.UnitVector() + before.state.p_WA, {0, 0, 0}, 0, 1);
    Honest honest(&random, before, (other.state.p_WA - before.state.p_WA).normalized());
    const int steps = 1 + static_cast<int>(random.Below(500));
    for (int step = 0; step < steps; ++step) honest.Step();
    const ContractCheck check = CheckContract(before, honest.state());
    ASSERT_EQ(check.verdict, ContractVerdict::kKept) << i;
    ASSERT_LE(check.position_drift, 1e-6);
    SpaceTimeBound after = before;
    after.state = honest.state();
    const intersection::IntersectionTime old_time =
        intersection::EarliestIntersection(before, other, after.state.stamp);
    const intersection::IntersectionTime new_time =
        intersection::EarliestIntersection(after, other, after.state.stamp);
    ASSERT_EQ(old_time.base, new_time.base);
    ASSERT_GE(new_time.seconds, old_time.seconds * (1 - 2e-9) - 1e-6) << i;
    postponed += new_time.seconds > old_time.seconds + 0.1;
  }
  EXPECT_GT(postponed, kMotions / 10);
}

// Goal:   above the cap, or further than the cap allows, is a breach; within rounding of it is not.
TEST(SpeedCap, Breaches) {
  const SpaceTimeBound before = Capped({0, 0, 0}, {4, 0, 0}, 2, 5);
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(10 * kSecond);
  const auto verdict = [&](double x, double v, const SpaceTimeBound& bound) {
    next.p_WA = {x, 0, 0};
    next.v_WA = {v, 0, 0};
    return CheckContract(bound, next).verdict;
  };
  // Half a second to 5 m/s, 2.25 m, and 9.5 s at 5 m/s: 49.75 m.
  EXPECT_EQ(verdict(49.75, 5, before), ContractVerdict::kKept);
  EXPECT_EQ(verdict(49.75 + 1e-6, 5, before), ContractVerdict::kBreached);
  EXPECT_EQ(verdict(40, 5 * (1 + 0x1p-50), before), ContractVerdict::kKept);
  EXPECT_EQ(verdict(40, 5 + 1e-6, before), ContractVerdict::kBreached);
  EXPECT_EQ(verdict(40, 5 + 1e-6,
                    [&] {
                      SpaceTimeBound without = before;
                      without.limits.speed_max = numeric::kInfinity;
                      return without;
                    }()),
            ContractVerdict::kKept);
  // Sideways the ball allows what the box does not.
  next.p_WA = {0, 46, 0};
  next.v_WA = {0, 5, 0};
  EXPECT_EQ(CheckContract(before, next).verdict, ContractVerdict::kBreached);
  // An error on the velocity explains a measured speed above the cap.
  next.velocity_error = 0.1;
  next.p_WA = {40, 0, 0};
  next.v_WA = {5.05, 0, 0};
  EXPECT_NE(CheckContract(before, next).verdict, ContractVerdict::kBreached);
}

// Goal:   a report that skew explains, but whose ball leaves the old capped ball, widens; one just
//         inside is kept. Method: along a diagonal, where the box has room; by 1 µm either way.
TEST(SpeedCap, OutsideTheCappedBallIsWidened) {
  SpaceTimeBound before = Capped({0, 0, 0}, {0, 0, 0}, 2, 5);
  before.skew = 0.1;
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(10 * kSecond);
  next.v_WA = {3, 3, 0};
  SpaceTimeBound after = before;
  after.state = next;
  const double room =
      CappedRadius(CappedBallOf(before), next.stamp) - ForwardBall(after, next.stamp).u.c0.upper;
  const auto verdict = [&](double distance) {
    next.p_WA = distance * Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0);
    return CheckContract(before, next).verdict;
  };
  EXPECT_EQ(verdict(room - 1e-6), ContractVerdict::kKept);
  EXPECT_EQ(verdict(room + 1e-6), ContractVerdict::kWidened);
  EXPECT_EQ(verdict(room + 3), ContractVerdict::kBreached);
}

// Goal:   a speed that rounding lets reach the cap sooner is paid for by drift.
// Method: at 4 of 5 m/s, M = 2: half a second to the cap; after a quarter 4.5 m/s and 1.5e-9 more,
//         0.75 ns too early: 1 ns, and 2 |v| = 8 m/s between the balls.
TEST(SpeedCap, TakingOverEarlyIsDrift) {
  const SpaceTimeBound before = Capped({0, 0, 0}, {4, 0, 0}, 2, 5);
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(kSecond / 4);
  next.p_WA = {1.0625, 0, 0};
  next.v_WA = {4.5, 0, 0};
  EXPECT_LE(CheckContract(before, next).position_drift, 1e-14);
  next.v_WA.x() += 1.5e-9;
  EXPECT_GE(CheckContract(before, next).position_drift, 8e-9);
}

// Goal:   the pair's answer under a cap, by hand. Method: from rest to 2 m/s in 1 s and 1 m, then 9
//         m; at the cap towards a resting agent along (2, 3, 6) / 7: the distance by the speed.
TEST(SpeedCap, MeetingsByHand) {
  SpaceTimeBound a = Capped({0, 0, 0}, {0, 0, 0}, 2, 2), b = Capped({11, 0, 0}, {0, 0, 0}, 0, 0);
  const auto seconds = [&] { return intersection::EarliestIntersection(a, b, Instant()).seconds; };
  EXPECT_LE(seconds(), 5.5);
  EXPECT_GE(seconds(), 5.5 * (1 - 1e-8));
  a.limits.speed_max = 1e6;
  const double without = seconds();
  EXPECT_NEAR(without, std::sqrt(10), 1e-8);
  a.limits.speed_max = numeric::kInfinity;
  EXPECT_EQ(seconds(), without);

  a = Capped({0, 0, 0}, {2, 3, 6}, 3, 7);
  b.state.p_WA = {30, 45, 90};
  EXPECT_NEAR(seconds(), 104.0 / 7, 1e-7);
  EXPECT_LE(seconds(), 104.0 / 7);
  // Two at the cap, side by side: sideways nothing comes faster than M lets it, 4 m / 2 = ½ M t².
  b = Capped({5, 0, 0}, {0, 0, 7}, 3, 7);
  a.state.v_WA = {0, 0, 7};
  EXPECT_NEAR(seconds(), std::sqrt(4.0 / 3), 1e-7);
}

}  // namespace
}  // namespace collision::motion
