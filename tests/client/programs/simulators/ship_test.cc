// Goal:   a ship's declarations are true: M, α, and that it does not push against the declared
//         heading until the declared time.
// Method: random commands; bounds in rationals, the direction against every later step.
#include "client/programs/simulators/motion/ship.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/truth/exact.h"

namespace collision::client {
namespace {

constexpr int kSteps = 4000;

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

ShipLimits Limits() { return {6, 15, {2, 2}}; }

Ship Somewhere(std::uint64_t seed) {
  SeededRandom random(seed);
  RigidState state;
  state.position_m = {-20, 30, 10};
  state.orientation = RandomOrientation(&random);
  return Ship(Limits(), state);
}

// Holds a command for a while, so that the ship gets fast and turns far.
ShipCommand WildCommand(SeededRandom* random) {
  return {random->Uniform(-0.5, 1.5), Scaled(random->InUnitBall(), 4)};
}

Vector3 AccelerationOf(const RigidStep& step) {
  Vector3 a;
  for (int axis = 0; axis < 3; ++axis) a[axis] = 2 * step.piece.coefficients[axis][2];
  return a;
}

TEST(Ship, KeepsItsBoundsExactly) {
  const Exact m(Limits().acceleration_max_m_s2), alpha(2);
  Exact greatest = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SeededRandom random(seed);
    Ship ship = Somewhere(seed);
    ShipCommand command;
    for (int step = 0; step < kSteps; ++step) {
      if (step % 40 == 0) command = WildCommand(&random);
      const RigidState before = ship.state();
      ship.Step(command, StepTime(step), StepTime(step + 1));
      const Exact h = Exact(StepTime(step + 1) - StepTime(step)) / 1000000000;
      Exact dv2 = 0, dw2 = 0, deviation2 = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Exact v = before.velocity_m_s[axis];
        const Exact dv = Exact(ship.state().velocity_m_s[axis]) - v;
        const Exact dw =
            Exact(ship.state().angular_velocity_rad_s[axis]) - before.angular_velocity_rad_s[axis];
        const Exact deviation =
            Exact(ship.state().position_m[axis]) - before.position_m[axis] - v * h;
        dv2 += dv * dv;
        dw2 += dw * dw;
        deviation2 += deviation * deviation;
      }
      ASSERT_LE(dv2, m * m * h * h) << "step " << step;
      ASSERT_LE(dw2, alpha * alpha * h * h) << "step " << step;
      ASSERT_LE(deviation2 * 4, m * m * h * h * h * h) << "step " << step;
      greatest = std::max(greatest, Exact(dv2 / (h * h)));
    }
  }
  EXPECT_GE(greatest, m * m * Exact(0.98));
}

// Also within a step the heading is within a quarter turn of the declared one, and no acceleration
// until then points against it. The promise is tight: soon afterwards some acceleration does.
TEST(Ship, NeverPushesAgainstTheDeclaredHeading) {
  struct Declared {
    Vector3 d;
    std::int64_t until_ns;
  };
  std::size_t against_later = 0, checked = 0;
  SeededRandom random(3);
  Ship ship = Somewhere(3);
  std::vector<Declared> declared;
  ShipCommand command;
  for (int step = 0; step < kSteps; ++step) {
    // A pilot may ask for reverse; there is none.
    if (step % 40 == 0) command = {random.Uniform(-1, 3), Scaled(random.InUnitBall(), 4)};
    const std::int64_t now_ns = StepTime(step);
    declared.push_back({ship.heading(), now_ns + ship.HeadingHoldsFor()});
    const Vector3 a = AccelerationOf(ship.Step(command, now_ns, StepTime(step + 1)));
    for (std::size_t i = declared.size() > 400 ? declared.size() - 400 : 0; i < declared.size();
         ++i) {
      if (now_ns <= declared[i].until_ns) {
        ASSERT_GE(Dot(a, declared[i].d), 0) << "declared at step " << i << ", step " << step;
        ASSERT_GE(Dot(ship.heading(), declared[i].d),
                  StepTime(step + 1) <= declared[i].until_ns ? 0 : -1);
        ++checked;
      } else if (Dot(a, declared[i].d) < 0) {
        ++against_later;
      }
    }
  }
  EXPECT_GT(checked, 20000u);
  EXPECT_GT(against_later, 1000u);
}

// The worst case of α, from the greatest turn rate: in the last step that begins before the bound
// ends the engine still pushes forward; a moment later it does not.
TEST(Ship, TheHeadingEndsAtAQuarterTurn) {
  ShipLimits limits = Limits();
  limits.turn.angular_speed_max_rad_s = 10;
  Ship ship(limits, {});
  const Vector3 d = ship.heading();
  const std::int64_t holds_ns = ship.HeadingHoldsFor();
  // π/2 = ½ · 2 τ².
  EXPECT_NEAR(static_cast<double>(holds_ns) * 1e-9, std::sqrt(std::acos(-1.0) / 2), 1e-5);
  std::int64_t t_ns = 0;
  const std::int64_t step_ns = 1'000'000;
  for (; t_ns + step_ns <= holds_ns; t_ns += step_ns) {
    ship.Step({0, {0, 0, 10}}, t_ns, t_ns + step_ns);
  }
  EXPECT_GE(Dot(ship.heading(), d), 0);
  EXPECT_LE(Dot(ship.heading(), d), 0.01);
}

TEST(Ship, ThrustsAlongItsNoseUpToItsSpeed) {
  Ship ship(Limits(), {});
  double fastest = 0;
  for (int step = 0; step < 300; ++step) {
    ship.Step({1, {}}, StepTime(step), StepTime(step + 1));
    fastest = std::max(fastest, Norm(ship.state().velocity_m_s));
  }
  EXPECT_LE(fastest, 15 * (1 + 1e-12));
  EXPECT_NEAR(ship.state().velocity_m_s[0], 15, 0.01);
  EXPECT_GT(ship.state().position_m[0], 40);
  EXPECT_EQ(ship.state().position_m[1], 0);
}

// After a bounce it may be faster than its engine makes it: the engine then only helps to brake.
TEST(Ship, BeyondItsSpeedTheEngineOnlyBrakes) {
  Ship ahead(Limits(), {});
  ahead.SetVelocities({20, 0, 0}, {});
  ahead.Step({1, {}}, 0, 16'000'000);
  EXPECT_LE(ahead.state().velocity_m_s[0], 20);
  Ship back(Limits(), {});
  back.SetVelocities({-20, 0, 0}, {0, 0, 99});
  EXPECT_LE(Norm(back.state().angular_velocity_rad_s), 2 * (1 + 1e-15));
  back.Step({1, {}}, 0, 16'000'000);
  EXPECT_GT(back.state().velocity_m_s[0], -20 + 0.09);
}

}  // namespace
}  // namespace collision::client
