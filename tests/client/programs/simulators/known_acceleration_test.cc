#include "client/programs/simulators/player/known_acceleration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/programs/simulators/player/player.h"
#include "collision_core/motion/contract.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

using Wide = std::array<long double, 3>;

/// x'' on a piece, `seconds` after its begin.
Wide AccelerationAt(const MotionPiece& piece, long double seconds) {
  Wide a{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = piece.coefficients[axis];
    a[axis] = 2 * static_cast<long double>(c[2]) + 6 * static_cast<long double>(c[3]) * seconds;
  }
  return a;
}

long double Apart(const Wide& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A random walk, uneven in time, with velocities or without.
Trajectory RandomCurve(Random* random, bool velocities) {
  std::vector<CsvRow> rows;
  double seconds = 0;
  for (int i = 0; i < 30; ++i) {
    seconds += random->Uniform(0.05, 0.5);
    CsvRow row;
    row.time_ns = std::llround(seconds * 1e9);
    for (int axis = 0; axis < 3; ++axis) {
      row.position_m[axis] = random->Uniform(-1, 1);
      row.velocity_m_s[axis] = random->Uniform(-1, 1);
    }
    rows.push_back(row);
  }
  return Trajectory(rows, velocities, 0);
}

std::int64_t RandomInstant(Random* random, const Trajectory& curve) {
  return std::llround(
      random->Uniform(static_cast<double>(curve.begin_ns()), static_cast<double>(curve.end_ns())));
}

/// A circular orbit at 7,100 km, a row each second.
Trajectory Orbit() {
  const double n = 1.0553e-3, r = 7.1e6;
  std::vector<CsvRow> rows;
  for (int i = 0; i <= 600; ++i) {
    const double u = n * i;
    CsvRow row;
    row.time_ns = i * 1'000'000'000LL;
    row.position_m = {r * std::cos(u), r * std::sin(u), 0};
    row.velocity_m_s = {-r * n * std::sin(u), r * n * std::cos(u), 0};
    rows.push_back(row);
  }
  return Trajectory(rows, true, 0);
}

motion::MotionState StateOf(const Trajectory& curve, const KnownAcceleration& known,
                            std::int64_t stamp_ns) {
  motion::MotionState state;
  const PositionAndVelocity at = curve.At(stamp_ns);
  const Vector3 a = known.At(stamp_ns);
  state.stamp = Instant::FromNanoseconds(stamp_ns);
  state.p_WA = Eigen::Map<const Eigen::Vector3d>(at.position_m.data());
  state.v_WA = Eigen::Map<const Eigen::Vector3d>(at.velocity_m_s.data());
  state.a_WA = Eigen::Map<const Eigen::Vector3d>(a.data());
  return state;
}

// Goal:   |x''(t) − a(s)| <= D + J |t − s| for all s and t, also backwards, and not by far.
// Method: random walks; a(s) at knots and between them, x'' at both limits of all knots and between
// them. Somewhere half of a jump, D, is reached, and so is the slope J of what is told.
TEST(KnownAcceleration, HoldsBetweenAllInstantsAndIsTight) {
  Random random(5);
  for (int run = 0; run < 40; ++run) {
    const Trajectory curve = RandomCurve(&random, run % 2 == 0);
    const KnownAcceleration known(curve);
    const double D = known.deviation_max_m_s2(), J = known.jerk_max_m_s3();
    long double largest = 0, steepest = 0;
    for (int i = 0; i < 60; ++i) {
      const std::int64_t s_ns = i < 30 ? curve.rows()[i].time_ns : RandomInstant(&random, curve);
      const Vector3 told = known.At(s_ns);
      for (const MotionPiece& piece : curve.pieces()) {
        const long double h = (piece.t1_ns - piece.t0_ns) * 1e-9L;
        for (const long double at : {0.0L, 0.3L * h, h}) {
          const long double apart = std::fabs((piece.t0_ns - s_ns) * 1e-9L + at);
          const long double off = Apart(AccelerationAt(piece, at), told);
          ASSERT_LE(off, D + J * apart);
          if (apart == 0) largest = std::max(largest, off);
        }
      }
      if (i == 0 || i >= 30) continue;
      const std::int64_t before_ns = curve.rows()[i - 1].time_ns;
      const Vector3 last = known.At(before_ns);
      steepest = std::max(steepest,
                          Apart({told[0], told[1], told[2]}, last) / ((s_ns - before_ns) * 1e-9L));
    }
    EXPECT_GE(largest, D * (1 - 1e-6));
    EXPECT_GE(steepest, J * (1 - 1e-6));
  }
}

// Goal:   the service keeps each state of a curve, whichever state it was sent before.
// Method: the core's own contract check, for orbits and random walks.
TEST(KnownAcceleration, EachStateHonoursAnyBefore) {
  Random random(7);
  for (int run = 0; run < 21; ++run) {
    const Trajectory curve = run == 0 ? Orbit() : RandomCurve(&random, run % 2 == 0);
    const KnownAcceleration known(curve);
    motion::SpaceTimeBound before;
    before.limits.acceleration_max = known.deviation_max_m_s2();
    before.limits.jerk_max = known.jerk_max_m_s3();
    for (int i = 0; i < 200; ++i) {
      std::int64_t stamps[] = {RandomInstant(&random, curve),
                               curve.rows()[i % curve.rows().size()].time_ns};
      if (stamps[0] > stamps[1]) std::swap(stamps[0], stamps[1]);
      before.state = StateOf(curve, known, stamps[0]);
      const auto check = motion::CheckContract(before, StateOf(curve, known, stamps[1]));
      ASSERT_EQ(check.verdict, motion::ContractVerdict::kKept)
          << "run " << run << ", " << check.position_excess << ", " << check.velocity_excess << ", "
          << check.between_excess;
    }
  }
}

// Goal:   an orbit's acceleration is known as well as its jerk n³ r allows; after 30 s its bound is
// 85 times smaller than with the acceleration alone.
TEST(KnownAcceleration, OfAnOrbitIsGravity) {
  const Trajectory curve = Orbit();
  const KnownAcceleration known(curve);
  const double n = 1.0553e-3, r = 7.1e6;
  EXPECT_LT(known.deviation_max_m_s2(), 1e-4);
  EXPECT_NEAR(known.jerk_max_m_s3(), n * n * n * r, 1e-3 * n * n * n * r);
  const double with = ReachAfter(30, known.deviation_max_m_s2(), known.jerk_max_m_s3());
  EXPECT_GT(ReachAfter(30, curve.AccelerationMax(), 0), 85 * with);
}

// Goal:   left open, the acceleration is told where it makes the bound smaller after a while.
// Method: an orbit, and a random walk, whose acceleration is different at each row.
TEST(KnownOf, TakesTheSmallerBound) {
  Random random(11);
  const Trajectory orbit = Orbit(), walk = RandomCurve(&random, false);
  PlayerOptions options;
  EXPECT_TRUE(KnownOf(orbit, options));
  EXPECT_FALSE(KnownOf(walk, options));
  options.look_ahead_s = 1e-3;
  EXPECT_TRUE(KnownOf(walk, options));
  options.known_acceleration = KnownUse::kUntold;
  EXPECT_FALSE(KnownOf(orbit, options));
  options.known_acceleration = KnownUse::kTold;
  options.look_ahead_s = 2;
  EXPECT_TRUE(KnownOf(walk, options));
  options.known_acceleration = KnownUse::kAuto;
  options.acceleration_max_m_s2 = 9;
  EXPECT_FALSE(KnownOf(orbit, options));
}

// Goal:   D and J hold on either side of jumps, and know nothing of the jumps themselves.
// Method: random walks with leaps of a kilometre: on each stretch all instants against all, and
// both bounds as small as the stretches alone have them.
TEST(KnownAcceleration, BeginsAnewAtAJump) {
  Random random(13);
  for (int run = 0; run < 20; ++run) {
    std::vector<CsvRow> rows = RandomCurve(&random, true).rows();
    for (std::size_t i = 10; i < rows.size(); i += 7) {
      rows[i].jump = true;
      for (std::size_t k = i; k < rows.size(); ++k) rows[k].position_m[0] += 1000;
    }
    const Trajectory curve(rows, run % 2 == 0, 0);
    const KnownAcceleration known(curve);
    const double D = known.deviation_max_m_s2(), J = known.jerk_max_m_s3();
    EXPECT_LT(D, 1e4);
    std::size_t stretch = 0;
    std::vector<std::size_t> stretches;
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      stretch += curve.rows()[i].jump;
      stretches.push_back(stretch);
    }
    for (std::size_t s = 0; s < stretches.size(); ++s) {
      for (const double share : {0.0, 0.6}) {
        const MotionPiece& from = curve.pieces()[s];
        const std::int64_t s_ns =
            from.t0_ns + std::llround(share * static_cast<double>(from.t1_ns - from.t0_ns));
        const Vector3 told = known.At(s_ns);
        for (std::size_t t = 0; t < stretches.size(); ++t) {
          if (stretches[s] != stretches[t]) continue;
          const MotionPiece& piece = curve.pieces()[t];
          const long double h = (piece.t1_ns - piece.t0_ns) * 1e-9L;
          for (const long double at : {0.0L, 0.3L * h, h}) {
            const long double apart = std::fabs((piece.t0_ns - s_ns) * 1e-9L + at);
            ASSERT_LE(Apart(AccelerationAt(piece, at), told), D + J * apart) << s << ", " << t;
          }
        }
      }
    }
  }
}

// Goal:   a single row stands still and knows it.
TEST(KnownAcceleration, OfASingleRowIsNone) {
  const Trajectory curve({CsvRow{5, {1, 2, 3}, {}, 2}}, false, 0);
  const KnownAcceleration known(curve);
  EXPECT_EQ(known.At(5), Vector3{});
  EXPECT_EQ(known.deviation_max_m_s2(), 0);
  EXPECT_EQ(known.jerk_max_m_s3(), 0);
}

}  // namespace
}  // namespace collision::client
