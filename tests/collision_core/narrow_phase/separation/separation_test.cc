// Goal:   the bracket contains the true distance at every budget, only narrows with more of it, and
//         closes where the two are apart; containment is decided correctly.
// Method: random poses of convex, hollow, open and spiky surfaces of sizes from 1e-6 to 1e6 m,
//         against brute force over all pairs of triangles in long double.
#include "collision_core/narrow_phase/separation/separation.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/separation/containment.h"
#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

SeparationBracket LookOf(const Posed& a, const Posed& b, Goal goal, WorkBudget* work) {
  const BodySegment of_a = a.Segment(), of_b = b.Segment();
  return QuerySeparation({BodyTree(of_a), BodyTree(of_b), PoseAt(of_a, of_b, {0, 0, true}, 0)},
                         goal, work);
}

TEST(Separation, BracketContainsTheTrueDistanceAtEveryBudget) {
  int apart = 0, deep = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(1e-6, 1e6);
    const Posed a = RandomBody(random, size, Vector::Zero());
    const double other = std::clamp(size * random.LogUniform(1e-2, 1e2), 1e-6, 1e6);
    const Posed b =
        RandomBody(random, other, (size + other) * random.Uniform(0, 2) * RandomUnit(random));
    if (!a.shape && !b.shape) continue;
    const TrueBody body_a = a.Body(), body_b = b.Body();
    const Real surfaces = SurfaceDistance(body_a, body_b);
    const Real tolerance = 1e-16L * (a.radius + b.radius);
    double lower = -numeric::kInfinity, upper = numeric::kInfinity;
    for (std::uint64_t units = 0; units < 3000000; units = 4 * units + 50) {
      WorkBudget work(units);
      const SeparationBracket bracket = LookOf(a, b, Goal::kDecision, &work);
      if (bracket.upper > 0) {
        EXPECT_LE(bracket.lower, surfaces + tolerance);
      }
      EXPECT_GE(std::max(0.0, bracket.upper), SolidDistance(body_a, body_b) - tolerance);
      EXPECT_GE(bracket.lower, lower);
      EXPECT_LE(bracket.upper, upper);
      if (bracket.upper <= 0) {
        ++deep;
        const Vector by = (-bracket.upper * 0.999L) * RandomUnit(random);
        EXPECT_EQ(SolidDistance(body_a, body_b.Moved(by)), 0);
      }
      lower = bracket.lower, upper = bracket.upper;
      if (!bracket.exhausted) break;
    }
    WorkBudget unlimited(100000000);
    const SeparationBracket nearest = LookOf(a, b, Goal::kNearest, &unlimited);
    // If one is inside the other, `upper` is about the solids.
    if (nearest.lower <= 0 || SolidDistance(body_a, body_b) == 0) continue;
    ++apart;
    const auto distance = static_cast<double>(surfaces);
    const auto width_max =
        static_cast<double>(1e-9 * surfaces + 1e-13 * (a.radius + b.radius + b.pose.p.norm()));
    EXPECT_LE(nearest.upper - nearest.lower, width_max);
    EXPECT_NEAR(distance, nearest.upper, width_max);
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(deep, 20);
}

// Each body turned about its reference point, so that its points move by up to the chord.
TEST(Separation, TurningIsCountedInAtEveryBudget) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Posed a = RandomBody(random, 1, Vector::Zero());
    Posed b = RandomBody(random, 1, random.Uniform(1, 4) * RandomUnit(random));
    const BodySegment of_a = a.Segment(), of_b = b.Segment();
    RelativePose pose = PoseAt(of_a, of_b, {0, 0, true}, 0);
    const double angle_A = a.shape ? random.Uniform(0, 0.5) : 0;
    const double angle_B = b.shape ? random.Uniform(0, 0.5) : 0;
    pose.chord_A = 2 * std::sin(angle_A / 2) + 1e-15;
    pose.chord_B = 2 * std::sin(angle_B / 2) + 1e-15;
    std::vector<Real> distances;
    for (int i = 0; i < 20; ++i) {
      Posed turned_a = a, turned_b = b;
      turned_a.pose.q = Exponential(angle_A * RandomUnit(random)) * a.pose.q;
      turned_b.pose.q = Exponential(angle_B * RandomUnit(random)) * b.pose.q;
      distances.push_back(SolidDistance(turned_a.Body(), turned_b.Body()));
    }
    for (const std::uint64_t units : {0, 10, 30, 100, 1000, 1000000}) {
      WorkBudget work(units);
      const SeparationBracket bracket =
          QuerySeparation({BodyTree(of_a), BodyTree(of_b), pose}, Goal::kDecision, &work);
      for (const Real distance : distances) {
        if (bracket.upper > 0 && distance > 0) {
          EXPECT_LE(bracket.lower, distance + 1e-15L) << units;
        }
        EXPECT_GE(std::max(0.0, bracket.upper), distance - 1e-15L) << units;
      }
    }
  }
}

TEST(Separation, SameLookSameBits) {
  Random random(9);
  const Posed a = RandomBody(random, 1, Vector::Zero()),
              b = RandomBody(random, 1, Vector(2.5L, 0.1L, 0));
  WorkBudget once(1000), twice(1000);
  const SeparationBracket x = LookOf(a, b, Goal::kNearest, &once),
                          y = LookOf(a, b, Goal::kNearest, &twice);
  EXPECT_EQ(x.lower, y.lower);
  EXPECT_EQ(x.upper, y.upper);
  EXPECT_EQ(x.point, y.point);
  EXPECT_EQ(once.spent(), twice.spent());
}

TEST(WorkShare, LeavesTheRestForWhatComesAfter) {
  WorkBudget work(1000);
  work.Spend(200);
  {
    const WorkShare share(0.5, &work);
    EXPECT_EQ(work.left(), 400u);
    work.Spend(500);
    EXPECT_TRUE(work.exhausted());
  }
  EXPECT_FALSE(work.exhausted());
  EXPECT_EQ(work.left(), 300u);
}

Containment TestContainment(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b,
                            const Vector& p, bool swapped) {
  Posed of_a, of_b;
  of_a.shape = shape::Shape::Build(swapped ? b : a);
  of_b.shape = shape::Shape::Build(swapped ? a : b);
  of_b.pose.p = swapped ? Vector(-p) : p;
  const BodySegment x = of_a.Segment(), y = of_b.Segment();
  WorkBudget work(1000000);
  return collision::narrow_phase::TestContainment(
      {BodyTree(x), BodyTree(y), PoseAt(x, y, {0, 0, true}, 0)}, &work);
}

TEST(Separation, WhatIsInsideWhat) {
  const geometry::TriangleMesh small = Cube(0.1);
  for (const bool swapped : {false, true}) {
    EXPECT_TRUE(TestContainment(Cube(1), small, {0.8L, 0.8L, 0.8L}, swapped).certain());
    EXPECT_TRUE(TestContainment(Cube(1), small, {1.2L, 0, 0}, swapped).neither);
    EXPECT_TRUE(TestContainment(HollowCube(1, 0.5), small, {0, 0, 0}, swapped).neither);
    EXPECT_TRUE(TestContainment(HollowCube(1, 0.5), small, {0.75L, 0, 0}, swapped).certain());
    EXPECT_TRUE(TestContainment(Frame(), small, {0, 0, 0}, swapped).neither)
        << "through the hole is outside";
    EXPECT_TRUE(TestContainment(Frame(), small, {1.5L, 0, 0}, swapped).certain());
    EXPECT_TRUE(TestContainment(Sheet(1, 2), small, {0, 0, 0.5L}, swapped).neither)
        << "open: no inside";
    // The L's box contains it, the L does not.
    EXPECT_TRUE(TestContainment(LShape(), small, {0.5L, 0.5L, 0}, swapped).neither);
    // One of several components is inside, not the first.
    const geometry::TriangleMesh two = Joined(Moved(small, {30, 0, 0}), small);
    EXPECT_TRUE(TestContainment(Cube(1), two, {0, 0, 0}, swapped).certain());
    EXPECT_FALSE(TestContainment(Cube(1), two, {0, 0, 0}, swapped).neither);
    EXPECT_TRUE(TestContainment(Cube(1), two, {0, 5, 0}, swapped).neither);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
