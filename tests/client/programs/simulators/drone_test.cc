#include "client/programs/simulators/motion/drone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/truth/exact.h"

namespace collision::client {
namespace {

constexpr int kSteps = 6000;

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

Exact Square(const Vector3& v) {
  return Exact(v[0]) * v[0] + Exact(v[1]) * v[1] + Exact(v[2]) * v[2];
}

// Goal:   the declared M holds without any tolerance, and is used to the full.
// Method: 100 s of flight; |Δv|² <= (M h)² and the deviation from the straight line squared <= (½ M
//         h²)², both in rationals; some step comes within 1 % of M.
TEST(Drone, KeepsItsBoundExactly) {
  const DroneLimits limits;
  const Exact bound(limits.acceleration_max_m_s2);
  Exact greatest = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Drone drone(limits, {100, 100, 25}, seed);
    for (int step = 0; step < kSteps; ++step) {
      const Vector3 p = drone.position_m(), v = drone.velocity_m_s();
      const Exact h = Exact(StepTime(step + 1) - StepTime(step)) / 1000000000;
      drone.Step(StepTime(step), StepTime(step + 1));
      Exact dv2 = 0, deviation2 = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Exact dv = Exact(drone.velocity_m_s()[axis]) - v[axis];
        const Exact deviation = Exact(drone.position_m()[axis]) - p[axis] - v[axis] * h;
        dv2 += dv * dv;
        deviation2 += deviation * deviation;
      }
      ASSERT_LE(dv2, bound * bound * h * h) << "step " << step;
      ASSERT_LE(deviation2 * 4, bound * bound * h * h * h * h) << "step " << step;
      greatest = std::max(greatest, Exact(dv2 / (h * h)));
    }
  }
  EXPECT_GE(greatest, bound * bound * Exact(0.98));
}

// Goal:   its own forces keep it below its speed cap and inside the box, and it does fly.
TEST(Drone, StaysInTheBoxBelowItsSpeedCap) {
  const DroneLimits limits;
  double fastest = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Drone drone(limits, {20, 180, 40}, seed);
    for (int step = 0; step < kSteps; ++step) {
      drone.Step(StepTime(step), StepTime(step + 1));
      const Vector3& v = drone.velocity_m_s();
      fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(drone.position_m()[axis], 0) << "step " << step;
        ASSERT_LE(drone.position_m()[axis], limits.box_m[axis]) << "step " << step;
      }
    }
  }
  EXPECT_LE(fastest, limits.speed_max_m_s);
  EXPECT_GE(fastest, 0.8 * limits.speed_max_m_s);
}

// Goal:   a bounce turns the normal component back and leaves the rest; leaving already, nothing
// changes.
TEST(Drone, BouncesOffTheOtherSide) {
  Drone drone(DroneLimits(), {100, 100, 25}, 7);
  for (int step = 0; step < 60; ++step) drone.Step(StepTime(step), StepTime(step + 1));
  const Vector3 before = drone.velocity_m_s();
  const int towards = before[0] > 0 ? 1 : -1;
  ASSERT_NE(before[0], 0);
  EXPECT_FALSE(drone.Bounce({2, 0, 0}, -towards));
  EXPECT_FALSE(drone.Bounce({0, 0, 0}, towards));
  EXPECT_EQ(drone.velocity_m_s(), before);
  EXPECT_TRUE(drone.Bounce({2, 0, 0}, towards));
  EXPECT_EQ(drone.velocity_m_s(), (Vector3{-before[0], before[1], before[2]}));
  EXPECT_FALSE(drone.Bounce({2, 0, 0}, towards));
}

// Goal:   two processes of one swarm start at different places, and no drone starts in contact.
TEST(StartPositions, SlicesOfOneSeedAreApart) {
  const DroneLimits limits;
  const auto few = StartPositions(limits, 50, 42);
  const auto all = StartPositions(limits, 100, 42);
  ASSERT_EQ(all.size(), 100u);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      Vector3 d;
      for (int axis = 0; axis < 3; ++axis) d[axis] = all[i][axis] - all[j][axis];
      EXPECT_GE(Square(d), Exact(3.9 * limits.radius_m * limits.radius_m * 3.9));
    }
  }
  EXPECT_THROW(StartPositions({{2, 2, 2}, 0.5, 15, 5}, 100, 42), std::runtime_error);
}

}  // namespace
}  // namespace collision::client
