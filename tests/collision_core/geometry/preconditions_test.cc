// Goal:   a stated precondition that does not hold throws.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/geometry/convex/convex_points.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/geometry/triangle/enclosing_ball.h"
#include "collision_core/geometry/triangle/triangle_pair.h"

namespace collision::geometry {
namespace {

TEST(GeometryPreconditions, CoordinatesHaveFiniteSquares) {
  const std::vector<Eigen::Vector3d> far = {{0, 0, 0}, {0, -1e100, 0}};
  EXPECT_THROW(ConvexPoints{far}, CheckFailure);
  EXPECT_THROW(SmallBallAround(far), CheckFailure);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector3d> unknown = {{0, 0, 0}, {0, nan, 0}, {1, 0, 0}};
  EXPECT_THROW(ConvexPoints{unknown}, CheckFailure);
}

TEST(GeometryPreconditions, AnIllFormedMeshHasNoFacts) {
  TriangleMesh mesh;
  EXPECT_THROW(FactsOf(mesh), CheckFailure);
  EXPECT_THROW(ComponentPoints(mesh), CheckFailure);
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(FactsOf(mesh), CheckFailure);
  EXPECT_THROW(ComponentPoints(mesh), CheckFailure);
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(FactsOf(mesh).components, ComponentPoints(mesh).size());
}

TEST(GeometryPreconditions, RefusedPolygonsAreNotCut) {
  PolygonMesh polygons;
  polygons.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  polygons.corners = {0, 1, 3};
  polygons.sizes = {3};
  MeshRepair repair;
  EXPECT_THROW(Triangulate(polygons, &repair), CheckFailure);
  polygons.corners[2] = 2;
  EXPECT_EQ(Triangulate(polygons, &repair).triangles.size(), 1u);
}

TEST(GeometryPreconditions, AnUncertaintyIsANumberNotBelowZero) {
  const TrianglePoints a = {Eigen::Vector3d(0, 0, 0), {2, 0, 0}, {0, 2, 0}};
  const TrianglePoints b = {Eigen::Vector3d(0.5, 0.5, -1), {0.5, 0.5, 1}, {0.5, 3, 0}};
  EXPECT_TRUE(CertainCrossing(a, b, 0));
  EXPECT_THROW(CertainCrossing(a, b, -1e-9), CheckFailure);
  EXPECT_THROW(CertainCrossing(a, b, std::numeric_limits<double>::quiet_NaN()), CheckFailure);
}

}  // namespace
}  // namespace collision::geometry
