// Goal:   meshes made elsewhere become shapes, closed or open as they are known to be, with
// bounds that hold on both sides.
// Method: exact distances to all triangles, and the sum of solid angles, at some nodes.
#include <gtest/gtest.h>

#include "collision_core/shape/shape.h"
#include "tests/collision_core/geometry/exact_geometry.h"
#include "tests/collision_core/sphere_tree/meshes.h"
#include "tests/support/obj.h"

namespace collision::sphere_tree {
namespace {

struct Known {
  const char* name;
  bool closed;
  std::size_t triangles;
};

class RealMeshes : public testing::TestWithParam<Known> {};

double Length(const Exact& squared) { return std::sqrt(squared.convert_to<double>()); }

TEST_P(RealMeshes, BecomeShapes) {
  const Known& known = GetParam();
  const geometry::PolygonMesh polygons =
      ReadObj(std::string(COLLISION_DATA_DIR "/meshes/") + known.name);
  ASSERT_EQ(RefusalOf(polygons, 100000), std::nullopt);
  geometry::MeshRepair repair;
  geometry::TriangleMesh mesh = Triangulate(polygons, &repair);
  ASSERT_EQ(RefusalOf(mesh, 100000), std::nullopt);
  EXPECT_EQ(mesh.triangles.size(), known.triangles);
  const auto shape = shape::Shape::Build(mesh);
  EXPECT_EQ(shape->closed(), known.closed);

  Random random(91);
  const auto& nodes = shape->tree().nodes;
  const double radius = shape->facts().radius;
  for (int i = 0; i < 20; ++i) {
    const SphereNode& node = nodes[i == 0 ? 0 : random.Below(nodes.size())];
    const Exact exact = SquaredDistance(node.centre, mesh);
    const double s = node.signed_distance;
    ASSERT_TRUE(s < 0 ? Squared(s) <= exact : Squared(s) >= exact);
    ASSERT_NEAR(std::abs(s), Length(exact), 1e-14 * radius);
    if (!known.closed) {
      ASSERT_GE(s, 0);
    } else if (std::abs(s) > 1e-9 * radius) {
      ASSERT_EQ(s<0, std::abs(SolidAngleWinding(mesh, node.centre))> 0.5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Data, RealMeshes,
    testing::Values(Known{"cow.obj", true, 5804}, Known{"fandisk.obj", true, 12946},
                    Known{"homer.obj", true, 12000}, Known{"rocker-arm.obj", true, 20088},
                    Known{"spot.obj", true, 5856}, Known{"stanford-bunny.obj", false, 69451},
                    Known{"suzanne.obj", false, 968}, Known{"teapot.obj", false, 6320},
                    Known{"woody.obj", false, 1267}),
    [](const auto& test) {
      std::string name = test.param.name;
      name.resize(name.find('.'));
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// Genus 1, 80,352 triangles: the largest that is flown.
TEST(RealMesh, SubdividedRockerArmWindsAsItsTrianglesDo) {
  geometry::MeshRepair repair;
  const geometry::TriangleMesh mesh =
      Subdivided(Triangulate(ReadObj(COLLISION_DATA_DIR "/meshes/rocker-arm.obj"), &repair), 1);
  const auto shape = shape::Shape::Build(mesh);
  EXPECT_TRUE(shape->closed());
  EXPECT_EQ(shape->mesh().triangles.size(), 80352u);
  Random random(92);
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = random.Uniform(shape->facts().lower[axis], shape->facts().upper[axis]);
    const auto winding = shape->WindingNumberAt(p);
    ASSERT_TRUE(winding.has_value());
    ASSERT_EQ(double(*winding), std::round(SolidAngleWinding(mesh, p)));
  }
}

}  // namespace
}  // namespace collision::sphere_tree
