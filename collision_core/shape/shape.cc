#include "collision_core/shape/shape.h"

#include <utility>

#include "collision_core/shape/fitted_builder.h"
#include "collision_core/shape/octree_builder.h"
#include "collision_core/shape/surface_query.h"

namespace collision {
namespace {

/// Negative only where certain: inside a closed solid the ball of that radius meets no triangle.
double SignedDistanceAt(const SphereNode& node, bool closed, SurfaceQuery* query) {
  // The node's ball contains some of the surface, so its radius bounds the distance.
  const Interval distance = query->DistanceTo(node.centre, node.radius);
  if (!closed || query->WindingNumberAt(node.centre).value_or(0) == 0) return distance.upper;
  return -distance.lower;
}

void MeasureCentres(const TriangleMesh& mesh, bool closed, SphereTree* tree) {
  SurfaceQuery query(mesh, *tree);
  for (SphereNode& node : tree->nodes)
    node.signed_distance = SignedDistanceAt(node, closed, &query);
}

}  // namespace

std::shared_ptr<const Shape> Shape::Build(TriangleMesh mesh, const ShapeOptions& options) {
  std::shared_ptr<Shape> shape(new Shape());
  shape->facts_ = FactsOf(mesh);
  const bool fitted = options.builder == TreeBuilder::kFitted;
  shape->tree_ =
      fitted ? BuildFitted(mesh, options, shape->facts_.closed) : BuildOctree(mesh, options);
  shape->component_points_ = ComponentPoints(mesh);
  shape->mesh_ = std::move(mesh);
  if (!fitted) MeasureCentres(shape->mesh_, shape->facts_.closed, &shape->tree_);
  shape->packed_ = PackedTree(shape->mesh_, shape->tree_);
  return shape;
}

std::shared_ptr<const Shape> Shape::FromTree(TriangleMesh mesh, SphereTree tree) {
  std::shared_ptr<Shape> shape(new Shape());
  shape->facts_ = FactsOf(mesh);
  shape->tree_ = std::move(tree);
  shape->component_points_ = ComponentPoints(mesh);
  shape->mesh_ = std::move(mesh);
  shape->packed_ = PackedTree(shape->mesh_, shape->tree_);
  return shape;
}

Interval Shape::DistanceTo(const Eigen::Vector3d& point) const {
  return SurfaceQuery(mesh_, tree_).DistanceTo(point, kInfinity);
}

std::optional<int> Shape::WindingNumberAt(const Eigen::Vector3d& point) const {
  const bool is_outside_box =
      (point.array() < facts_.lower.array()).any() || (point.array() > facts_.upper.array()).any();
  if (is_outside_box) return 0;
  return SurfaceQuery(mesh_, tree_).WindingNumberAt(point);
}

std::size_t Shape::bytes() const {
  return sizeof *this + mesh_.vertices.capacity() * sizeof(Eigen::Vector3d) +
         mesh_.triangles.capacity() * sizeof(Triangle) + tree_.bytes() + packed_.bytes() +
         component_points_.capacity() * sizeof(Eigen::Vector3d);
}

}  // namespace collision
