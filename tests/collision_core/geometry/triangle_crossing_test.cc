#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "collision_core/geometry/triangle/triangle_pair.h"
#include "tests/support/random_points.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// In the plane z = 0, the origin inside.
const TrianglePoints kFlat = {Vector3d(4, 0, 0), Vector3d(-2, 4, 0), Vector3d(-2, -4, 0)};

/// A triangle whose first edge stands upright at (x, y), from z = `low` to z = `high`.
TrianglePoints Upright(double x, double y, double low, double high) {
  return {Vector3d(x, y, low), Vector3d(x, y, high), Vector3d(x + 100, y, 0.5 * (low + high))};
}

Vector3d NormalOf(const TrianglePoints& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

/// The corners, each moved by at most `reach`: at random, or all along one of `directions` and
/// against it, which takes volumes away fastest.
TrianglePoints Moved(Random& random, const TrianglePoints& t, double reach,
                     const std::vector<Vector3d>& directions) {
  const bool at_random = random.Chance(0.3);
  const Vector3d along = directions[random.Below(directions.size())];
  TrianglePoints moved = t;
  for (Vector3d& corner : moved) {
    const Vector3d direction = at_random ? random.UnitVector() : along;
    // Less than `reach` by more than the coordinates' rounding.
    const double by = 0.999 * reach * (random.Chance(0.5) ? 1 : -1);
    corner += by * direction;
  }
  return moved;
}

/// Directions in which the five volumes fall: normals of the triangles and of an edge with an edge.
std::vector<Vector3d> CriticalDirections(const TrianglePoints& a, const TrianglePoints& b) {
  std::vector<Vector3d> directions = {NormalOf(a), NormalOf(b)};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      directions.push_back((a[(i + 1) % 3] - a[i]).cross(b[(j + 1) % 3] - b[j]).normalized());
    }
  }
  return directions;
}

/// Some passage of the triangles lies within `error` of `point`, exactly.
bool HasPassageWithin(const TrianglePoints& a, const TrianglePoints& b, const Crossing& crossing) {
  const Exact reach = crossing.error;
  for (const ExactVector& x : PassagePoints(Exactly(a), Exactly(b))) {
    if (Square(x - ExactVector(crossing.point)) <= reach * reach) return true;
  }
  return false;
}

// Goal:   what is certain persists: wherever the corners go within the uncertainty, the triangles
//         cross within `error` of the point.
// Method: random pairs of like and unlike sizes, near and far; corners moved at random and in the
//         worst directions by the whole margin; exact rational arithmetic.
TEST(TriangleCrossing, CertainCrossingsPersist) {
  Random random(301);
  int certain = 0;
  for (int i = 0; i < 1500; ++i) {
    const double size = i % 2 ? 1 : random.LogUniform(1e-9, 1e9);
    const double other = i % 2 ? 1 : size * random.LogUniform(1e-2, 1e2);
    const Vector3d place = i % 3 ? Vector3d::Zero() : Vector3d(1e6 * size * random.UnitVector());
    const TrianglePoints a = RandomTriangle(random, place, size);
    const TrianglePoints b =
        RandomTriangle(random, place + random.Uniform(0, 1) * size * random.UnitVector(), other);
    const double margin = CrossingMargin(a, b);
    if (margin < 0) continue;
    ++certain;
    const double uncertainty = margin * random.Uniform(0, 1);
    const auto tight = CertainCrossing(a, b, 0), wide = CertainCrossing(a, b, uncertainty);
    ASSERT_TRUE(tight && wide);
    ASSERT_TRUE(HasPassageWithin(a, b, *tight));
    EXPECT_LE(tight->error, 1e-6 * std::min(size, other));
    const auto directions = CriticalDirections(a, b);
    for (int k = 0; k < 8; ++k) {
      const TrianglePoints moved_a = Moved(random, a, uncertainty, directions);
      const TrianglePoints moved_b = Moved(random, b, uncertainty, directions);
      ASSERT_TRUE(HasPassageWithin(moved_a, moved_b, *wide)) << i << " " << uncertainty;
      const TrianglePoints far_a = Moved(random, a, margin, directions);
      const TrianglePoints far_b = Moved(random, b, margin, directions);
      ASSERT_FALSE(PassagePoints(Exactly(far_a), Exactly(far_b)).empty()) << i << " " << margin;
    }
  }
  EXPECT_GT(certain, 200);
}

// Goal:   a crossing is certain exactly if it is one, but for a hair of rounding.
// Method: whole numbers, where touching is common, and then the same nudged.
TEST(TriangleCrossing, CertainExactlyWhereTheyCross) {
  Random random(302);
  int crossings = 0, touching = 0;
  for (int i = 0; i < 4000; ++i) {
    TrianglePoints t[2];
    for (TrianglePoints& triangle : t) {
      for (Vector3d& corner : triangle) {
        for (int k = 0; k < 3; ++k) corner[k] = static_cast<double>(random.Below(7)) - 3;
      }
    }
    const bool crosses = !PassagePoints(Exactly(t[0]), Exactly(t[1])).empty();
    EXPECT_EQ(CrossingMargin(t[0], t[1]) >= 0, crosses);
    EXPECT_EQ(CertainCrossing(t[0], t[1], 0).has_value(), crosses);
    EXPECT_EQ(CrossingMargin(t[1], t[0]) >= 0, crosses);
    if (crosses) ++crossings;
    if (!crosses && SquareOfTriangles(Exactly(t[0]), Exactly(t[1])) == 0) ++touching;
  }
  EXPECT_GT(crossings, 300);
  EXPECT_GT(touching, 200);
}

// Goal:   a corner that only touches the plane is not certain; one a hair beyond is, one a hair
//         short is not.
TEST(TriangleCrossing, NudgedThroughThePlane) {
  EXPECT_LT(CrossingMargin(kFlat, Upright(0, 0, 0, 5)), 0);
  EXPECT_LT(CrossingMargin(kFlat, Upright(0, 0, 1e-13, 5)), 0);
  const double margin = CrossingMargin(kFlat, Upright(0, 0, -1e-13, 5));
  EXPECT_GT(margin, 0);
  EXPECT_LE(margin, 1e-13);
  EXPECT_FALSE(CertainCrossing(kFlat, Upright(0, 0, 0, 5), 0));
  EXPECT_TRUE(CertainCrossing(kFlat, Upright(0, 0, -1e-13, 5), 0));
}

// Goal:   point, normal and side are right, and the margin is a good part of the true one.
// Method: an edge through the origin of the plane z = 0. With its ends at ±h, moving all corners
//         by h/2 frees it; so the true margin is at most h/2.
TEST(TriangleCrossing, KnownCrossing) {
  for (const double h : {1e-6, 1e-3, 0.1}) {
    const TrianglePoints upright = Upright(0, 0, -h, h);
    const double margin = CrossingMargin(kFlat, upright);
    EXPECT_LE(margin, 0.5 * h);
    EXPECT_GE(margin, 0.2 * h);
    const auto crossing = CertainCrossing(kFlat, upright, 0);
    ASSERT_TRUE(crossing);
    EXPECT_LE(crossing->point.norm(), crossing->error);
    EXPECT_LE(crossing->error, 1e-14);
    EXPECT_FALSE(crossing->through_b);
    EXPECT_NEAR(std::abs(crossing->normal.z()), 1, 1e-15);
    EXPECT_TRUE(CertainCrossing(upright, kFlat, 0)->through_b);
  }
}

// Goal:   the error grows with the uncertainty, no faster than needed: it covers the uncertainty
//         itself, and the way along the edge.
TEST(TriangleCrossing, ErrorFollowsTheUncertainty) {
  const TrianglePoints upright = Upright(0, 0, -1, 1);
  for (const double uncertainty : {1e-9, 1e-6, 1e-3}) {
    const auto crossing = CertainCrossing(kFlat, upright, uncertainty);
    ASSERT_TRUE(crossing);
    EXPECT_GE(crossing->error, uncertainty);
    EXPECT_LE(crossing->error, 10 * uncertainty);
  }
}

// Goal:   the margin is exactly where certainty ends.
TEST(TriangleCrossing, MarginIsTheGreatestUncertainty) {
  Random random(303);
  for (int i = 0; i < 2000; ++i) {
    const TrianglePoints a = RandomTriangle(random, Vector3d::Zero(), 1);
    const TrianglePoints b = RandomTriangle(random, 0.5 * random.UnitVector(), 1);
    const double margin = CrossingMargin(a, b);
    if (margin < 0) {
      EXPECT_FALSE(CertainCrossing(a, b, 0));
      continue;
    }
    EXPECT_TRUE(CertainCrossing(a, b, margin));
    EXPECT_FALSE(CertainCrossing(a, b, numeric::NextUp(margin)));
  }
}

// Goal:   slivers and large coordinates give no false certainty.
// Method: thin triangles that nearly touch, at 1e12 and at the origin, against exact arithmetic.
TEST(TriangleCrossing, NoFalseCertaintyOfSlivers) {
  Random random(304);
  int certain = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d place = i % 2 ? Vector3d::Zero() : Vector3d(1e12 * random.UnitVector());
    const double size = i % 2 ? 1 : 1e3;
    const auto sliver = [&](const Vector3d& start) {
      const Vector3d edge = size * random.UnitVector();
      const Vector3d off = size * random.LogUniform(1e-15, 1e-2) * random.UnitVector();
      return TrianglePoints{start - 0.5 * edge, start + 0.5 * edge,
                            start + random.Uniform(-0.5, 0.5) * edge + off};
    };
    const TrianglePoints a = sliver(place);
    const TrianglePoints b =
        sliver(place + size * random.LogUniform(1e-16, 1e-2) * random.UnitVector());
    const auto crossing = CertainCrossing(a, b, 0);
    if (!crossing) continue;
    ++certain;
    ASSERT_TRUE(HasPassageWithin(a, b, *crossing));
    const double margin = CrossingMargin(a, b);
    const auto directions = CriticalDirections(a, b);
    const TrianglePoints moved_a = Moved(random, a, margin, directions);
    // At 1e12 the corners' grid is coarser than most margins.
    if ((moved_a[0] - a[0]).norm() > margin) continue;
    ASSERT_FALSE(
        PassagePoints(Exactly(moved_a), Exactly(Moved(random, b, i % 2 ? margin : 0, directions)))
            .empty());
  }
  EXPECT_GT(certain, 50);
}

// Goal:   values out of range are never certain.
TEST(TriangleCrossing, OutOfRangeIsUncertain) {
  TrianglePoints huge = Upright(0, 0, -1e60, 1e60);
  EXPECT_LT(CrossingMargin(kFlat, huge), 0);
  huge = Upright(0, 0, -1, std::nan(""));
  EXPECT_LT(CrossingMargin(kFlat, huge), 0);
  EXPECT_FALSE(CertainCrossing(huge, kFlat, 0));
}

}  // namespace
}  // namespace collision::geometry
