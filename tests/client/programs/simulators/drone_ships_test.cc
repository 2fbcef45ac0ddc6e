// Goal:   drone ships keep the bounds they declare, stay in their box, tumble, and fly the same way
//         for the same seed.
#include "client/programs/simulators/drones/drone_ships.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/truth/exact.h"

namespace collision::client {
namespace {

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

DroneLimits Limits(std::size_t drones) {
  DroneLimits limits;
  limits.box_m = BoxFor(drones);
  limits.speed_max_m_s = 8;
  limits.places = PlacesFor(drones);
  return limits;
}

TEST(DroneShip, KeepsItsBoundsAndStaysInTheBox) {
  const DroneLimits limits = Limits(20);
  const TurnLimits turn;
  const Exact m(limits.acceleration_max_m_s2), alpha(turn.angular_acceleration_max_rad_s2);
  double fastest_turn = 0, least_cosine = 1;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    DroneShip drone(limits, turn, Scaled(limits.box_m, 0.5), seed);
    const Vector3 first = Rotated(drone.state().orientation, {1, 0, 0});
    for (int step = 0; step < 3000; ++step) {
      const RigidState before = drone.state();
      const RigidStep moved = drone.Step(StepTime(step), StepTime(step + 1));
      ASSERT_EQ(moved.piece.t1_ns, moved.turn.t1_ns);
      const Exact h = Exact(StepTime(step + 1) - StepTime(step)) / 1000000000;
      Exact dv2 = 0, dw2 = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Exact dv = Exact(drone.state().velocity_m_s[axis]) - before.velocity_m_s[axis];
        const Exact dw =
            Exact(drone.state().angular_velocity_rad_s[axis]) - before.angular_velocity_rad_s[axis];
        dv2 += dv * dv;
        dw2 += dw * dw;
        ASSERT_GE(drone.state().position_m[axis], 0);
        ASSERT_LE(drone.state().position_m[axis], limits.box_m[axis]);
      }
      ASSERT_LE(dv2, m * m * h * h) << "step " << step;
      ASSERT_LE(dw2, alpha * alpha * h * h) << "step " << step;
      fastest_turn = std::max(fastest_turn, Norm(drone.state().angular_velocity_rad_s));
      least_cosine =
          std::min(least_cosine, Dot(first, Rotated(drone.state().orientation, {1, 0, 0})));
    }
  }
  EXPECT_GE(fastest_turn, 1);
  EXPECT_LE(fastest_turn, turn.angular_speed_max_rad_s * (1 + 1e-15));
  EXPECT_LT(least_cosine, -0.9) << "it has turned over";
}

TEST(DroneShip, TheSameSeedGivesTheSameFlight) {
  const DroneLimits limits = Limits(20);
  DroneShip a(limits, {}, {9, 9, 9}, 5), b(limits, {}, {9, 9, 9}, 5), c(limits, {}, {9, 9, 9}, 6);
  for (int step = 0; step < 300; ++step) {
    for (DroneShip* drone : {&a, &b, &c}) drone->Step(StepTime(step), StepTime(step + 1));
  }
  EXPECT_EQ(a.state().position_m, b.state().position_m);
  EXPECT_EQ(a.state().orientation, b.state().orientation);
  EXPECT_NE(a.state().position_m, c.state().position_m);
  EXPECT_NE(a.state().orientation, c.state().orientation);
}

TEST(DroneShip, ABounceChangesItsCourse) {
  DroneShip drone(Limits(20), {}, {9, 9, 9}, 5);
  drone.SetVelocities({-3, 2, 1}, {0, 0, 50});
  EXPECT_EQ(drone.state().velocity_m_s, (Vector3{-3, 2, 1}));
  EXPECT_NEAR(drone.state().angular_velocity_rad_s[2], TurnLimits().angular_speed_max_rad_s, 1e-12);
  const RigidStep step = drone.Step(0, 16'000'000);
  EXPECT_EQ(step.piece.coefficients[0][1], -3) << "the forces know as well";
  EXPECT_EQ(step.turn.angular_velocity_rad_s,
            (Vector3{0, 0, TurnLimits().angular_speed_max_rad_s}));
}

// The box grows with the drones, so that 500 of them meet as often, each, as 20 do.
TEST(DroneShips, TheBoxGrowsWithTheirNumber) {
  for (const std::size_t drones : {20, 100, 500}) {
    const Vector3 box = BoxFor(drones);
    EXPECT_NEAR(box[0] * box[1] * box[2] / static_cast<double>(drones), 8000, 1e-6);
    EXPECT_EQ(StartPositions(Limits(drones), drones, 3).size(), drones);
  }
  EXPECT_GT(PlacesFor(500), PlacesFor(20));
  EXPECT_GE(PlacesFor(0), 1u);
}

}  // namespace
}  // namespace collision::client
