// Goal:   the point of a simplex nearest to the origin is a weighted sum of the corners that are
//         named, and no other point is nearer.
// Method: simplices with exact answers, the origin in front of each kind of face; random ones with
//         a certificate: p is nearest exactly if p·c >= p·p for each corner c.
#include "collision_core/geometry/convex/gjk_simplex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/random.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

SimplexPoint NearestOf(const std::vector<Vector3d>& corners, int newest = -1) {
  std::array<const Vector3d*, 4> pointers{};
  for (std::size_t k = 0; k < corners.size(); ++k) pointers[k] = &corners[k];
  SimplexPoint point{};
  NearestOfSimplex(pointers, static_cast<int>(corners.size()), newest, &point);
  return point;
}

std::vector<int> CornersOf(const SimplexPoint& point) {
  return {point.corners.begin(), point.corners.begin() + point.count};
}

/// Expects exactly this point, of exactly these corners.
void ExpectIs(const SimplexPoint& point, const Vector3d& nearest, const std::vector<int>& corners) {
  EXPECT_EQ(point.nearest, nearest);
  EXPECT_EQ(point.square, nearest.squaredNorm());
  EXPECT_EQ(CornersOf(point), corners);
  EXPECT_FALSE(point.encloses);
}

TEST(GjkSimplex, OfOneCornerItIsTheCorner) { ExpectIs(NearestOf({{2, 3, 6}}), {2, 3, 6}, {0}); }

TEST(GjkSimplex, OfAnEdgeItLiesBetweenTheCornersOrIsOneOfThem) {
  ExpectIs(NearestOf({{1, -1, 0}, {1, 3, 0}}), {1, 0, 0}, {0, 1});
  ExpectIs(NearestOf({{1, 1, 0}, {1, 3, 0}}), {1, 1, 0}, {0});
  ExpectIs(NearestOf({{1, -3, 0}, {1, -1, 0}}), {1, -1, 0}, {1});
  const SimplexPoint point = NearestOf({{1, -1, 0}, {1, 3, 0}});
  EXPECT_EQ(point.weights[0], 0.75);
  EXPECT_EQ(point.weights[1], 0.25);
}

TEST(GjkSimplex, OfATriangleItLiesInTheFaceOnAnEdgeOrOnACorner) {
  const auto at = [](double x, double y) {
    return NearestOf({{x, y, 2}, {x + 4, y, 2}, {x, y + 4, 2}});
  };
  ExpectIs(at(-1, -1), {0, 0, 2}, {0, 1, 2});
  ExpectIs(at(-1, 1), {0, 1, 2}, {0, 1});
  ExpectIs(at(1, -1), {1, 0, 2}, {0, 2});
  ExpectIs(at(-3, -3), {-1, -1, 2}, {1, 2});
  ExpectIs(at(1, 1), {1, 1, 2}, {0});
  ExpectIs(at(-6, 1), {-2, 1, 2}, {1});
  ExpectIs(at(1, -6), {1, -2, 2}, {2});
  const SimplexPoint inside = at(-1, -1);
  EXPECT_EQ(inside.weights[0], 0.5);
  EXPECT_EQ(inside.weights[1], 0.25);
  EXPECT_EQ(inside.weights[2], 0.25);
}

TEST(GjkSimplex, ATetrahedronAroundTheOriginEnclosesIt) {
  const SimplexPoint point = NearestOf({{3, 3, 3}, {3, -3, -3}, {-3, 3, -3}, {-3, -3, 3}});
  EXPECT_TRUE(point.encloses);
  EXPECT_EQ(point.square, 0);
  EXPECT_EQ(point.count, 4);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(point.weights[k], 0.25);
}

TEST(GjkSimplex, OfATetrahedronBesideTheOriginItLiesOnTheSurface) {
  const auto at = [](double x, double y, double z) {
    const Vector3d p(x, y, z);
    return NearestOf({p, p + Vector3d(4, 0, 0), p + Vector3d(0, 4, 0), p + Vector3d(0, 0, 4)});
  };
  EXPECT_TRUE(at(-1, -1, -1).encloses);
  ExpectIs(at(-1, -1, 1), {0, 0, 1}, {0, 1, 2});
  ExpectIs(at(1, -1, -1), {1, 0, 0}, {0, 2, 3});
  ExpectIs(at(1, 1, -1), {1, 1, 0}, {0, 3});
  ExpectIs(at(2, 3, 6), {2, 3, 6}, {0});
  ExpectIs(at(-6, 1, 1), {-2, 1, 1}, {1});
  const SimplexPoint slope = at(-2, -2, -2);
  EXPECT_EQ(CornersOf(slope), (std::vector<int>{1, 2, 3}));
  EXPECT_LT((slope.nearest - Vector3d::Constant(-2.0 / 3)).norm(), 1e-15);
}

// The origin lay beside that face before the corner was added.
TEST(GjkSimplex, AFaceWithoutTheNewestCornerIsSkipped) {
  const std::vector<Vector3d> corners = {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}, {-1, -1, 5}};
  EXPECT_FALSE(NearestOf(corners).encloses);
  EXPECT_FALSE(NearestOf(corners, 0).encloses) << "the face has it";
  EXPECT_TRUE(NearestOf(corners, 3).encloses) << "no other face has the origin beyond it";
}

TEST(GjkSimplex, AFlatTetrahedronHasNoInside) {
  const SimplexPoint point = NearestOf({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}, {3, 3, 0}});
  EXPECT_FALSE(point.encloses);
  EXPECT_EQ(point.square, 0);
}

// Goal:   whatever the size and place of the simplex, the answer is in it and nothing is nearer.
TEST(GjkSimplex, OfRandomSimplicesNoPointIsNearer) {
  Random random(13);
  int of_count[5] = {};
  for (int round = 0; round < 20000; ++round) {
    const double size = random.LogUniform(1e-3, 1e3);
    const Vector3d middle = random.UnitVector() * size * random.Uniform(0, 2);
    std::vector<Vector3d> corners(1 + random.Below(4));
    for (Vector3d& c : corners) c = middle + random.UnitVector() * size;
    const SimplexPoint point = NearestOf(corners);
    ASSERT_GE(point.count, 1);
    ASSERT_TRUE(std::is_sorted(point.corners.begin(), point.corners.begin() + point.count));
    double sum = 0;
    Vector3d weighted = Vector3d::Zero();
    for (int k = 0; k < point.count; ++k) {
      ASSERT_GE(point.weights[k], 0);
      sum += point.weights[k];
      weighted += point.weights[k] * corners[point.corners[k]];
    }
    const double slack = 1e-9 * size;
    ASSERT_NEAR(sum, 1, 1e-15);
    ASSERT_LT((weighted - point.nearest).norm(), slack);
    ASSERT_NEAR(point.square, point.nearest.squaredNorm(), slack * slack);
    for (const Vector3d& c : corners) {
      ASSERT_GE(point.nearest.dot(c), point.square - slack * size) << round;
    }
    ASSERT_EQ(point.encloses, point.count == 4);
    ++of_count[point.count];
  }
  for (int count = 1; count <= 4; ++count) EXPECT_GT(of_count[count], 100) << count;
}

}  // namespace
}  // namespace collision::geometry
