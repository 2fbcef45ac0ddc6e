// Distances of triangles and bodies, by other means than the checker's own.
#include <gtest/gtest.h>

#include <cmath>

#include "client/checker/shape/bodies.h"
#include "tests/client/checker/random_pose.h"
#include "tests/client/checker/solids.h"
#include "tests/support/random.h"

namespace collision::checker {
namespace {

Triangle RandomTriangle(Random* random, double size) {
  return {RandomVector(random, size), RandomVector(random, size), RandomVector(random, size)};
}

// The squared distance, by going down the convex function of four coordinates (Frank and Wolfe's
// method with steps towards corners, then away): slow, and of another kind. An upper bound that
// comes close.
double ByDescent(const Triangle& a, const Triangle& b) {
  double weights_a[3] = {1 / 3.0, 1 / 3.0, 1 / 3.0}, weights_b[3] = {1 / 3.0, 1 / 3.0, 1 / 3.0};
  const auto at = [](const Triangle& t, const double* w) {
    return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
  };
  // Exact minimisation along one edge of one triangle's weights at a time.
  const auto shift = [&](const Triangle& t, double* w, const Vector& target, int i, int k) {
    const Vector edge = t[k] - t[i];
    const double length = Squared(edge);
    if (length == 0) return;
    double s = Dot(target - at(t, w), edge) / length;
    s = std::clamp(s, -w[k], w[i]);
    w[i] -= s;
    w[k] += s;
  };
  for (int round = 0; round < 4000; ++round) {
    for (int i = 0; i < 3; ++i) {
      shift(a, weights_a, at(b, weights_b), i, (i + 1) % 3);
      shift(b, weights_b, at(a, weights_a), i, (i + 1) % 3);
    }
  }
  return Squared(at(a, weights_a) - at(b, weights_b));
}

// Goal:   the distance of triangles is right: not more than a point of each is apart, and certified
// from below by a separating direction.
// Method: random triangles; descent never comes below it and nearly to it, and the gap of the two
// along random directions is never more.
TEST(TriangleDistance, AgreesWithDescentAndWithSeparatingPlanes) {
  Random random(1);
  int apart = 0;
  for (int run = 0; run < 300; ++run) {
    const Triangle a = RandomTriangle(&random, 1), b = RandomTriangle(&random, 1);
    const double distance = Distance(a, b);
    const double descended = std::sqrt(ByDescent(a, b));
    EXPECT_LE(distance, descended + 1e-12) << run;
    EXPECT_GE(distance, descended - 5e-3) << run;
    apart += distance > 0;
    for (int i = 0; i < 50; ++i) {
      const auto u = random.UnitVector();
      const Vector n{u.x(), u.y(), u.z()};
      const double gap = std::min({Dot(n, b[0]), Dot(n, b[1]), Dot(n, b[2])}) -
                         std::max({Dot(n, a[0]), Dot(n, a[1]), Dot(n, a[2])});
      EXPECT_LE(gap, distance + 1e-12);
    }
  }
  EXPECT_GE(apart, 100);
  EXPECT_LE(apart, 295);
}

// Goal:   known cases: corner over face, crossing edges, parallel edges, crossing triangles.
TEST(TriangleDistance, KnownCases) {
  const Triangle floor = {{{0, 0, 0}, {7, 0, 0}, {0, 7, 0}}};
  EXPECT_EQ(Distance(floor, {{{1, 1, 3}, {1, 1, 9}, {2, 1, 9}}}), 3);
  EXPECT_EQ(Distance(floor, {{{-2, -3, 6}, {-9, -9, 9}, {-9, -9, 8}}}), 7);  // 2² + 3² + 6²
  EXPECT_EQ(Distance(floor, {{{2, -2, -3}, {2, -2, 3}, {2, -9, 0}}}), 2);
  EXPECT_EQ(Distance(floor, {{{0, -1, 0}, {7, -1, 0}, {3, -9, 0}}}), 1);
  EXPECT_EQ(Distance(floor, {{{1, 1, -1}, {1, 1, 1}, {5, 5, 5}}}), 0);
  EXPECT_EQ(Distance(floor, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}), 0);  // in one plane
}

// Goal:   a crossing lasts while corners move by less than half its margin each, and hardly longer.
TEST(CrossingMargin, KeepsItsPromise) {
  Random random(2);
  int crossing = 0, lost = 0;
  for (int run = 0; run < 2000; ++run) {
    const Triangle a = RandomTriangle(&random, 1), b = RandomTriangle(&random, 1);
    const double margin = CrossingMargin(a, b);
    EXPECT_EQ(margin > 0, Distance(a, b) == 0);
    if (margin == 0) continue;
    ++crossing;
    for (int i = 0; i < 50; ++i) {
      for (const double share : {0.4999, 0.8}) {
        Triangle moved_a = a, moved_b = b;
        const auto u = random.UnitVector();
        const Vector step = share * margin * Vector{u.x(), u.y(), u.z()};
        for (Vector& v : moved_a) v = v + step;
        for (Vector& v : moved_b) v = v - step;
        if (share < 0.5) {
          EXPECT_EQ(Distance(moved_a, moved_b), 0);
        } else {
          lost += Distance(moved_a, moved_b) > 0;
        }
      }
    }
  }
  EXPECT_GE(crossing, 100);
  EXPECT_GE(lost, 10);
}

TEST(CheckerMesh, KnowsWhatIsClosedAndInside) {
  const Mesh cube = BoxMesh(1, 2, 3);
  EXPECT_TRUE(cube.closed());
  EXPECT_EQ(cube.part_points().size(), 1u);
  EXPECT_NEAR(cube.radius_m(), std::sqrt(14), 1e-15);
  EXPECT_EQ(cube.WindingNumber({0.99, -1.99, 2.99}), 1);
  EXPECT_EQ(cube.WindingNumber({1.01, 0, 0}), 0);
  EXPECT_TRUE(cube.Contains({0, 0, 2.9}));
  EXPECT_FALSE(cube.Contains({0, 0, 3.1}));
  EXPECT_FALSE(SquareMesh(1).closed());
  EXPECT_FALSE(SquareMesh(1).Contains({0, 0, 0}));
  const Mesh inside_out(cube.vertices(), {{0, 1, 2},
                                          {1, 3, 2},
                                          {4, 6, 5},
                                          {5, 6, 7},
                                          {0, 4, 1},
                                          {1, 4, 5},
                                          {2, 3, 6},
                                          {3, 7, 6},
                                          {0, 2, 4},
                                          {2, 6, 4},
                                          {1, 5, 3},
                                          {3, 5, 7}});
  EXPECT_EQ(inside_out.WindingNumber({0, 0, 0}), -1);
  EXPECT_TRUE(inside_out.Contains({0, 0, 0}));
  // One face the other way round: its edges are passed twice the same way.
  EXPECT_FALSE(Mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 2, 3}})
                   .closed());
}

// Goal:   boxes around groups of triangles lose nothing.
// Method: bodies of 200 triangles in random positions against all pairs of triangles.
TEST(Bodies, BoxesLoseNothing) {
  Random random(4);
  const auto cloud = [&] {
    std::vector<Vector> vertices;
    Faces faces;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Vector at = RandomVector(&random, 1);
      for (int k = 0; k < 3; ++k) vertices.push_back(at + RandomVector(&random, 0.1));
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return Mesh(vertices, faces);
  };
  int touching = 0;
  for (int run = 0; run < 12; ++run) {
    const Mesh a = cloud(), b = cloud();
    Pose pose;
    const double angle = random.Uniform(0, 6), c = std::cos(angle), s = std::sin(angle);
    pose.R_AB = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    pose.p_AB = RandomVector(&random, 2);
    double distance = INFINITY, margin = 0;
    for (const Triangle& x : a.triangles()) {
      for (const Triangle& y : b.triangles()) {
        const Triangle seen = {pose(y[0]), pose(y[1]), pose(y[2])};
        distance = std::min(distance, Distance(x, seen));
        margin = std::max(margin, CrossingMargin(x, seen));
      }
    }
    Hint hint;
    const Standing standing = StandingOf({&a, 0}, {&b, 0}, pose, &hint);
    EXPECT_EQ(standing.contact, distance == 0);
    EXPECT_NEAR(standing.margin, distance == 0 ? margin : distance, 1e-12);
    EXPECT_EQ(InContact({&a, 0}, {&b, 0}, pose, &hint), distance == 0);
    touching += distance == 0;
  }
  EXPECT_GE(touching, 2);
  EXPECT_LE(touching, 10);
}

// Goal:   the least overlap of two boxes parts them, and a contact is as deep as that.
TEST(Bodies, DepthOfBoxes) {
  const Mesh cube = BoxMesh(1, 1, 1);
  Pose pose;
  pose.p_AB = {0.5, 1.7, 0.3};
  EXPECT_NEAR(DepthAtMost({&cube, 0}, {&cube, 0}, pose, {}), 0.3, 1e-15);
  Hint hint;
  EXPECT_TRUE(InContactThrough({&cube, 0}, {&cube, 0}, pose, 0.25, &hint));
  EXPECT_FALSE(InContactThrough({&cube, 0}, {&cube, 0}, pose, 0.31, &hint));
  EXPECT_NEAR(DepthAtMost({&cube, 0}, {nullptr, 0.4}, {Pose().R_AB, {1.3, 0, 0}}, {}), 0.1, 1e-15);
  EXPECT_EQ(DistanceTo({&cube, 0}, {0, 0, 0.9}), 0);
  EXPECT_EQ(DistanceTo({&cube, 0}, {3, 4, 7}), 7);  // 2² + 3² + 6²
}

}  // namespace
}  // namespace collision::checker
