#include "collision_core/shape/grown_shape.h"

#include <cmath>
#include <utility>
#include <vector>

#include "collision_core/base/check.h"

namespace collision::shape {
namespace {

std::size_t ElementsOf(const Shape& shape) {
  return shape.mesh().triangles.size() + shape.solids().size();
}

/// The triangle as a solid.
ConvexSolid Grown(const geometry::TriangleMesh& mesh, const geometry::Triangle& triangle,
                  double margin) {
  ConvexDescription description;
  description.core = geometry::ConvexCore::kHull;
  for (const std::uint32_t corner : triangle) description.points.push_back(mesh.vertices[corner]);
  description.rounding = margin;
  return ConvexSolid::Build(description);
}

}  // namespace

bool CanGrow(const Shape& shape) { return ElementsOf(shape) <= kGrownElementsMax; }

std::shared_ptr<const Shape> GrownShape(const std::shared_ptr<const Shape>& shape, double margin,
                                        const Shape* twin) {
  CORE_CHECK(CanGrow(*shape), "a shape that grows has few elements", ElementsOf(*shape));
  CORE_CHECK(margin >= kMarginMin && std::isfinite(margin), "a margin is a length", margin);
  const geometry::TriangleMesh& mesh = shape->mesh();
  std::vector<ConvexSolid> solids;
  solids.reserve(ElementsOf(*shape));
  for (const geometry::Triangle& triangle : mesh.triangles) {
    solids.push_back(Grown(mesh, triangle, margin));
  }
  for (const ConvexSolid& solid : shape->solids()) solids.push_back(solid.Grown(margin));
  const bool has_inside = !mesh.triangles.empty() && shape->closed();
  return Shape::Compound(has_inside ? Shape::SurfaceOf(shape) : nullptr, std::move(solids), twin);
}

}  // namespace collision::shape
