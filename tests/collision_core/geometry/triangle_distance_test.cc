#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "collision_core/geometry/triangle/triangle_pair.h"
#include "tests/support/random_points.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// S_a + S_b: the greatest coordinates, seen from the first corner.
double SizeOf(const TrianglePoints& a, const TrianglePoints& b) {
  double size_a = 0, size_b = 0;
  for (int i = 0; i < 3; ++i) {
    size_a = std::max(size_a, (a[i] - a[0]).cwiseAbs().maxCoeff());
    size_b = std::max(size_b, (b[i] - a[0]).cwiseAbs().maxCoeff());
  }
  return size_a + size_b;
}

void ExpectContains(const numeric::Interval& distance, const Exact& square) {
  ASSERT_GE(distance.lower, 0);
  ASSERT_LE(Exact(distance.lower) * Exact(distance.lower), square) << distance.lower;
  if (distance.upper < numeric::kInfinity) {
    ASSERT_GE(Exact(distance.upper) * Exact(distance.upper), square) << distance.upper;
  }
}

/// Contained, and no wider than `width` of the size.
void Check(const TrianglePoints& a, const TrianglePoints& b, double width) {
  const TriangleDistance found = DistanceOf(a, b);
  ExpectContains(found.distance, SquareOfTriangles(Exactly(a), Exactly(b)));
  ASSERT_LE(found.distance.width(), width * SizeOf(a, b)) << found.distance.lower;
}

/// Small whole numbers: parallel edges, shared corners, coplanar and degenerate triangles abound,
/// and squares of distances are often whole.
TrianglePoints LatticeTriangle(Random& random, int cells) {
  TrianglePoints t;
  for (Vector3d& corner : t) {
    for (int axis = 0; axis < 3; ++axis) {
      corner[axis] = static_cast<double>(random.Below(2 * cells + 1)) - cells;
    }
  }
  return t;
}

constexpr double kTight = 1e-14;

// Goal:   the distance is contained, and known to rounding, from far apart to crossing.
// Method: exact rational arithmetic; random triangles of like and unlike sizes.
TEST(TriangleDistance, RandomTriangles) {
  Random random(201);
  for (int i = 0; i < 2000; ++i) {
    const double size = i % 2 ? 1 : random.LogUniform(1e-9, 1e9);
    const double other = i % 2 ? 1 : size * random.LogUniform(1e-6, 1e6);
    const Vector3d offset = random.Uniform(0, 3) * std::max(size, other) * random.UnitVector();
    ASSERT_NO_FATAL_FAILURE(Check(RandomTriangle(random, Vector3d::Zero(), size),
                                  RandomTriangle(random, offset, other), kTight));
  }
}

// Goal:   whatever coincides (corners, edges, planes) or degenerates (to segments and points), the
//         distance is contained and known to rounding.
TEST(TriangleDistance, LatticeTriangles) {
  Random random(202);
  for (int i = 0; i < 4000; ++i) {
    const TrianglePoints a = LatticeTriangle(random, 1 + i % 4);
    TrianglePoints b = LatticeTriangle(random, 1 + i % 4);
    for (Vector3d& corner : b) corner.x() += static_cast<double>(i % 3);
    ASSERT_NO_FATAL_FAILURE(Check(a, b, kTight));
  }
}

// Goal:   short distances keep their relative error: the direction comes from edges and faces, not
//         from the difference of two near points.
// Method: one triangle over the other at a height from 1e-12 to 1e-3 of its size: a corner over a
//         face, an edge over an edge, a face over a face, each turned at random.
TEST(TriangleDistance, NearlyTouching) {
  Random random(203);
  for (int i = 0; i < 1500; ++i) {
    const Vector3d x = random.UnitVector(), y = x.cross(random.UnitVector()).normalized();
    const Vector3d z = x.cross(y);
    const double height = random.LogUniform(1e-12, 1e-3);
    const TrianglePoints a = {2 * x, 2 * y, -2 * x - 2 * y};
    const Vector3d low = height * z + random.Uniform(-0.2, 0.2) * x;
    const double up = i % 3 == 0 ? random.Uniform(0.1, 1) : 0;
    TrianglePoints b = {low, low + 0.3 * x + up * z, low + 0.3 * y + up * z};
    if (i % 3 == 1) b = {x + y - z + low, x + y + z + low, 5 * x + 5 * y + low};
    ASSERT_NO_FATAL_FAILURE(Check(a, b, kTight));
    if (i % 3 != 1) {
      EXPECT_NEAR(DistanceOf(a, b).distance.lower, height, 1e-14);
    }
  }
}

// Goal:   far from the origin only the input's own rounding is lost.
// Method: the same at 1e12, corners on the grid of doubles there.
TEST(TriangleDistance, FarFromTheOrigin) {
  Random random(204);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d far = 1e12 * random.UnitVector();
    const double size = random.LogUniform(1e-3, 1e3);
    const Vector3d near = far + random.Uniform(0, 3) * size * random.UnitVector();
    ASSERT_NO_FATAL_FAILURE(
        Check(RandomTriangle(random, far, size), RandomTriangle(random, near, size), kTight));
  }
}

// Goal:   slivers and needles never give a wrong answer, and seldom a wide one.
// Method: third corners within 1e-16 to 1e-4 of the edge; edges nearly parallel.
TEST(TriangleDistance, Slivers) {
  Random random(205);
  int wide = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vector3d along = random.UnitVector();
    const auto sliver = [&](const Vector3d& start) {
      const Vector3d edge = along + random.LogUniform(1e-16, 1) * random.UnitVector();
      const Vector3d off = random.LogUniform(1e-16, 1e-4) * random.UnitVector();
      return TrianglePoints{start, start + edge, start + random.Uniform(0, 1) * edge + off};
    };
    const TrianglePoints a = sliver(Vector3d::Zero());
    const TrianglePoints b = sliver(random.LogUniform(1e-16, 1) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(Check(a, b, 1));
    if (DistanceOf(a, b).distance.width() > 1e-9) ++wide;
  }
  EXPECT_LE(wide, 15);
}

// Goal:   known answers: 2-3-6 apart is 7; a crossing is 0; the witnesses lie that far apart.
TEST(TriangleDistance, KnownAnswers) {
  const TrianglePoints a = {Vector3d(0, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)};
  const TrianglePoints b = {Vector3d(2, 3, 6), Vector3d(3, 3, 6), Vector3d(2, 4, 7)};
  TriangleDistance found = DistanceOf(a, b);
  EXPECT_TRUE(found.distance.Contains(7));
  EXPECT_LE(found.distance.width(), 1e-13);
  EXPECT_EQ(found.a, Vector3d(0, 0, 0));
  EXPECT_EQ(found.b, Vector3d(2, 3, 6));

  const TrianglePoints c = {Vector3d(-0.2, -0.2, -1), Vector3d(-0.2, -0.2, 1), Vector3d(5, 5, 0)};
  found = DistanceOf(a, c);
  EXPECT_EQ(found.distance.lower, 0);
  EXPECT_LE(found.distance.upper, 1e-13);
  EXPECT_LE((found.a - found.b).norm(), 1e-13);
}

// Goal:   the witnesses lie on their triangles and as far apart as the upper end says, but for
//         rounding.
TEST(TriangleDistance, Witnesses) {
  Random random(206);
  for (int i = 0; i < 2000; ++i) {
    const TrianglePoints a = RandomTriangle(random, Vector3d::Zero(), 1);
    const TrianglePoints b = RandomTriangle(random, random.Uniform(0, 3) * random.UnitVector(), 1);
    const TriangleDistance found = DistanceOf(a, b);
    EXPECT_NEAR((found.b - found.a).norm(), found.distance.upper, 1e-13);
    EXPECT_LE(SquareToTriangle(ExactVector(found.a), Exactly(a)), Exact(1e-30));
    EXPECT_LE(SquareToTriangle(ExactVector(found.b), Exactly(b)), Exact(1e-30));
  }
}

// Goal:   the same of a point: over the face, beside an edge, beyond a corner, on the triangle.
TEST(TriangleDistance, Points) {
  Random random(207);
  for (int i = 0; i < 8000; ++i) {
    const bool on_lattice = i % 2 == 0;
    const double size = i % 4 == 1 ? random.LogUniform(1e-9, 1e9) : 1;
    const TrianglePoints t =
        on_lattice ? LatticeTriangle(random, 3) : RandomTriangle(random, Vector3d::Zero(), size);
    Vector3d p = random.Uniform(0, 3) * size * random.UnitVector();
    if (on_lattice) p = LatticeTriangle(random, 3)[0];
    if (i % 5 == 0) p = 0.25 * t[0] + 0.5 * t[1] + 0.25 * t[2];
    const TriangleDistance found = DistanceOf(p, t);
    ASSERT_NO_FATAL_FAILURE(
        ExpectContains(found.distance, SquareToTriangle(ExactVector(p), Exactly(t))));
    double reach = 0;
    for (const Vector3d& corner : t) reach = std::max(reach, (corner - p).norm());
    ASSERT_LE(found.distance.width(), kTight * reach);
    ASSERT_EQ(found.a, p);
  }
}

// Goal:   values out of range claim nothing.
TEST(TriangleDistance, OverflowIsUnbounded) {
  const TrianglePoints a = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
  const TrianglePoints b = {Vector3d(1e300, 0, 0), Vector3d(-1e308, 1e308, 0),
                            Vector3d(0, 0, 1e308)};
  const numeric::Interval distance = DistanceOf(a, b).distance;
  EXPECT_EQ(distance.lower, 0);
  EXPECT_EQ(distance.upper, numeric::kInfinity);
  const TrianglePoints tiny = {Vector3d(1e-300, 0, 0), Vector3d(0, 1e-310, 0), Vector3d(0, 0, 0)};
  EXPECT_EQ(DistanceOf(tiny, tiny).distance.lower, 0);
  EXPECT_LE(DistanceOf(tiny, tiny).distance.upper, 1e-140);
}

}  // namespace
}  // namespace collision::geometry
