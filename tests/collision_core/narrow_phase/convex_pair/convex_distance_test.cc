#include "collision_core/narrow_phase/convex_pair/convex_distance.h"

#include <gtest/gtest.h>

#include "tests/collision_core/narrow_phase/convex_cases.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The rounding floor of polytopes, as a share of the pair's size.
constexpr double kFloor = 2.5e-14;

// Goal:   the distance of boxes, capsules, balls and hulls is contained, and known to rounding,
//         from far apart to overlapping.
// Method: exact rational arithmetic; any rotations; like and unlike sizes from 1e-6 to 1e7 m.
TEST(ConvexDistance, RandomPolytopes) {
  Random random(301);
  for (int i = 0; i < 700; ++i) {
    const double size = i % 2 ? 1 : random.LogUniform(1e-5, 1e6);
    const double other = i % 2 ? 1 : std::clamp(size * random.LogUniform(1e-3, 1e3), 1e-5, 1e6);
    ConvexCase c(RandomPolytope(random, size), RandomPolytope(random, other));
    c.Turn(RandomQuaternion(random),
           random.Uniform(0, 3) * std::max(size, other) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.Check(kFloor)) << i;
  }
}

// Goal:   whatever coincides (corners, edges, faces) or degenerates (to polygons, segments,
//         points), the distance is contained and known to rounding.
// Method: measures and places of small whole numbers, turned by rotations that are exact in doubles
//         or by 3-4-5 ones.
TEST(ConvexDistance, LatticePolytopes) {
  Random random(302);
  const Quaterniond turns[] = {
      {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 1}, {2, 1, 0, 0}, {3, 0, 1, 0}};
  for (int i = 0; i < 2000; ++i) {
    shape::ConvexDescription a = LatticePolytope(random), b = LatticePolytope(random);
    a.q_BS = turns[random.Below(5)];
    b.q_BS = turns[random.Below(5)];
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0},
           Vector3d(static_cast<double>(random.Below(7)), static_cast<double>(random.Below(3)), 0));
    ASSERT_NO_FATAL_FAILURE(c.Check(kFloor)) << i;
  }
}

// Goal:   short gaps and shallow overlaps keep their relative error: the direction comes from edges
//         and faces, not from the difference of two near points.
// Method: random polytopes, moved along their shortest way until they are a given gap apart.
TEST(ConvexDistance, NearlyTouching) {
  Random random(303);
  for (int i = 0; i < 600; ++i) {
    ConvexCase c(RandomPolytope(random, 1), RandomPolytope(random, 1));
    c.Turn(RandomQuaternion(random), 5 * random.UnitVector());
    const double gap = (i % 3 == 0 ? -1 : 1) * random.LogUniform(1e-13, 1e-3);
    c.MoveTo(gap);
    ASSERT_NO_FATAL_FAILURE(c.Check(kFloor)) << i;
    if (gap > 0) {
      EXPECT_NEAR(c.Ask().separation.middle(), gap, 1e-14 + 0.1 * gap) << i;
    }
  }
}

// Goal:   the depth of deep overlaps is contained from both sides and known to rounding.
// Method: all faces of the difference in rational arithmetic; boxes, segments and small hulls.
TEST(ConvexDistance, DepthOfBoxesAndSegments) {
  Random random(304);
  for (int i = 0; i < 150; ++i) {
    const double size = i % 2 ? 1 : random.LogUniform(1e-4, 1e6);
    shape::ConvexDescription a = RandomBox(random, size), b = RandomBox(random, size);
    if (i % 4 == 1) b.core = geometry::ConvexCore::kSegment;
    if (i % 4 == 2) a.rounding = 0.2 * size;
    ConvexCase c(a, b);
    c.Turn(RandomQuaternion(random), random.Uniform(0, 1) * size * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.CheckDepth(kFloor)) << i;
  }
}

TEST(ConvexDistance, DepthOfHulls) {
  Random random(305);
  for (int i = 0; i < 30; ++i) {
    ConvexCase c(RandomHull(random, 1, 5), RandomHull(random, 1, 5));
    c.Turn(RandomQuaternion(random), random.Uniform(0, 0.5) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.CheckDepth(kFloor)) << i;
  }
}

// Goal:   boxes whose faces, edges and corners lie in planes of each other, deep in each other,
//         have a proper depth too.
TEST(ConvexDistance, DepthOfLatticeBoxes) {
  Random random(306);
  for (int i = 0; i < 400; ++i) {
    shape::ConvexDescription a, b;
    for (shape::ConvexDescription* d : {&a, &b}) {
      d->core = geometry::ConvexCore::kBox;
      for (int axis = 0; axis < 3; ++axis) d->half[axis] = 1 + static_cast<double>(random.Below(3));
    }
    if (i % 2) b.q_BS = Quaterniond(2, 1, 0, 0);
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0},
           Vector3d(static_cast<double>(random.Below(3)), static_cast<double>(random.Below(2)), 0));
    ASSERT_NO_FATAL_FAILURE(c.CheckDepth(kFloor)) << i;
  }
}

// Goal:   identical solids in one place, and one well inside the other, have closed answers.
TEST(ConvexDistance, ClosedAnswersOfOverlap) {
  shape::ConvexDescription cube;
  cube.core = geometry::ConvexCore::kBox;
  cube.half = {1, 2, 3};
  shape::ConvexDescription ball;
  ball.rounding = 0.25;
  shape::ConvexDescription capsule = ball;
  capsule.core = geometry::ConvexCore::kSegment;
  capsule.half.z() = 0.5;
  shape::ConvexDescription round;
  round.core = geometry::ConvexCore::kEllipsoid;
  round.half = {1, 1, 1};
  const struct {
    shape::ConvexDescription a, b;
    Vector3d offset;
    double separation;
  } cases[] = {
      {cube, cube, {0, 0, 0}, -2},
      {cube, ball, {0, 0, 0}, -1.25},
      {ball, ball, {0, 0, 0}, -0.5},
      {capsule, capsule, {0, 0, 0}, -0.5},
      {cube, capsule, {0, 0, 0}, -1.25},
      {cube, capsule, {0.5, 0, 0}, -0.75},
      {cube, cube, {2, 0, 0}, 0},
      {cube, cube, {3, 0, 0}, 1},
      {cube, cube, {4, 5, 6}, std::sqrt(4 + 1)},
      {capsule, capsule, {0.5, 0, 0.25}, 0},
      {round, ball, {1.5, 0, 0}, 0.25},
      {capsule, ball, {0, 3, 4.5}, 4.5},
  };
  for (const auto& expected : cases) {
    for (const double far : {0.0, 1e7}) {
      shape::ConvexDescription a = expected.a, b = expected.b;
      a.p_BS.x() = far;
      b.p_BS.x() = far;
      ConvexCase c(a, b);
      c.Turn({1, 0, 0, 0}, expected.offset);
      const numeric::Interval found = c.Ask().separation;
      EXPECT_TRUE(found.lower <= expected.separation && expected.separation <= found.upper)
          << found.lower << " " << found.upper << " " << expected.separation;
      EXPECT_LT(found.width(), 1e-12 + far * 1e-14);
    }
  }
}

// Goal:   needles, plates and slivers never give a wrong answer, and keep the rounding floor.
// Method: measures that differ by up to a million, in any pose; exact arithmetic.
TEST(ConvexDistance, Needles) {
  Random random(307);
  for (int i = 0; i < 250; ++i) {
    shape::ConvexDescription a = RandomBox(random, 1), b = RandomBox(random, 1);
    for (shape::ConvexDescription* d : {&a, &b}) {
      for (int axis = 0; axis < 3; ++axis) {
        if (random.Chance(0.5)) d->half[axis] *= random.LogUniform(1e-6, 1);
      }
    }
    ConvexCase c(a, b);
    c.Turn(RandomQuaternion(random), random.Uniform(0, 3) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.Check(kFloor)) << i;
  }
}

// Goal:   boxes that are parallel but for rounding, whose edges have no common normal that doubles
//         could tell, are known as well as others, deep in each other and apart.
// Method: turned by 1e-17 to 1e-3 about any axis; exact arithmetic.
TEST(ConvexDistance, NearlyParallelBoxes) {
  Random random(309);
  for (int i = 0; i < 150; ++i) {
    shape::ConvexDescription a = RandomBox(random, 1), b = RandomBox(random, 1);
    a.q_BS = b.q_BS = {1, 0, 0, 0};
    b.q_BS.vec() = random.LogUniform(1e-17, 1e-3) * random.UnitVector();
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0}, random.Uniform(0, 2) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.CheckDepth(kFloor)) << i;
  }
}

// Goal:   hulls of whatever points: doubles, points inside, nearly flat, nearly on a line, on a
//         lattice.
TEST(ConvexDistance, DirtyHulls) {
  Random random(310);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription d[2];
    for (shape::ConvexDescription& hull : d) {
      hull = RandomHull(random, 1, 3 + random.Below(10));
      Vector3d flat(1, 1, 1);
      if (random.Chance(0.5)) flat.z() = random.Chance(0.5) ? 0 : random.LogUniform(1e-17, 1e-3);
      if (random.Chance(0.3)) flat.y() = random.Chance(0.5) ? 0 : random.LogUniform(1e-17, 1e-3);
      for (Vector3d& p : hull.points) {
        p = flat.cwiseProduct(p);
        if (random.Chance(0.2)) p = hull.points[0];
        if (random.Chance(0.2)) p *= random.Uniform(0, 1);
      }
    }
    if (RefusalOf(d[0]) || RefusalOf(d[1])) continue;
    ConvexCase c(d[0], d[1]);
    c.Turn(RandomQuaternion(random), random.Uniform(0, 2) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(c.Check(kFloor)) << i;
  }
}

// Goal:   a triangle of a mesh against a solid: as any hull of three points, needles and flat ones
//         too.
TEST(ConvexDistance, TrianglesAgainstSolids) {
  Random random(316);
  for (int i = 0; i < 300; ++i) {
    const shape::ConvexDescription d = RandomPolytope(random, 1);
    const shape::ConvexSolid solid = shape::ConvexSolid::Build(d);
    std::array<Vector3d, 3> corners;
    for (Vector3d& corner : corners) corner = random.Uniform(0, 3) * random.UnitVector();
    if (i % 5 == 0) corners[2] = corners[0] + random.LogUniform(1e-17, 1) * random.UnitVector();
    if (i % 7 == 0) corners[1] = corners[0];
    WorkBudget work(1000000);
    geometry::GjkHint hint;
    const numeric::Interval found =
        SeparationOf(geometry::TriangleSet(corners), solid.set(), {}, &hint, &work).separation;
    const ExactPoints exact = {ExactVector(corners[0]), ExactVector(corners[1]),
                               ExactVector(corners[2])};
    const Exact square = Square(NearestToZero(Difference(exact, ExactCorners(d))));
    EXPECT_TRUE(IsAtMost(found.lower, square, Exact(d.rounding))) << i;
    if (square > 0 || found.upper >= 0) {
      EXPECT_TRUE(IsAtLeast(found.upper, square, Exact(d.rounding))) << i;
    }
    EXPECT_LT(found.width(), i % 5 == 0 ? 1e-10 : 10 * kFloor) << i;
  }
}

// Goal:   rounding is counted where nothing else hides it: sets that are exactly what they say.
// Method: hulls and boxes that are not turned and not posed, with numbers that round; a short way
//         apart, so that the errors of products and sums are what decides.
TEST(ConvexDistance, ExactSets) {
  Random random(317);
  for (int i = 0; i < 400; ++i) {
    shape::ConvexDescription a = RandomBox(random, 1), b = RandomHull(random, 1, 6);
    a.q_BS = b.q_BS = {1, 0, 0, 0};
    for (int step = 0; step < 3; ++step) {
      const shape::ConvexSolid solid_a = shape::ConvexSolid::Build(a),
                               solid_b = shape::ConvexSolid::Build(b);
      WorkBudget work(1000000);
      geometry::GjkHint hint;
      const ConvexSeparation found = SeparationOf(solid_a.set(), solid_b.set(), {}, &hint, &work);
      const Exact square = Square(NearestToZero(Difference(ExactCorners(a), ExactCorners(b))));
      ASSERT_TRUE(IsAtMost(found.separation.lower, square, 0)) << i;
      ASSERT_TRUE(square == 0 || IsAtLeast(found.separation.upper, square, 0)) << i;
      const double further = (i % 2 ? 1e-12 : 1e-6) - found.separation.middle();
      if (std::abs(further) > 1) break;
      for (Vector3d& p : b.points) p += further * found.normal;
    }
  }
}

// Goal:   far from the reference points only what the placement itself rounds is lost.
// Method: both solids 1e7 m from the bodies' origins: 2^-53 of that, a few times.
TEST(ConvexDistance, FarFromTheOrigin) {
  Random random(308);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription a = RandomPolytope(random, 1), b = RandomPolytope(random, 1);
    const Vector3d far = 1e7 * random.UnitVector();
    a.p_BS = far;
    b.p_BS = far + random.Uniform(0, 4) * random.UnitVector();
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0}, {0, 0, 0});
    ASSERT_NO_FATAL_FAILURE(c.Contained()) << i;
    EXPECT_LT(c.Ask().separation.width(), 1e7 * 2e-14);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
