#include "client/programs/simulators/player/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/programs/simulators/player/player.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

CsvRow Row(double seconds, double x, double vx = 0) {
  return {std::llround(seconds * 1e9), {x, 0, 0}, {vx, 0, 0}};
}

// Goal:   without velocities: central differences inside, one-sided at the ends.
TEST(Trajectory, DerivesVelocitiesFromPositions) {
  const Trajectory curve({Row(0, 0), Row(1, 1), Row(3, 7), Row(4, 7)}, false, 0);
  EXPECT_DOUBLE_EQ(curve.rows()[0].velocity_m_s[0], 1);
  EXPECT_DOUBLE_EQ(curve.rows()[1].velocity_m_s[0], 7.0 / 3);
  EXPECT_DOUBLE_EQ(curve.rows()[2].velocity_m_s[0], 2);
  EXPECT_DOUBLE_EQ(curve.rows()[3].velocity_m_s[0], 0);
  EXPECT_EQ(Trajectory({Row(2, 5)}, false, 0).rows()[0].velocity_m_s[0], 0);
}

// Goal:   rows are met exactly, and a cubic is reproduced between them.
// Method: x = t³ through two rows with its velocities; its acceleration is greatest, 12, at t = 2.
TEST(Trajectory, HermiteReproducesACubic) {
  const Trajectory curve({Row(0, 0, 0), Row(2, 8, 12)}, true, 5'000'000'000);
  EXPECT_EQ(curve.begin_ns(), 5'000'000'000);
  EXPECT_NEAR(curve.At(6'000'000'000).position_m[0], 1, 1e-14);
  EXPECT_NEAR(curve.At(6'000'000'000).velocity_m_s[0], 3, 1e-14);
  EXPECT_EQ(curve.At(7'000'000'000).position_m[0], 8);
  EXPECT_GE(curve.AccelerationMax(), 12);
  EXPECT_LE(curve.AccelerationMax(), 12 * (1 + 2e-9));
}

// Goal:   a state never leaves what the state before allows: |v' - v| <= M s and |p' - p - v s| <=
// ½ M s². Method: random walks; also steady motion, where the data's own M would be mere rounding.
TEST(Trajectory, StatesKeepTheDerivedBound) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    std::vector<CsvRow> rows;
    for (int i = 0; i < (run % 3 == 2 ? 2 : 20); ++i) {
      const double walk = run % 2 == 0 ? random.Uniform(-1, 1) : 0.1 * i;
      rows.push_back(Row(i * 0.07, 1000 + walk));
    }
    const Trajectory curve(rows, false, 0);
    const long double bound = curve.AccelerationMax();
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const CsvRow &a = curve.rows()[i - 1], &b = curve.rows()[i];
      const long double s = (b.time_ns - a.time_ns) * 1e-9L;
      const long double dv =
          std::fabs(static_cast<long double>(b.velocity_m_s[0]) - a.velocity_m_s[0]);
      const long double dp = std::fabs(static_cast<long double>(b.position_m[0]) - a.position_m[0] -
                                       a.velocity_m_s[0] * s);
      ASSERT_LE(dv, bound * s);
      ASSERT_LE(dp, bound * s * s / 2);
    }
  }
}

// Goal:   nothing is derived across a jump: velocities and accelerations are those of the motion
//         before and after, and what leads to the jump goes on steadily from the row before.
// Method: 1 m/s along x, a leap of 1 km, then 2 m/s; a row alone between two jumps.
TEST(Trajectory, NothingIsDerivedAcrossAJump) {
  CsvRow leap = Row(2, 1001), alone = Row(4, -7), last = Row(5, 50);
  leap.jump = alone.jump = last.jump = true;
  const Trajectory curve({Row(0, 0), Row(1, 1), leap, Row(3, 1003), alone, last}, false, 0);
  const double speeds[] = {1, 1, 2, 2, 0, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(curve.rows()[i].velocity_m_s[0], speeds[i]) << i;
  EXPECT_LT(curve.AccelerationMax(), 1e-9);
  EXPECT_EQ(curve.At(1'500'000'000).position_m[0], 1.5);
  EXPECT_EQ(curve.At(2'000'000'000).position_m[0], 1001);
  EXPECT_EQ(curve.At(4'500'000'000).position_m[0], -7);
  EXPECT_TRUE(curve.JumpsAt(2'000'000'000));
  EXPECT_FALSE(curve.JumpsAt(1'000'000'000));
  EXPECT_FALSE(curve.JumpsAt(2'500'000'000));
  CsvRow first = Row(0, 0);
  first.jump = true;
  EXPECT_FALSE(Trajectory({first, Row(1, 1)}, false, 0).JumpsAt(0)) << "there is nothing before";
}

// Goal:   a jump has a state at any rate.
TEST(StateInstants, HaveEachJump) {
  CsvRow leap = Row(0.6, 9);
  leap.jump = true;
  const Trajectory curve({Row(0, 0), leap, Row(1, 2)}, false, 0);
  EXPECT_EQ(StateInstants(curve, 2, 0),
            (std::vector<std::int64_t>{0, 500'000'000, 600'000'000, 1'000'000'000}));
  EXPECT_EQ(StateInstants(curve, 0, 0), (std::vector<std::int64_t>{0, 600'000'000, 1'000'000'000}));
}

// Goal:   states at the rows, or at both ends and the multiples of the period between them.
TEST(StateInstants, FollowRowsOrRate) {
  const Trajectory curve({Row(0.3, 0), Row(0.5, 1), Row(1.0, 2)}, false, 0);
  EXPECT_EQ(StateInstants(curve, 0, 0),
            (std::vector<std::int64_t>{300'000'000, 500'000'000, 1'000'000'000}));
  EXPECT_EQ(StateInstants(curve, 4, 0),
            (std::vector<std::int64_t>{300'000'000, 500'000'000, 750'000'000, 1'000'000'000}));
  EXPECT_EQ(StateInstants(curve, 2, 100'000'000),
            (std::vector<std::int64_t>{300'000'000, 600'000'000, 1'000'000'000}));
}

}  // namespace
}  // namespace collision::client
