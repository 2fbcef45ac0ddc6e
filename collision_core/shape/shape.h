// The shape of an agent that is more than a ball.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "collision_core/numeric/interval.h"
#include "collision_core/shape/packed_tree.h"
#include "collision_core/shape/shape_options.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// A mesh with its sphere tree. Immutable once built; shared by all agents of that shape, and
/// between threads.
class Shape {
 public:
  /// Requires a mesh that passed RefusalOf() and has no degenerate triangles. Deterministic: the
  /// same mesh and options give the same bits. Takes about 50 µs a triangle, the fitted builder 100.
  static std::shared_ptr<const Shape> Build(TriangleMesh mesh, const ShapeOptions& options = {});

  /// The shape that Build() made of the same mesh, from its tree, without the work. Requires that
  /// RefusalOf(tree, mesh) is nothing; what the tree says of distances is taken on trust.
  static std::shared_ptr<const Shape> FromTree(TriangleMesh mesh, SphereTree tree);

  const TriangleMesh& mesh() const { return mesh_; }
  const MeshFacts& facts() const { return facts_; }
  const SphereTree& tree() const { return tree_; }
  /// The same tree, for traversals.
  const PackedTree& packed() const { return packed_; }

  /// Whether it bounds a solid: the triangles and all points of winding number other than zero.
  bool closed() const { return facts_.closed; }

  /// One vertex of each connected component, the one with the greatest x.
  const std::vector<Eigen::Vector3d>& component_points() const { return component_points_; }

  /// The distance of a point (body frame) to the surface, certified.
  Interval DistanceTo(const Eigen::Vector3d& point) const;

  /// The winding number of the surface about a point (body frame): exact, or nullopt if the point
  /// lies on the surface or too near to tell. Requires closed().
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point) const;

  /// What mesh and tree keep in memory.
  std::size_t bytes() const;

 private:
  Shape() = default;

  TriangleMesh mesh_;
  MeshFacts facts_;
  SphereTree tree_;
  PackedTree packed_;
  std::vector<Eigen::Vector3d> component_points_;
};

}  // namespace collision
