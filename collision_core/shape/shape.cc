#include "collision_core/shape/shape.h"

#include <utility>

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

}  // namespace

std::shared_ptr<const Shape> Shape::Build(TriangleMesh mesh, const ShapeOptions& options) {
  std::shared_ptr<Shape> shape(new Shape());
  shape->facts_ = FactsOf(mesh);
  shape->tree_ = BuildOctree(mesh, options);
  shape->component_points_ = ComponentPoints(mesh);
  shape->mesh_ = std::move(mesh);
  SurfaceQuery query(shape->mesh_, shape->tree_);
  for (SphereNode& node : shape->tree_.nodes) {
    node.signed_distance = SignedDistanceAt(node, shape->facts_.closed, &query);
  }
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
         mesh_.triangles.capacity() * sizeof(Triangle) + tree_.bytes() +
         component_points_.capacity() * sizeof(Eigen::Vector3d);
}

}  // namespace collision
