// Goal:   no builder makes a tree of a mesh that is not well formed.
// Method: a mesh whose triangle names a vertex that is not there, and one without a triangle.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/sphere_tree/fitted/fitted_builder.h"
#include "collision_core/sphere_tree/median_split/median_split_builder.h"
#include "collision_core/sphere_tree/octree/octree_builder.h"

namespace collision::sphere_tree {
namespace {

TEST(SphereTreePreconditions, AnIllFormedMeshHasNoTree) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const geometry::Triangle& triangle : {geometry::Triangle{0, 1, 3}, {0, 1, 2}}) {
    EXPECT_THROW(BuildFitted(mesh, {}, SurfaceKind::kOpen), CheckFailure);
    EXPECT_THROW(BuildOctree(mesh, {}), CheckFailure);
    EXPECT_THROW(BuildCircumscribedOctree(mesh, {}), CheckFailure);
    EXPECT_THROW(BuildMedianSplit(mesh, {}), CheckFailure);
    mesh.triangles = {triangle};
  }
  EXPECT_NO_THROW(BuildOctree(mesh, {}));
}

}  // namespace
}  // namespace collision::sphere_tree
