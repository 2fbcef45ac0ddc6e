// Goal:   what is not a mesh is refused with a sentence that helps; what can be repaired is,
//         counted.
// Method: one mistake at a time in a good mesh; polygons whose area and boundary are known.
#include "collision_core/geometry/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMany = 1000;

TriangleMesh UnitBox() { return Box({0, 0, 0}, {1, 1, 1}); }

PolygonMesh AsPolygons(const TriangleMesh& mesh) {
  PolygonMesh polygons{mesh.vertices, {}, {}};
  for (const Triangle& t : mesh.triangles) {
    polygons.corners.insert(polygons.corners.end(), t.begin(), t.end());
    polygons.sizes.push_back(3);
  }
  return polygons;
}

PolygonMesh OnePolygon(const std::vector<Vector3d>& vertices) {
  PolygonMesh mesh{vertices, {}, {static_cast<std::uint32_t>(vertices.size())}};
  for (std::uint32_t i = 0; i < vertices.size(); ++i) mesh.corners.push_back(i);
  return mesh;
}

/// Both kinds of mesh say the same of what they have in common.
void ExpectRefused(const TriangleMesh& mesh, std::size_t triangles_max, const std::string& words) {
  const auto refusal = RefusalOf(mesh, triangles_max);
  ASSERT_TRUE(refusal.has_value()) << "expected: " << words;
  EXPECT_NE(refusal->find(words), std::string::npos) << *refusal;
  EXPECT_TRUE(RefusalOf(AsPolygons(mesh), triangles_max).has_value());
}

TEST(MeshRefusal, GoodMeshesAreTaken) {
  EXPECT_EQ(RefusalOf(UnitBox(), 12), std::nullopt);
  EXPECT_EQ(RefusalOf(AsPolygons(UnitBox()), 12), std::nullopt);
}

TEST(MeshRefusal, EachMistakeIsNamed) {
  ExpectRefused({}, kMany, "mesh.triangles: there are none");
  ExpectRefused(UnitBox(), 11, "mesh.triangles: 12 of them; at most 11 are allowed");
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.0001e7, -2e7, 1e300}) {
    TriangleMesh mesh = UnitBox();
    mesh.vertices[5].y() = bad;
    ExpectRefused(mesh, kMany, "mesh.vertices[5].y is ");
    ExpectRefused(mesh, kMany, "within ±1e+07 m");
  }
  TriangleMesh wild = UnitBox();
  wild.triangles[3][1] = 8;
  ExpectRefused(wild, kMany, "mesh.triangles[3] names vertex 8; allowed are 0 to 7");
  wild.vertices.clear();
  ExpectRefused(wild, kMany, "there are no vertices");
}

TEST(MeshRefusal, PointsAndPlanets) {
  ExpectRefused(Scaled(UnitBox(), 0.5e-6), kMany, "the diagonal of their box is 8.66");
  ExpectRefused(Scaled(UnitBox(), 0), kMany, "is 0 m");
  ExpectRefused(Box({-9e6, 0, 0}, {9e6, 1, 1}), kMany, "allowed are 1e-06 to 1e+07 m");
  EXPECT_EQ(RefusalOf(Scaled(UnitBox(), 0.6e-6), kMany), std::nullopt);
  EXPECT_EQ(RefusalOf(Scaled(UnitBox(), 5.7e6), kMany), std::nullopt);
  // A stray vertex that no triangle names has no size.
  TriangleMesh stray = UnitBox();
  stray.vertices.push_back({9e6, -9e6, 9e6});
  EXPECT_EQ(RefusalOf(stray, kMany), std::nullopt);
}

TEST(MeshRefusal, PolygonsAddUp) {
  PolygonMesh mesh = AsPolygons(UnitBox());
  mesh.corners.pop_back();
  EXPECT_EQ(RefusalOf(mesh, kMany),
            "mesh.sizes add up to 36 corners, mesh.corners has 35; both must be the same");
  mesh.sizes[2] = kPolygonCornersMax + 1;
  EXPECT_EQ(RefusalOf(mesh, kMany), "mesh.sizes[2] is 1025; a face has at most 1024 corners");
  // Points and lines only: nothing to be a surface.
  EXPECT_TRUE(RefusalOf(PolygonMesh{UnitBox().vertices, {0, 1, 2}, {1, 2}}, kMany).has_value());
  PolygonMesh quads = OnePolygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_TRUE(RefusalOf(quads, 1).has_value());
  EXPECT_EQ(RefusalOf(quads, 2), std::nullopt);
}

TEST(DropDegenerate, OnlyWhatCertainlyHasNoAreaGoes) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3},
                   {0, 0, 1}, {0, 0, 0}, {3, 3, std::nextafter(3, 4)}};
  mesh.triangles = {{0, 1, 3}, {0, 0, 1}, {0, 1, 2}, {0, 4, 3}, {0, 1, 5}};
  EXPECT_EQ(DropDegenerate(&mesh), 3u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 3}, {0, 1, 5}}));
  EXPECT_EQ(mesh.vertices.size(), 6u);
}

/// Twice the vector area: of a flat face, however it is cut.
Vector3d VectorArea(const TriangleMesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (const Triangle& t : mesh.triangles) {
    sum += (mesh.vertices[t[1]] - mesh.vertices[t[0]])
               .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  }
  return sum;
}

/// The areas without regard to side: more than the vector area if triangles overlap.
double TotalArea(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += (mesh.vertices[t[1]] - mesh.vertices[t[0]])
               .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
               .norm();
  }
  return sum;
}

TEST(Triangulate, ConcavePolygonsKeepTheirShape) {
  const std::vector<std::vector<Vector3d>> polygons = {
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}},  // an arrow
      {{0, 0, 0},
       {4, 0, 0},
       {4, 2, 0},
       {1, 2, 0},
       {1, 3, 0},
       {4, 3, 0},
       {4, 5, 0},
       {0, 5, 0}},  // a C
      {{0, 0, 0},
       {1, 0, 0},
       {2, 0, 0},
       {2, 1, 0},
       {2, 2, 0},
       {1, 2, 0},
       {0, 2, 0},
       {0, 1, 0}},  // points on sides
      {{0, 0, 0},
       {4, 0, 0},
       {4, 4, 0},
       {0, 4, 0},
       {0, 0, 0},
       {1, 1, 0},
       {1, 3, 0},
       {3, 3, 0},
       {3, 1, 0},
       {1, 1, 0}},  // a hole, by a bridge
  };
  const double areas[] = {12, 34, 8, 24};
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    // Lying in all directions, both ways round.
    for (int turn = 0; turn < 6; ++turn) {
      auto corners = polygons[i];
      for (Vector3d& p : corners) {
        const Vector3d q = p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = q[(axis + turn) % 3];
        p += (q.x() + 2 * q.y()) * Vector3d(turn == 1, turn == 2, turn == 0);
      }
      if (turn >= 3) std::reverse(corners.begin(), corners.end());
      MeshRepair repair;
      const TriangleMesh mesh = Triangulate(OnePolygon(corners), &repair);
      EXPECT_EQ(mesh.triangles.size(), corners.size() - 2) << i;
      EXPECT_NEAR(TotalArea(mesh), VectorArea(mesh).norm(), 1e-12) << i << " turned " << turn;
      // Sheared, areas are others.
      EXPECT_TRUE(turn < 3 || std::abs(TotalArea(mesh) - areas[i]) < 1e-12);
      EXPECT_EQ(repair.split, 1u);
      EXPECT_EQ(repair.dropped, 0u);
    }
  }
}

TEST(Triangulate, RandomStarPolygons) {
  Random random(81);
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3d> corners;
    const int n = 4 + static_cast<int>(random.Below(40));
    for (int k = 0; k < n; ++k) {
      // Around the origin by equal steps of the half-angle's tangent on each of two half circles.
      const double t = -1 + 4.0 * (k % ((n + 1) / 2)) / n, side = k < (n + 1) / 2 ? 1 : -1;
      const double r = random.Uniform(0.2, 1) / (1 + t * t);
      corners.push_back({side * r * (1 - t * t), side * r * 2 * t, 0});
    }
    MeshRepair repair;
    const TriangleMesh mesh = Triangulate(OnePolygon(corners), &repair);
    ASSERT_NEAR(TotalArea(mesh), std::abs(VectorArea(mesh).z()), 1e-12);
    ASSERT_EQ(mesh.triangles.size() + repair.dropped, corners.size() - 2);
  }
}

TEST(Triangulate, DegenerateFacesAreDroppedAndCounted) {
  PolygonMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.sizes = {3, 2, 1, 3, 5, 1, 4};
  mesh.corners = {0, 1, 3,        // good
                  0, 1,           // a line
                  0,              // a point
                  0, 1, 2,        // no area
                  0, 1, 1, 4, 3,  // a square with a corner twice
                  4,              // a point
                  0, 0, 1, 1};    // a line
  MeshRepair repair;
  const TriangleMesh triangles = Triangulate(mesh, &repair);
  EXPECT_EQ(triangles.triangles.size(), 3u);
  EXPECT_EQ(repair.dropped, 5u);
  EXPECT_EQ(repair.split, 1u);
  EXPECT_EQ(triangles.vertices, mesh.vertices);
}

// A polygon that crosses itself has no right triangles, but its boundary stays: closed stays
// closed.
TEST(Triangulate, BoundaryIsKeptWhateverThePolygon) {
  Random random(82);
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3d> corners;
    for (int k = 0; k < 8; ++k)
      corners.push_back({random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)});
    // The same polygon twice, once each way, is a closed surface.
    PolygonMesh both = OnePolygon(corners);
    for (std::uint32_t k = 8; k-- > 0;) both.corners.push_back(k);
    both.sizes.push_back(8);
    MeshRepair repair;
    ASSERT_TRUE(FactsOf(Triangulate(both, &repair)).closed);
  }
}

}  // namespace
}  // namespace collision::geometry
