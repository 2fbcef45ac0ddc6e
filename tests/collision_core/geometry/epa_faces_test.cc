// Goal:   the faces are at all times a closed surface around the hull of the points, its inner ball
//         is certain and nearly the largest, and a point that cannot be added changes nothing.
// Method: tetrahedra, octahedra and cubes with exact distances; random points of a sphere, whose
//         hull has 2 n − 4 faces.
#include "collision_core/geometry/convex/epa_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

const std::array<Vector3d, 4> kAround = {Vector3d(1, 1, 1), Vector3d(1, -1, -1),
                                         Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)};

PolytopeFaces::Point PointAt(const Vector3d& y) { return {y, {}}; }

PolytopeFaces Started(const std::array<Vector3d, 4>& corners, double tolerance = 1e-12) {
  PolytopeFaces faces;
  faces.Start({PointAt(corners[0]), PointAt(corners[1]), PointAt(corners[2]), PointAt(corners[3])},
              tolerance);
  return faces;
}

/// The numbers of all faces, the nearest first.
std::vector<int> AllOf(PolytopeFaces faces) {
  std::vector<int> all;
  for (int face = faces.Nearest(); face >= 0; face = faces.Nearest()) {
    all.push_back(face);
    faces.SetFinal(face);
  }
  return all;
}

/// A face that the point lies beyond; −1: it lies inside.
int FaceBefore(const PolytopeFaces& faces, const Vector3d& y) {
  for (const int face : AllOf(faces)) {
    if (faces.NormalOf(face).dot(y) > faces.DistanceOf(face) + 1e-9) return face;
  }
  return -1;
}

bool Add(const Vector3d& y, PolytopeFaces* faces) {
  return faces->Add(FaceBefore(*faces, y), PointAt(y));
}

/// Each point lies behind all faces, and each face reaches some of them.
void ExpectHullOf(const std::vector<Vector3d>& points, const PolytopeFaces& faces) {
  for (const int face : AllOf(faces)) {
    EXPECT_NEAR(faces.NormalOf(face).norm(), 1, 1e-15);
    double furthest = -numeric::kInfinity;
    for (const Vector3d& p : points) furthest = std::max(furthest, faces.NormalOf(face).dot(p));
    EXPECT_NEAR(furthest, faces.DistanceOf(face), 1e-12);
  }
}

TEST(EpaFaces, ATetrahedronHasFourOutwardFacesWhateverTheOrderOfItsCorners) {
  for (const std::array<Vector3d, 4>& corners :
       {kAround, std::array{kAround[1], kAround[0], kAround[2], kAround[3]}}) {
    const PolytopeFaces faces = Started(corners);
    ASSERT_EQ(AllOf(faces).size(), 4u);
    for (const int face : AllOf(faces)) {
      EXPECT_NEAR(faces.DistanceOf(face), std::sqrt(1.0 / 3), 1e-15);
    }
    ExpectHullOf({kAround.begin(), kAround.end()}, faces);
  }
}

TEST(EpaFaces, TheNearestFaceIsTheOneBeyondWhichTheOriginLies) {
  const Vector3d shift(3, 0, 0);
  const PolytopeFaces faces =
      Started({kAround[0] + shift, kAround[1] + shift, kAround[2] + shift, kAround[3] + shift});
  const int nearest = faces.Nearest();
  EXPECT_LT(faces.DistanceOf(nearest), 0);
  EXPECT_LT(faces.NormalOf(nearest).x(), 0);
  EXPECT_EQ(faces.CertainInnerRadius(0, 8), -numeric::kInfinity);
}

TEST(EpaFaces, AFinalFaceIsNotTheNearest) {
  PolytopeFaces faces = Started(kAround);
  const int first = faces.Nearest();
  faces.SetFinal(first);
  EXPECT_NE(faces.Nearest(), first);
  for (int k = 0; k < 3; ++k) faces.SetFinal(faces.Nearest());
  EXPECT_EQ(faces.Nearest(), -1);
}

TEST(EpaFaces, APointReplacesExactlyTheFacesThatItLiesBeyond) {
  PolytopeFaces faces = Started(kAround);
  const Vector3d apex(-1, -1, -1);  // beyond one face: the cube's corner opposite to the first
  ASSERT_TRUE(Add(apex, &faces));
  EXPECT_EQ(AllOf(faces).size(), 6u);
  std::vector<Vector3d> points(kAround.begin(), kAround.end());
  points.push_back(apex);
  ExpectHullOf(points, faces);
  ASSERT_TRUE(Add({-9, -9, -9}, &faces));
  EXPECT_EQ(AllOf(faces).size(), 6u) << "the cone of the new apex takes the place of the former's";
}

// Its sides are squares: corners that lie in the plane of a face count as not beyond it.
TEST(EpaFaces, ACubeGrowsFromItsCornersToItsTwelveTriangles) {
  PolytopeFaces faces = Started(kAround);
  std::vector<Vector3d> points(kAround.begin(), kAround.end());
  for (const Vector3d& c : kAround) {
    ASSERT_TRUE(Add(-c, &faces));
    points.push_back(-c);
  }
  ASSERT_EQ(AllOf(faces).size(), 12u);
  for (const int face : AllOf(faces)) EXPECT_EQ(faces.DistanceOf(face), 1);
  ExpectHullOf(points, faces);
}

TEST(EpaFaces, TheInnerRadiusIsCertainAndNearlyTheLargest) {
  const PolytopeFaces faces = Started(kAround);
  const double truth = std::sqrt(1.0 / 3);
  EXPECT_LT(faces.CertainInnerRadius(0, 3), truth);
  EXPECT_GT(faces.CertainInnerRadius(0, 3), truth - 1e-14);
  EXPECT_LT(faces.CertainInnerRadius(0.25, 3), truth - 0.25);
  EXPECT_GT(faces.CertainInnerRadius(0.25, 3), truth - 0.25 - 1e-14);
  EXPECT_EQ(faces.CertainInnerRadius(0.6, 3), -numeric::kInfinity) << "more than the ball";
  EXPECT_LT(faces.CertainInnerRadius(0, 1e6), faces.CertainInnerRadius(0, 3)) << "rounding";
}

TEST(EpaFaces, ThreePointsOnALineMakeNoFaces) {
  const PolytopeFaces faces = Started({Vector3d(0, 0, 0), {1, 0, 0}, {2, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(faces.Nearest(), -1);
  EXPECT_EQ(faces.CertainInnerRadius(0, 3), -numeric::kInfinity);
}

// It lies in the middle of an edge, a little outward from one of its faces, and behind the other.
TEST(EpaFaces, APointThatWouldMakeANeedleChangesNothing) {
  PolytopeFaces faces = Started(kAround);
  const Vector3d normal = -kAround[3].normalized();
  const Vector3d y = (kAround[0] + kAround[1]) / 2 + 1e-11 * normal;
  const std::vector<int> before = AllOf(faces);
  int beyond = -1;
  for (const int face : before) {
    if (faces.NormalOf(face).dot(normal) > 0.9) beyond = face;
  }
  ASSERT_GE(beyond, 0);
  EXPECT_FALSE(faces.Add(beyond, PointAt(y)));
  EXPECT_EQ(AllOf(faces), before);
  ExpectHullOf({kAround.begin(), kAround.end()}, faces);
  EXPECT_TRUE(Add({-1, -1, -1}, &faces)) << "others are still added";
}

TEST(EpaFaces, PointsOfASphereAreAddedUntilThereIsNoRoom) {
  Random random(7);
  for (int round = 0; round < 5; ++round) {
    PolytopeFaces faces = Started(kAround);
    std::vector<Vector3d> points(kAround.begin(), kAround.end());
    for (;;) {
      const Vector3d y = std::sqrt(3.0) * random.UnitVector();
      if (FaceBefore(faces, y) < 0) continue;
      if (!Add(y, &faces)) break;
      points.push_back(y);
      ASSERT_EQ(AllOf(faces).size(), 2 * points.size() - 4) << "closed: Euler's formula";
      double least = numeric::kInfinity;
      for (const int face : AllOf(faces)) least = std::min(least, faces.DistanceOf(face));
      ASSERT_LE(faces.CertainInnerRadius(0, 6), least);
      ASSERT_GT(faces.CertainInnerRadius(0, 6), least - 1e-13);
    }
    EXPECT_GT(points.size(), 100u);
    EXPECT_LE(AllOf(faces).size(), static_cast<std::size_t>(kEpaFacesMax));
    ExpectHullOf(points, faces);
  }
}

// Each is so far out that many of the former faces, and points, lie behind its cone: places become
// free and are filled.
TEST(EpaFaces, FarPointsSwallowFacesAndLeaveTheHull) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    PolytopeFaces faces = Started(kAround);
    std::vector<Vector3d> points(kAround.begin(), kAround.end());
    std::size_t most = 0, swallowed = 0;
    for (int k = 0; k < 60; ++k) {
      const Vector3d y = random.UnitVector() * (k % 15 == 14 ? 2.0 + k : 2 + 1e-3 * k);
      if (FaceBefore(faces, y) < 0) continue;
      ASSERT_TRUE(Add(y, &faces));
      points.push_back(y);
      const std::size_t count = AllOf(faces).size();
      ASSERT_EQ(count % 2, 0u) << "closed: three half-edges a face";
      swallowed += count < most;
      most = std::max(most, count);
    }
    EXPECT_GT(swallowed, 0u);
    ExpectHullOf(points, faces);
  }
}

}  // namespace
}  // namespace collision::geometry
