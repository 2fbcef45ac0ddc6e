#include "collision_core/motion/contract_between.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision_core/motion/contract.h"
#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_between.h"

namespace collision::motion {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kSecond = 1'000'000'000;

struct Pair {
  SpaceTimeBound before;
  MotionState next;

  bool IsBreach() const {
    return CheckContract(before, next).verdict == ContractVerdict::kBreached;
  }
  double BetweenExcess() const { return CheckContract(before, next).between_excess; }
  double Seconds() const {
    return numeric::SecondsBetween(before.state.stamp, next.stamp).middle();
  }
};

bool AreApart(const Pair& pair, const Exact& share = 1, const Exact& more = 0) {
  return BallsComeApart(pair.before, pair.next, share, more);
}

/// A state and one that follows from it by full thrust, or nearly so, in one to `pieces_max`
/// pieces.
struct Flight {
  Pair pair;
  bool on_a_line = false;
};

Flight RandomFlight(Random* random, int pieces_max) {
  Flight flight;
  SpaceTimeBound& before = flight.pair.before;
  before.limits.acceleration_max = random->LogUniform(1e-3, 1e3);
  before.state.p_WA = random->LogUniform(1e-3, 1e6) * random->UnitVector();
  before.state.v_WA = random->LogUniform(1e-3, 1e3) * random->UnitVector();
  flight.on_a_line = random->Chance(0.5);
  Vector3d n = random->UnitVector(), p = before.state.p_WA, v = before.state.v_WA;
  std::int64_t ns = 0;
  const int pieces = static_cast<int>(1 + random->Below(pieces_max));
  for (int i = 0; i < pieces; ++i) {
    const auto piece = static_cast<std::int64_t>(random->LogUniform(1e6, 1e10));
    const double dt = static_cast<double>(piece) * 1e-9;
    n = flight.on_a_line ? Vector3d(-n) : random->UnitVector();
    const Vector3d a = (1 - 0x1p-51) * before.limits.acceleration_max * n;
    p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    ns += piece;
  }
  flight.pair.next = before.state;
  flight.pair.next.stamp = Instant::FromNanoseconds(ns);
  flight.pair.next.p_WA = p;
  flight.pair.next.v_WA = v;
  return flight;
}

// Goal:   with a known acceleration and jerk: no honest motion is a breach, whatever way the
// unknown
//         part turns; and one that left the known path and came back to it is, which neither end
//         shows.
// Method: pieces of constant unknown acceleration of D; there and back by 1 m within 2 s, D = 0.1.
TEST(ContractBetween, KnownMotions) {
  Random random(617);
  for (int i = 0; i < 5000; ++i) {
    Flight flight = RandomFlight(&random, 5);
    Pair& pair = flight.pair;
    const double T = pair.Seconds();
    const Vector3d known = random.LogUniform(1e-3, 1e2) * random.UnitVector();
    pair.before.state.a_WA = pair.next.a_WA = known;
    pair.next.p_WA += 0.5 * T * T * known;
    pair.next.v_WA += T * known;
    if (random.Chance(0.5)) pair.before.limits.jerk_max = random.LogUniform(1e-6, 1);
    ASSERT_FALSE(pair.IsBreach()) << i << ": " << pair.BetweenExcess();
  }
  Pair pair;
  pair.before.state.a_WA = {0, 0, -9.8};
  pair.before.limits.acceleration_max = 0.1;
  pair.next = pair.before.state;
  pair.next.stamp = Instant::FromNanoseconds(2 * kSecond);
  pair.next.p_WA = {0, 0, -19.6};
  pair.next.v_WA = {0, 0, -19.6};
  EXPECT_EQ(pair.BetweenExcess(), 0);
  pair.before.state.v_WA = {0.19, 0, 0};
  pair.next.v_WA.x() = 0.19;
  EXPECT_GT(pair.BetweenExcess(), 0.01);
  EXPECT_TRUE(AreApart(pair));
}

// Goal:   full thrust, whatever way it turns, is no breach; under 1 % less it is one, where it
//         turns once and on a line: then both balls touch just at the turn.
TEST(ContractBetween, FullThrustIsKeptAndMoreIsNot) {
  Random random(611);
  int turns = 0;
  for (int i = 0; i < 20000; ++i) {
    Flight flight = RandomFlight(&random, i % 2 == 0 ? 2 : 9);
    ASSERT_FALSE(flight.pair.IsBreach()) << i << ": " << flight.pair.BetweenExcess();
    if (!flight.on_a_line || i % 2 != 0) continue;
    ++turns;
    // Far from the origin the rounding of places may explain more than 1 %.
    const double s = flight.pair.Seconds();
    double& acceleration_max = flight.pair.before.limits.acceleration_max;
    if (acceleration_max * s * s < 1e-3) continue;
    acceleration_max *= 0.99;
    ASSERT_GT(flight.pair.BetweenExcess(), 0) << i;
    ASSERT_TRUE(flight.pair.IsBreach()) << i;
  }
  EXPECT_GT(turns, 4000);
}

// Goal:   errors of the states, a clock that is off both ways, an integrator's step: no true motion
//         is taken for a breach.
// Method: flights as above, reported with the full declared errors.
TEST(ContractBetween, ErrorsOfTheTellerAreNoBreach) {
  Random random(612);
  for (int i = 0; i < 20000; ++i) {
    Pair pair = RandomFlight(&random, 4).pair;
    const auto some = [&](double most) {
      return random.Chance(0.5) ? 0 : random.LogUniform(1e-6 * most, most);
    };
    const double s = pair.Seconds(), acceleration_max = pair.before.limits.acceleration_max;
    for (MotionState* state : {&pair.before.state, &pair.next}) {
      state->position_error = some(acceleration_max * s * s);
      state->velocity_error = some(acceleration_max * s);
      state->p_WA += (1 - 0x1p-40) * state->position_error * random.UnitVector();
      state->v_WA += (1 - 0x1p-40) * state->velocity_error * random.UnitVector();
    }
    const auto skew_ns = static_cast<std::int64_t>(some(2 * s) * 1e9);
    pair.before.skew = 1.000001e-9 * static_cast<double>(skew_ns);
    const std::int64_t early = pair.before.state.stamp.nanoseconds() - skew_ns;
    pair.before.state.stamp =
        Instant::FromNanoseconds(random.Chance(0.5) ? early : early + 2 * skew_ns);
    const std::int64_t end = pair.next.stamp.nanoseconds();
    const std::int64_t stamp = random.Chance(0.5) ? end - skew_ns : end + skew_ns;
    pair.next.stamp = std::max(Instant::FromNanoseconds(stamp), pair.before.state.stamp);
    if (stamp < pair.before.state.stamp.nanoseconds()) continue;
    ASSERT_FALSE(pair.IsBreach()) << i << ": " << pair.BetweenExcess();
  }
}

// Goal:   Euler's steps at full thrust, place first or velocity first, turning once, are kept; a
//         sender that moves the place first and thrusts all the way has to declare the step, for
//         the way back.
TEST(ContractBetween, StepsOfEulerAreKept) {
  Random random(613);
  for (int i = 0; i < 4000; ++i) {
    const auto step_ns = static_cast<std::int64_t>(random.LogUniform(1e6, 1e8));
    const double h = static_cast<double>(step_ns) * 1e-9;
    const bool place_first = i % 2 == 0;
    Pair pair;
    MotionLimits& limits = pair.before.limits;
    limits.time_step = h;
    limits.acceleration_max = random.LogUniform(1e-3, 1e3);
    const Vector3d a = (1 - 0x1p-51) * limits.acceleration_max * random.UnitVector();
    const int steps = static_cast<int>(1 + random.Below(100));
    const int turn = random.Chance(0.3) ? steps : static_cast<int>(random.Below(steps));
    MotionState& next = pair.next;
    for (int k = 0; k < steps; ++k) {
      if (place_first) next.p_WA += h * next.v_WA;
      next.v_WA += (k < turn ? h : -h) * a;
      if (!place_first) next.p_WA += h * next.v_WA;
    }
    next.stamp = Instant::FromNanoseconds(steps * step_ns);
    ASSERT_FALSE(pair.IsBreach()) << i << ": " << pair.BetweenExcess();
    limits.time_step = 0;
    if (place_first && turn == steps) {
      ASSERT_GT(pair.BetweenExcess(), 0) << i;
    }
  }
}

/// A pair that may be contradictory. Speeds are rational, so that the skew's part of u is.
Pair RandomPair(Random* random) {
  Pair pair;
  const auto velocity = [random] {
    const double k = static_cast<double>(random->Below(2001)) / 1024 - 0.9765625;
    const Vector3d v(2 * k, 3 * k, 6 * k);
    const auto turn = random->Below(3);
    return turn == 0   ? v
           : turn == 1 ? Vector3d(v.y(), v.z(), v.x())
                       : Vector3d(v.z(), -v.x(), v.y());
  };
  MotionState& old = pair.before.state;
  old.v_WA = velocity();
  pair.next.v_WA = velocity();
  const auto ns = static_cast<std::int64_t>(random->LogUniform(1e7, 1e11));
  pair.next.stamp = Instant::FromNanoseconds(ns);
  const double s = pair.Seconds(), change = (pair.next.v_WA - old.v_WA).norm();
  MotionLimits& limits = pair.before.limits;
  limits.acceleration_max = std::max(change, 0.01) / s * random->Uniform(1, 2);
  const bool errs = random->Chance(0.5);
  const auto some = [&](double most) {
    return errs && random->Chance(0.5) ? random->Uniform(0, most) : 0;
  };
  limits.time_step = some(0.1 * s);
  pair.before.skew = some(0.1 * s);
  old.position_error = some(0.1 * limits.acceleration_max * s * s);
  pair.next.position_error = some(0.1 * limits.acceleration_max * s * s);
  old.velocity_error = some(0.1 * limits.acceleration_max * s);
  pair.next.velocity_error = some(0.1 * limits.acceleration_max * s);
  const double reach = ForwardBall(pair.before, pair.next.stamp).u.c0.lower;
  pair.next.p_WA = s * old.v_WA + reach * random->Uniform(0, 1) * random->UnitVector();
  return pair;
}

/// The least R / |D|, sampled: by this share all of D may grow.
double RoomOf(const Pair& pair) {
  const Instant base = pair.before.state.stamp;
  const SpaceTimeBound after{pair.next, pair.before.limits, pair.before.skew};
  const numeric::MovingBall a = ForwardBall(pair.before, base), b = BackwardBall(after, base);
  double least = numeric::kInfinity;
  for (int i = 0; i <= 1000; ++i) {
    const double s = pair.Seconds() * i / 1000;
    const Vector3d d = (a.centre() - b.centre()).middle() + s * (a.velocity - b.velocity).middle();
    least = std::min(least, (a.u + b.u).At(s).middle() / d.norm());
  }
  return least;
}

// Goal:   exactly what is contradictory in exact arithmetic is a breach, but for rounding; the
//         reported excess is no greater than the true one, and not less either.
// Method: pairs that keep the contract of position and of velocity, so that nothing else tells
//         them; M made such that many are at the edge, on both sides of it.
TEST(ContractBetween, ContradictionsAreFoundFromBothSides) {
  Random random(614);
  int between = 0;
  for (int i = 0; i < 6000; ++i) {
    Pair pair = RandomPair(&random);
    if (i % 3 != 0) {
      // All of R but what skew and errors add grows with M.
      pair.before.limits.acceleration_max /=
          RoomOf(pair) * (1 + (i % 3 == 1 ? 1e-4 : random.Uniform(-1e-2, 1e-2)));
    }
    const bool apart = AreApart(pair);
    const double gap = GapBetween(pair.before, pair.next);
    if (!apart) {
      ASSERT_EQ(pair.BetweenExcess(), 0) << i;
      ASSERT_EQ(gap, 0) << i;
      continue;
    }
    const Exact tiny = Exact(1e-12) * Exact(1 + pair.next.p_WA.norm());
    ASSERT_TRUE(gap == 0 || AreApart(pair, 1, Exact(gap) * Exact(1 - 1e-12))) << i;
    ASSERT_FALSE(AreApart(pair, 1, Exact(gap) * Exact(1 + 1e-9) + tiny)) << i << ": " << gap;
    if (!AreApart(pair, Exact(1 + 1e-6))) continue;
    ASSERT_GT(pair.BetweenExcess(), 0) << i;
    ASSERT_TRUE(pair.IsBreach()) << i;
    const ContractCheck check = CheckContract(pair.before, pair.next);
    between += check.position_excess == 0 && check.velocity_excess == 0;
  }
  EXPECT_GT(between, 3000);
}

// Goal:   an agent that is back where it rested 2 s before, under 1 m/s², comes with 2√2 − 2 m/s
//         at most (away for 2 − √2 s, then back), though 2 m/s alone could be reached, and the
//         place alone too.
TEST(ContractBetween, BackAtTheSamePlaceNotAtAnySpeed) {
  Pair pair;
  pair.before.limits.acceleration_max = 1;
  pair.next.stamp = Instant::FromNanoseconds(2 * kSecond);
  const double speed = 2 * std::sqrt(2) - 2;
  pair.next.v_WA = {0, speed * (1 - 1e-8), 0};
  EXPECT_EQ(CheckContract(pair.before, pair.next).verdict, ContractVerdict::kKept);
  pair.next.v_WA = {0, speed * (1 + 1e-8), 0};
  const ContractCheck check = CheckContract(pair.before, pair.next);
  EXPECT_EQ(check.verdict, ContractVerdict::kBreached);
  EXPECT_EQ(check.position_excess, 0);
  EXPECT_EQ(check.velocity_excess, 0);
  EXPECT_GT(check.between_excess, 0);
  EXPECT_LT(check.between_excess, 3e-8);
}

// Goal:   numbers of any size neither raise a false alarm nor hide a breach.
// Method: the case above in other units.
TEST(ContractBetween, AnyUnitsWillDo) {
  for (const double unit : {1e-300, 1e-160, 1e-12, 1.0, 1e12, 1e100}) {
    Pair pair;
    pair.before.limits.acceleration_max = unit;
    pair.next.stamp = Instant::FromNanoseconds(2 * kSecond);
    pair.next.v_WA = {0, 0.82 * unit, 0};
    EXPECT_FALSE(pair.IsBreach()) << unit;
    pair.next.v_WA = {0, 0.83 * unit, 0};
    EXPECT_TRUE(pair.IsBreach()) << unit;
  }
}

}  // namespace
}  // namespace collision::motion
