// Goal:   a body that would be refused is not built.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/shape/outer_hull.h"
#include "collision_core/shape/shape.h"

namespace collision::shape {
namespace {

geometry::TriangleMesh OneTriangle() {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(ShapePreconditions, AnIllFormedMeshMakesNoSurface) {
  EXPECT_NO_THROW(Shape::Build(OneTriangle()));
  EXPECT_THROW(Shape::Build({}), CheckFailure);
  geometry::TriangleMesh mesh = OneTriangle();
  mesh.triangles[0][2] = 3;
  EXPECT_THROW(Shape::Build(mesh), CheckFailure);
}

TEST(ShapePreconditions, AnIllFormedMeshHasNoTree) {
  geometry::TriangleMesh mesh = OneTriangle();
  const sphere_tree::SphereTree tree = Shape::Build(mesh)->tree();
  EXPECT_NO_THROW(Shape::FromTree(mesh, tree));
  mesh.triangles[0][2] = 3;
  EXPECT_THROW(Shape::FromTree(mesh, tree), CheckFailure);
}

TEST(ShapePreconditions, ATwinIsOfTheSameSurface) {
  const std::shared_ptr<const Shape> shape = Shape::Build(OneTriangle());
  EXPECT_TRUE(Shape::Build(OneTriangle(), {}, shape.get())->IsSameBodyAs(*shape));
  geometry::TriangleMesh moved = OneTriangle(), turned = OneTriangle();
  moved.vertices[1].x() = 2;
  EXPECT_THROW(Shape::Build(moved, {}, shape.get()), CheckFailure);
  turned.triangles[0] = {0, 2, 1};
  EXPECT_THROW(Shape::Build(turned, {}, shape.get()), CheckFailure);
}

TEST(ShapePreconditions, ATwinHasAsManySolids) {
  ConvexDescription description;
  description.rounding = 1;
  const ConvexSolid ball = ConvexSolid::Build(description);
  const std::shared_ptr<const Shape> surface = Shape::Build(OneTriangle());
  const std::shared_ptr<const Shape> one = Shape::Compound(surface, {ball});
  EXPECT_TRUE(Shape::Compound(surface, {ball}, one.get())->IsSameBodyAs(*one));
  EXPECT_THROW(Shape::Compound(surface, {ball, ball}, one.get()), CheckFailure);
  EXPECT_THROW(Shape::Compound(nullptr, {ball}, one.get()), CheckFailure);
  EXPECT_THROW(Shape::Build(OneTriangle(), {}, one.get()), CheckFailure);
}

TEST(ShapePreconditions, ARefusedDescriptionMakesNoSolid) {
  ConvexDescription description;
  EXPECT_THROW(ConvexSolid::Build(description), CheckFailure) << "a ball of no size";
  description.core = geometry::ConvexCore::kHull;
  description.rounding = 1;
  EXPECT_THROW(ConvexSolid::Build(description), CheckFailure) << "a hull of no points";
}

TEST(ShapePreconditions, ACompoundIsOfASurfaceAndSolids) {
  ConvexDescription description;
  description.rounding = 1;
  const ConvexSolid ball = ConvexSolid::Build(description);
  EXPECT_THROW(Shape::Compound(Shape::Build(OneTriangle()), {}), CheckFailure);
  EXPECT_THROW(Shape::Compound(Shape::Compound(nullptr, {ball}), {ball}), CheckFailure);
}

TEST(ShapePreconditions, AHullIsAroundPointsWithinSinglePrecision) {
  const std::vector<Eigen::Vector3d> far = {{0, 0, 0}, {0, 1e15, 0}};
  EXPECT_THROW(OuterHull(far, 0), CheckFailure);
  EXPECT_THROW(OuterHull({}, 0), CheckFailure);
}

}  // namespace
}  // namespace collision::shape
