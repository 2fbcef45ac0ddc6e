#include "collision_core/geometry/convex/convex_points.h"

#include <gtest/gtest.h>

#include "collision_core/geometry/convex/convex_set.h"
#include "collision_core/geometry/convex/gjk.h"
#include "tests/support/random_points.h"
#include "tests/support/random_rotation.h"
#include "tests/support/truth/exact_convex.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

// Goal:   no point lies further along than the one found, but for rounding: on spheres, in balls,
//         on needles, in planes, on lines, among many doubles.
// Method: all points in turn, exactly.
TEST(ConvexPoints, FurthestOfAll) {
  Random random(351);
  for (int i = 0; i < 150; ++i) {
    const auto points = RandomPoints(random, 1 + random.Below(i % 3 == 0 ? 40 : 1500), i % 5);
    const ConvexPoints convex(points);
    ASSERT_EQ(convex.size(), points.size());
    for (int k = 0; k < 30; ++k) {
      const Vector3d n = random.Chance(0.3) ? Vector3d(Vector3d::Unit(k % 3)) : random.UnitVector();
      const ExactVector exact(n);
      const Exact found = Dot(exact, ExactVector(convex[convex.Furthest(n)]));
      Exact most = found;
      double in_doubles = -numeric::kInfinity;
      for (const Vector3d& p : points) in_doubles = std::max(in_doubles, n.dot(p));
      for (const Vector3d& p : points) {
        if (n.dot(p) > in_doubles - 1e-14) most = std::max(most, Dot(exact, ExactVector(p)));
      }
      EXPECT_LE(most - found, Exact(16 * 0x1p-53 * convex.reach()));
    }
  }
}

// Goal:   a support point belongs to its set, and none reaches further, both to within the error
//         that is stated; and the same of the difference of two sets.
// Method: exact corners of triangles, segments and boxes whose generators are not square to each
//         other.
TEST(ConvexSet, SupportErrorsHold) {
  Random random(352);
  for (int i = 0; i < 1500; ++i) {
    ConvexSet set;
    const ConvexCore cores[] = {ConvexCore::kSegment, ConvexCore::kTriangle, ConvexCore::kBox};
    set.core = cores[i % 3];
    for (int k = 0; k < 3; ++k) {
      set.generators.col(k) = random.LogUniform(1e-3, 1) * random.UnitVector();
      if (set.core == ConvexCore::kSegment && k > 0) set.generators.col(k).setZero();
      set.span += (1 + 1e-15) * set.generators.col(k).norm();
    }
    const Vector3d n = random.UnitVector();
    const Vector3d found = set.SupportPoint(n);
    const ExactVector g[3] = {ExactVector(Vector3d(set.generators.col(0))),
                              ExactVector(Vector3d(set.generators.col(1))),
                              ExactVector(Vector3d(set.generators.col(2)))};
    ExactPoints corners;
    if (set.core == ConvexCore::kTriangle) corners = {g[0], g[1], g[2]};
    if (set.core == ConvexCore::kSegment) corners = {g[0], Exact(-1) * g[0]};
    for (int k = 0; set.core == ConvexCore::kBox && k < 8; ++k) {
      corners.push_back(Exact(k & 1 ? 1 : -1) * g[0] + Exact(k & 2 ? 1 : -1) * g[1] +
                        Exact(k & 4 ? 1 : -1) * g[2]);
    }
    const Exact error = Exact(kSupportError * set.span);
    Exact nearest = Square(corners[0] - ExactVector(found));
    for (const ExactVector& x : corners) {
      EXPECT_LE(Dot(ExactVector(n), x - ExactVector(found)), error);
      nearest = std::min(nearest, Square(x - ExactVector(found)));
    }
    EXPECT_LE(nearest, error * error);
  }
}

// Goal:   likewise of ellipsoids, flat ones too.
// Method: a point is inside where |G⁻¹ x| <= 1; nothing reaches further than |Gᵀ n|; in rationals.
TEST(ConvexSet, EllipsoidSupportErrorsHold) {
  Random random(353);
  for (int i = 0; i < 1000; ++i) {
    ConvexSet set;
    set.core = ConvexCore::kEllipsoid;
    for (int k = 0; k < 3; ++k) {
      set.generators.col(k) = random.LogUniform(i % 2 ? 1e-3 : 0.3, 1) * random.UnitVector();
      set.span += (1 + 1e-15) * set.generators.col(k).norm();
    }
    const Vector3d n = random.UnitVector(), found = set.SupportPoint(n);
    Exact square = 0;
    for (int k = 0; k < 3; ++k) {
      const Exact along = Dot(ExactVector(n), ExactVector(Vector3d(set.generators.col(k))));
      square += along * along;
    }
    const Exact reached = Dot(ExactVector(n), ExactVector(found));
    const Exact with = reached + Exact(kSupportError * set.span);
    EXPECT_LE(square, with * with);
    EXPECT_GE(square, (with - 2 * Exact(kSupportError * set.span)) *
                          (with - 2 * Exact(kSupportError * set.span)));
  }
}

// Goal:   likewise of cylinders and cones, flat ones and needles too, along their axes as well.
// Method: nothing of a cylinder reaches further along n than √((n·g_0)² + (n·g_1)²) + |n·g_2|, of a
//         cone than the greater one of n·g_2 and that root less n·g_2; in rationals.
TEST(ConvexSet, SupportErrorsOfCylindersAndConesHold) {
  Random random(354);
  for (int i = 0; i < 2000; ++i) {
    ConvexSet set;
    set.core = i % 2 ? ConvexCore::kCylinder : ConvexCore::kCone;
    const Eigen::Matrix3d turn = RandomRotation(random);
    const double radius = random.LogUniform(1e-3, 1), half = random.LogUniform(1e-3, 1);
    const double sizes[3] = {radius, radius, half};
    for (int k = 0; k < 3; ++k) {
      set.generators.col(k) = sizes[k] * turn.col(k);
      set.span += (1 + 1e-15) * set.generators.col(k).norm();
    }
    const Vector3d n = i % 5 ? random.UnitVector() : Vector3d(i % 3 ? turn.col(2) : turn.col(0));
    const Exact error = Exact(kSupportError * set.span);
    const Exact reached = Dot(ExactVector(n), ExactVector(set.SupportPoint(n)));
    const auto along = [&](int k) {
      return Dot(ExactVector(n), ExactVector(Vector3d(set.generators.col(k))));
    };
    const Exact rim_square = along(0) * along(0) + along(1) * along(1);
    const Exact axis = along(2);
    // Whether x is at most the furthest point of the disc at the end `at` of the axis.
    const auto up_to = [&](const Exact& x, const Exact& at) {
      return x <= at || (x - at) * (x - at) <= rim_square;
    };
    const Exact end = set.core == ConvexCore::kCylinder && axis > 0 ? axis : -axis;
    const bool apex = set.core == ConvexCore::kCone;
    EXPECT_TRUE(up_to(reached - error, end) || (apex && reached - error <= axis)) << i;
    EXPECT_TRUE(!up_to(reached + error, end) || reached + error == end) << i;
    EXPECT_TRUE(!apex || reached + error >= axis) << i;
  }
}

}  // namespace
}  // namespace collision::geometry
