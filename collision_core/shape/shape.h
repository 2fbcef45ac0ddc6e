// The shape of an agent that is more than a ball.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "collision_core/numeric/interval.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/outer_hull.h"
#include "collision_core/shape/packed_tree.h"
#include "collision_core/shape/shape_options.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// Convex solids of one shape at most.
inline constexpr std::size_t kSolidsMax = std::size_t{1} << 16;

/// A surface of triangles, convex solids, or both, with their sphere tree. Immutable once built;
/// shared by all agents of that shape, and between threads.
///
/// Its *elements* are the triangles of the surface, by their numbers, and then the solids. The body
/// is the union of them all, and if the surface is closed of what is inside.
class Shape {
 public:
  /// Requires a mesh that passed RefusalOf() and has no degenerate triangles. Deterministic: the
  /// same mesh and options give the same bits. Takes about 50 µs a triangle, the fitted builder 100.
  /// `twin`, here and below: a shape of the same mesh and solids with another tree; null: none.
  static std::shared_ptr<const Shape> Build(TriangleMesh mesh, const ShapeOptions& options = {},
                                            const Shape* twin = nullptr);

  /// The shape that Build() made of the same mesh, from its tree, without the work. Requires that
  /// RefusalOf(tree, mesh) is nothing; what the tree says of distances is taken on trust.
  static std::shared_ptr<const Shape> FromTree(TriangleMesh mesh, SphereTree tree);

  /// Surface and solids as one. `surface`: made by Build() or FromTree(), or null. Requires one to
  /// kSolidsMax solids.
  static std::shared_ptr<const Shape> Compound(std::shared_ptr<const Shape> surface,
                                               std::vector<ConvexSolid> solids,
                                               const Shape* twin = nullptr);

  /// Twins, whichever was made first: only their trees differ, so that what is known of an agent
  /// with the one holds with the other.
  bool IsSameBodyAs(const Shape& other) const { return body_ == other.body_; }

  /// Of the surface; empty if there is none.
  const TriangleMesh& mesh() const { return surface_ ? surface_->mesh_ : mesh_; }
  const std::vector<ConvexSolid>& solids() const { return solids_; }
  bool IsSolid(std::uint32_t element) const { return element >= mesh().triangles.size(); }
  const ConvexSolid& SolidAt(std::uint32_t element) const {
    return solids_[element - mesh().triangles.size()];
  }

  const MeshFacts& facts() const { return facts_; }
  const SphereTree& tree() const { return tree_; }
  /// The same tree, for traversals.
  const PackedTree& packed() const { return packed_; }
  /// A convex body around triangles and solids.
  const OuterHull& hull() const { return hull_; }

  /// Whether the surface bounds a solid: the triangles and all points of winding number other than
  /// zero. Without a surface: true.
  bool closed() const { return facts_.closed; }

  /// One vertex of each connected component, the one with the greatest x; of each convex solid the
  /// point of its core.
  const std::vector<Eigen::Vector3d>& component_points() const { return component_points_; }

  /// The distance of a point (body frame) to the surface, certified; +infinity if there is none.
  Interval DistanceTo(const Eigen::Vector3d& point) const;

  /// The winding number of the surface about a point (body frame): exact, or nullopt if the point
  /// lies on the surface or too near to tell. Requires closed().
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point) const;

  /// What mesh, solids and tree keep in memory.
  std::size_t bytes() const;

 private:
  Shape() = default;

  TriangleMesh mesh_;
  std::shared_ptr<const Shape> surface_;  ///< Of a compound.
  std::vector<ConvexSolid> solids_;
  MeshFacts facts_;
  SphereTree tree_;
  PackedTree packed_;
  OuterHull hull_;
  std::vector<Eigen::Vector3d> component_points_;
  std::shared_ptr<const char> body_ = std::make_shared<const char>();  ///< One of all twins.
};

}  // namespace collision
