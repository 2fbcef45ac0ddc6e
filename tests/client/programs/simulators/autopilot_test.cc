// Goal:   a ship that thrusts only ahead reaches the script's targets, and flies the same way every
//         time.
#include "client/programs/simulators/motion/autopilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "client/programs/simulators/drones/drone_ships.h"
#include "client/programs/simulators/spaceship/spaceship.h"

namespace collision::client {
namespace {

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

TEST(Autopilot, TurnsToAnyDirectionAndStopsThere) {
  SeededRandom random(8);
  for (int i = 0; i < 20; ++i) {
    RigidState state;
    state.orientation = RandomOrientation(&random);
    state.angular_velocity_rad_s = Scaled(random.InUnitBall(), 2);
    Ship ship(ShipLimits(), state);
    // Straight behind is the hardest: every way round is as short.
    const Vector3 goal =
        i == 0 ? Scaled(ship.heading(), -1) : Rotated(RandomOrientation(&random), {0, 1, 0});
    for (int step = 0; step < 420; ++step) {
      ship.Step({0, TurnRateTowards(ship, goal)}, StepTime(step), StepTime(step + 1));
    }
    EXPECT_GT(Dot(ship.heading(), goal), 0.9999) << i;
    EXPECT_LT(Norm(ship.state().angular_velocity_rad_s), 0.05) << i;
  }
}

TEST(Autopilot, PushesOnlyWhenItPointsThere) {
  const Ship ship(ShipLimits(), {});
  EXPECT_EQ(FlyAt(ship, {0, 5, 0}, 0.1).thrust, 0);
  EXPECT_EQ(FlyAt(ship, {-5, 0, 0}, 0.1).thrust, 0);
  EXPECT_EQ(FlyAt(ship, {5, 0.1, 0}, 0.1).thrust, 1);
  EXPECT_EQ(FlyAt(ship, {0.05, 0, 0}, 0.1).thrust, 0);
}

TEST(Autopilot, StopsAShipThatHasNoReverse) {
  RigidState state;
  state.velocity_m_s = {9, -5, 4};
  Ship ship(ShipLimits(), state);
  for (int step = 0; step < 600; ++step) {
    ship.Step(FlyAt(ship, {}, 0.1), StepTime(step), StepTime(step + 1));
  }
  EXPECT_LE(Norm(ship.state().velocity_m_s), 0.15);
}

// One minute: it reaches several places, stays near the box, and uses its engine.
TEST(Autopilot, PatrolsTheBoxAlwaysTheSameWay) {
  const Vector3 box = BoxFor(20);
  std::vector<Vector3> ends;
  for (const std::uint64_t seed : {7, 7, 8}) {
    Ship ship(ShipLimits(), SpaceshipStart(box));
    Autopilot pilot(box, seed);
    std::set<Vector3> targets;
    double fastest = 0;
    for (int step = 0; step < 3600; ++step) {
      const ShipCommand command = pilot.Command(ship, StepTime(step));
      targets.insert(pilot.target_m());
      ship.Step(command, StepTime(step), StepTime(step + 1));
      const RigidState& state = ship.state();
      fastest = std::max(fastest, Norm(state.velocity_m_s));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(state.position_m[axis], -25) << "step " << step;
        ASSERT_LE(state.position_m[axis], box[axis] + 25) << "step " << step;
      }
    }
    EXPECT_GE(targets.size(), 7u);
    EXPECT_GE(fastest, 7);
    ends.push_back(ship.state().position_m);
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_NE(ends[0], ends[2]);
}

}  // namespace
}  // namespace collision::client
