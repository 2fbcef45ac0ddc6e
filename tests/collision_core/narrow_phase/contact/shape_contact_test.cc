// Goal:   times, points and directions of contacts between shapes are right and narrow, and what is
//         too short to see between two states is seen.
// Method: motions whose contacts are known in closed form, without uncertainty; then with it,
//         as between two states of a simulator.
#include "collision_core/narrow_phase/contact/shape_contact.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/truth/true_motion.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

struct Body {
  std::shared_ptr<const shape::Shape> shape;
  Vector3d p, v = Vector3d::Zero(), w = Vector3d::Zero();
  Vector turned = Vector::Zero();  // rotation vector at the start
  double radius = 0;               // of a ball
  double acceleration_max = 0, angular_acceleration_max = 0;

  // The forward bound at 0; with `both` also the backward one at the end.
  BodySegment Over(double duration, bool both = false) const {
    TrueMotion motion;
    motion.start.p = p.cast<Real>();
    motion.start.v = v.cast<Real>();
    motion.start.w = w.cast<Real>();
    motion.start.q = Exponential(turned);
    motion::MotionLimits limits;
    limits.radius = shape ? shape->facts().radius : radius;
    limits.acceleration_max = acceleration_max;
    limits.angular_acceleration_max = angular_acceleration_max;
    BodySegment segment;
    segment.ball.radius = limits.radius;
    segment.shape = shape;
    const Instant base = Instant::FromNanoseconds(0);
    for (const bool at_end : {false, true}) {
      if (at_end && !both) continue;
      const motion::SpaceTimeBound bound = BoundAt(motion, at_end ? duration : 0, limits);
      segment.ball.bounds.push_back(at_end ? BackwardBall(bound, base) : ForwardBall(bound, base));
      if (shape)
        segment.turns.push_back(at_end ? BackwardRotation(bound, base)
                                       : ForwardRotation(bound, base));
    }
    return segment;
  }
};

ShapeSegmentResult Verdict(const Body& a, const Body& b, double duration,
                           std::uint64_t units = 1000000, bool both = false) {
  const BodySegment of_a = a.Over(duration, both), of_b = b.Over(duration, both);
  WorkBudget work(units);
  return EvaluateShapeSegment(of_a, of_b, duration,
                              EvaluateBallSegment(of_a.ball, of_b.ball, duration), &work);
}

// Apart before `begin` and after `end`, together between, each known to within `width`.
void ExpectContact(const SegmentResult& times, double begin, double end, double width) {
  constexpr double kRounding = 1e-12;
  EXPECT_LE(times.free_until, begin + kRounding);
  EXPECT_GE(times.free_until, begin - width);
  EXPECT_GE(times.contact_from, begin - kRounding);
  EXPECT_LE(times.contact_from, begin + width);
  EXPECT_LE(times.contact_to, end + kRounding);
  EXPECT_GE(times.contact_to, end - width);
  EXPECT_GE(times.free_from, end - kRounding);
  EXPECT_LE(times.free_from, end + width);
  EXPECT_TRUE(times.contact_continuous);
}

TEST(ShapeContact, BoxesHeadOn) {
  const auto cube = shape::Shape::Build(Cube(1));
  const ShapeSegmentResult verdict =
      Verdict({cube, {0, 0, 0}}, {cube, {5, 0.3, 0.2}, {-2, 0, 0}}, 4);
  ExpectContact(verdict.times, 1.5, 3.5, 5e-5);
  ASSERT_TRUE(verdict.normal.known);
  EXPECT_LT(verdict.normal.error, 0.01);
  EXPECT_LE((verdict.normal.normal - Vector3d(1, 0, 0)).norm(), verdict.normal.error);
}

TEST(ShapeContact, EdgeMeetsEdge) {
  const auto cube = shape::Shape::Build(Cube(1));
  Body a{cube, {0, 0, 0}}, b{cube, {5, 0.1, 0.2}, {-2, 0, 0}};
  a.turned = {0, kPi / 4, 0};
  b.turned = {0, 0, kPi / 4};
  const double root = std::sqrt(2.0);
  // Edges along y at x = √2 and along z at x = −√2, seen from the middles.
  ExpectContact(Verdict(a, b, 5).times, (5 - 2 * root) / 2, (5 + 2 * root) / 2, 5e-5);
}

// When a bar along x at the start, of half width w, turning by `rate` about z, first meets a point.
double BarMeets(double x, double y, double width, double rate) {
  return (std::atan2(y, x) - std::asin(width / std::hypot(x, y))) / rate;
}

TEST(ShapeContact, TurningBarMeetsABallAndACorner) {
  Body bar{shape::Shape::Build(Rod(5, 0.25)), {0, 0, 0}};
  bar.w = {0, 0, 0.5};
  Body ball{nullptr, {3, 2, 0}};
  ball.radius = 0.125;
  const ShapeSegmentResult of_ball = Verdict(bar, ball, 1.5);
  const double begin = BarMeets(3, 2, 0.375, 0.5);
  EXPECT_NEAR(of_ball.times.free_until, begin, 1e-4);
  EXPECT_LE(of_ball.times.free_until, begin + 1e-12);
  EXPECT_NEAR(of_ball.times.contact_from, begin, 1e-4);

  double first = 1e9;
  for (const double x : {2.875, 3.125}) {
    for (const double y : {1.875, 2.125}) first = std::min(first, BarMeets(x, y, 0.25, 0.5));
  }
  const ShapeSegmentResult of_cube =
      Verdict(bar, {shape::Shape::Build(Cube(0.125)), {3, 2, 0}}, 1.5);
  EXPECT_NEAR(of_cube.times.free_until, first, 1e-4);
  EXPECT_LE(of_cube.times.free_until, first + 1e-12);
  EXPECT_NEAR(of_cube.times.contact_from, first, 1e-4);
}

TEST(ShapeContact, ContactMuchShorterThanTheSegment) {
  const auto cube = shape::Shape::Build(Cube(0.0625));
  for (const double speed : {10.0, 100.0, 1000.0}) {
    const double middle = 0.4375;  // of the second of the segment
    const ShapeSegmentResult verdict =
        Verdict({cube, {0, 0, 0}}, {cube, {speed * middle, 0.03, 0.02}, {-speed, 0, 0}}, 1);
    ExpectContact(verdict.times, middle - 0.125 / speed, middle + 0.125 / speed, 2e-5);
  }
}

// Not head-on: the bound of the closing speed is several times the true one.
TEST(ShapeContact, ShortGrazingContact) {
  const auto rod = shape::Shape::Build(Rod(5, 0.0625));
  Body a{rod, {0, 0, 0}, {0, 0, 0}, {0, 0, 2}};
  // Its near end dips into the rod's circle for a little while, where the rod comes along.
  Body ball{nullptr, {4.5, 4.5, 0}, {0, 0, 0}};
  ball.radius = 0.125;
  const double rho = std::hypot(4.5, 4.5);
  ASSERT_GT(rho, 5);
  ball.p = {3.5, 3.5, 0};
  const double r = std::hypot(3.5, 3.5);
  const double half = std::asin(0.1875 / r);
  const ShapeSegmentResult verdict = Verdict(a, ball, 1);
  ExpectContact(verdict.times, (kPi / 4 - half) / 2, (kPi / 4 + half) / 2, 1e-4);
}

TEST(ShapeContact, RodThatNearlyTurnsAroundInOneStepIsNotMissed) {
  const double step = 1.0 / 64, rate = 350 * kPi / 180 / step;
  Body rod{shape::Shape::Build(Rod(5, 0.03125)), {0, 0, 0}, {0, 0, 0}, {0, 0, rate}};
  for (const double degrees : {5.0, 100.0, 178.0, 200.0, 340.0}) {
    Body ball{nullptr, {4 * std::cos(degrees * kPi / 180), 4 * std::sin(degrees * kPi / 180), 0}};
    ball.radius = 0.0625;
    const ShapeSegmentResult verdict = Verdict(rod, ball, step);
    const double half = std::asin(0.09375 / 4);
    double angle = degrees * kPi / 180;  // the other end comes first beyond half a turn
    if (angle > kPi) angle -= kPi;
    EXPECT_LE(verdict.times.free_until, (angle - half) / rate + 1e-12) << degrees;
    EXPECT_GE(verdict.times.free_until, (angle - half) / rate - 0.01 * step) << degrees;
    EXPECT_LE(verdict.times.contact_from, verdict.times.contact_to) << degrees;
    EXPECT_LE(verdict.times.contact_from, (angle + half) / rate) << degrees;
  }
}

TEST(ShapeContact, BallThroughARingIsFree) {
  Body ring{shape::Shape::Build(Frame()), {0, 0, 0}};
  Body ball{nullptr, {0, 0, 4}, {0, 0, -8}};
  for (const double radius : {0.5, 0.9, 0.99}) {
    ball.radius = radius;
    const ShapeSegmentResult verdict = Verdict(ring, ball, 1);
    EXPECT_EQ(verdict.times.free_until, numeric::kInfinity) << radius;
    EXPECT_EQ(verdict.times.free_from, -numeric::kInfinity) << radius;
  }
  ball.radius = 1.0625;
  // It meets the rim, 1 from the axis, where √(1.0625² − 1) of it is below its middle.
  const double below = std::sqrt(1.0625 * 1.0625 - 1);
  ExpectContact(Verdict(ring, ball, 1).times, (3 - below) / 8, (5 + below) / 8, 5e-5);
}

TEST(ShapeContact, SpikeThroughASheet) {
  geometry::TriangleMesh spike;
  spike.vertices = {{0, 0, -1}, {0.3, 0, 1}, {-0.2, 0.3, 1}, {-0.2, -0.3, 1}};
  spike.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const Body sheet{shape::Shape::Build(Sheet(2, 3)), {0, 0, 0}};
  const ShapeSegmentResult verdict =
      Verdict(sheet, {shape::Shape::Build(spike), {0.1, 0.2, 3}, {0, 0, -4}}, 1.5);
  ExpectContact(verdict.times, 0.5, 1, 1e-3);
  ASSERT_TRUE(verdict.examined);
  EXPECT_LE(verdict.nearest.separation.upper, 0);
  EXPECT_LT(verdict.nearest.point_error, 1);
}

// A state 60 times a second, 1 m/s² each.
TEST(ShapeContact, DirectionIsKnownBetweenStates) {
  const double step = 1.0 / 64;
  Body a{shape::Shape::Build(LShape()), {0, 0, 0}},
      b{shape::Shape::Build(Cube(0.5)), {1.52, -0.5, 0.1}, {-3, 0, 0}};
  a.acceleration_max = b.acceleration_max = 1;
  a.angular_acceleration_max = b.angular_acceleration_max = 0.5;
  for (const bool both : {false, true}) {
    const ShapeSegmentResult verdict = Verdict(a, b, step, 10000, both);
    EXPECT_LE(verdict.times.contact_from, verdict.times.contact_to) << both;
    EXPECT_NEAR(verdict.times.contact_from, 0.02 / 3, 2e-4) << both;
    ASSERT_TRUE(verdict.normal.known) << both;
    EXPECT_LT(verdict.normal.error, 0.2) << both;
    EXPECT_LE((verdict.normal.normal - Vector3d(1, 0, 0)).norm(), verdict.normal.error) << both;
  }
}

// In the notch of the L a ball comes near both walls at once, or one of them first.
TEST(ShapeContact, DirectionsThatMayBothBeTheShortestAreBothCovered) {
  Body notch{shape::Shape::Build(LShape()), {0, 0, 0}}, ball{nullptr, {0.5, 0.5, 0}, {-1, -1, 0}};
  ball.radius = 0.25;
  for (const double off : {0.0, 0.0625}) {
    notch.acceleration_max = ball.acceleration_max = off == 0 ? 1 : 0.01;
    ball.p = {0.5 + off, 0.5, 0};
    const ShapeSegmentResult verdict = Verdict(notch, ball, 0.5, 1000000);
    ASSERT_TRUE(verdict.normal.known) << off;
    const auto angle_to = [&](const Vector3d& wall) {
      return std::acos(std::clamp(verdict.normal.normal.dot(wall), -1.0, 1.0));
    };
    // From the L to the ball: the wall below is met first where the ball is off to the right.
    EXPECT_LE(angle_to({0, 1, 0}), verdict.normal.error) << off;
    if (off == 0) {
      EXPECT_LE(angle_to({1, 0, 0}), verdict.normal.error) << off;
    }
    if (off > 0) {
      EXPECT_LT(verdict.normal.error, 0.2);
    }
  }
}

// Certainly inside although no surface is near: contact from the start.
TEST(ShapeContact, InsideTheOther) {
  const Body big{shape::Shape::Build(Cube(4)), {0, 0, 0}};
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(3, 3, 3), Vector3d(-3.4, 2, 1)}) {
    const Body small{shape::Shape::Build(LShape()), p * 0.8, {0.01, 0, 0}};
    for (const bool swapped : {false, true}) {
      const ShapeSegmentResult verdict = swapped ? Verdict(small, big, 1) : Verdict(big, small, 1);
      EXPECT_EQ(verdict.times.contact_from, 0) << p.transpose();
      EXPECT_EQ(verdict.times.contact_to, 1) << p.transpose();
      EXPECT_LE(verdict.times.free_until, 0);
      EXPECT_GT(verdict.nearest.depth_lower, 0.2);
    }
  }
  // In a hole it is free.
  const Body hollow{shape::Shape::Build(HollowCube(4, 3)), {0, 0, 0}};
  EXPECT_EQ(
      Verdict(hollow, {shape::Shape::Build(LShape()), {0, 0, 0}, {0.5, 0, 0}}, 1).times.free_until,
      numeric::kInfinity);
}

TEST(ShapeContact, SpentBudgetSaysSoAndClaimsNothingWrong) {
  const auto star = [] {
    Random random(5);
    return shape::Shape::Build(Star(2, random));
  }();
  const Body a{star, {0, 0, 0}, {0, 0, 0}, {0.1, 0.2, 0.3}},
      b{star, {4, 0.1, 0.2}, {-2, 0, 0}, {0, 0.3, 0.1}};
  const ShapeSegmentResult best = Verdict(a, b, 3, 100000000);
  ASSERT_LE(best.times.contact_from, best.times.contact_to);
  bool some = false;
  for (std::uint64_t units = 0; units < 300000; units = units * 5 / 4 + 1) {
    const ShapeSegmentResult verdict = Verdict(a, b, 3, units);
    EXPECT_LE(verdict.times.free_until, best.times.contact_from) << units;
    EXPECT_GE(verdict.times.free_from, best.times.contact_to) << units;
    if (verdict.times.contact_from <= verdict.times.contact_to) {
      EXPECT_GE(verdict.times.contact_from, best.times.free_until) << units;
      EXPECT_LE(verdict.times.contact_to, best.times.free_from) << units;
    } else {
      ASSERT_TRUE(verdict.examined);
      EXPECT_EQ(verdict.nearest.limited_by, BracketLimit::kBudget) << units;
      some = true;
    }
  }
  EXPECT_TRUE(some);
}

TEST(ShapeContact, AnInstantCanBeJudged) {
  const auto cube = shape::Shape::Build(Cube(1));
  const ShapeSegmentResult apart = Verdict({cube, {0, 0, 0}}, {cube, {2.01, 1, 0}}, 0);
  EXPECT_EQ(apart.times.free_until, numeric::kInfinity);
  const ShapeSegmentResult together = Verdict({cube, {0, 0, 0}}, {cube, {1.9, 1, 0}}, 0);
  EXPECT_LT(together.times.free_until, 0);
  EXPECT_LE(together.times.contact_from, together.times.contact_to);
}

}  // namespace
}  // namespace collision::narrow_phase
