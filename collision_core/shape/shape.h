// The shape of an agent that is more than a ball.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/numeric/interval.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/outer_hull.h"
#include "collision_core/sphere_tree/packed_tree.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::shape {

/// The most convex solids of one shape.
inline constexpr std::size_t kSolidsMax = std::size_t{1} << 16;

/// A surface of triangles, convex solids, or both, with their sphere tree. The façade of shapes for
/// the other rooms. Immutable once built; shared by all agents of that shape, and between threads.
/// Body frame B, metres.
///
/// The *elements* of a shape (ElementIndex) are the triangles of the surface, by their numbers, and
/// then the solids. The body is the union of them all and, if the surface is closed, of its inside.
/// One numbering serves the tree, a search, and the witness of a contact. A solid is a leaf of its
/// own; up to eight near ones at a time are gathered into a ball, and the surface's tree (which the
/// cache keeps) hangs among them unchanged. What is inside a convex solid touches it, so winding
/// numbers are needed for the surface only.
///
/// *Twins* are shapes of one body with different trees, for example a coarse tree and the fitted
/// tree that replaces it. What is certified for an agent with one of them holds for the other.
class Shape {
 public:
  /// Builds a shape of a surface. Takes about 50 µs a triangle, with the fitted builder 100.
  /// Deterministic: the same mesh and options give the same bits. `twin`, here and below: a shape
  /// of the same mesh and solids with another tree; null: none. Requires IsWellFormed(mesh), and
  /// the same mesh and number of solids of a twin. Unchecked: the mesh has no degenerate triangles;
  /// the solids are the twin's.
  static std::shared_ptr<const Shape> Build(geometry::TriangleMesh mesh,
                                            const sphere_tree::ShapeOptions& options = {},
                                            const Shape* twin = nullptr);

  /// Makes the shape that Build() would return for the mesh from its stored tree, without building
  /// it again. The distances in the tree are trusted. Requires IsWellFormed(mesh), and that
  /// RefusalOf(tree, mesh) is nullopt.
  static std::shared_ptr<const Shape> FromTree(geometry::TriangleMesh mesh,
                                               sphere_tree::SphereTree tree);

  /// A surface and solids as one body. Requires a `surface` made by Build() or FromTree(), or null,
  /// and one to kSolidsMax solids.
  static std::shared_ptr<const Shape> Compound(std::shared_ptr<const Shape> surface,
                                               std::vector<ConvexSolid> solids,
                                               const Shape* twin = nullptr);

  /// Whether the two are twins: only their trees differ.
  bool IsSameBodyAs(const Shape& other) const { return body_ == other.body_; }

  /// The surface of a compound, or the shape itself where it has no solids; null: no surface.
  static std::shared_ptr<const Shape> SurfaceOf(const std::shared_ptr<const Shape>& shape) {
    return shape->solids_.empty() ? shape : shape->surface_;
  }

  /// The triangles of the surface; empty if there is none.
  const geometry::TriangleMesh& mesh() const { return surface_ ? surface_->mesh_ : mesh_; }
  const std::vector<ConvexSolid>& solids() const { return solids_; }
  /// Whether an element is a convex solid; else it is a triangle of the surface.
  bool IsSolid(ElementIndex element) const { return element.value() >= mesh().triangles.size(); }
  /// Requires IsSolid(element).
  const ConvexSolid& SolidAt(ElementIndex element) const {
    CORE_CHECK(IsSolid(element), "the element is a convex solid", element.value());
    return solids_[element.value() - mesh().triangles.size()];
  }

  const geometry::MeshFacts& facts() const { return facts_; }
  const sphere_tree::SphereTree& tree() const { return tree_; }
  /// The same tree, for traversals.
  const sphere_tree::PackedTree& packed() const { return packed_; }
  /// A convex body that contains all triangles and solids.
  const OuterHull& hull() const { return hull_; }

  /// Whether the surface bounds a solid: the triangles and all points of winding number other than
  /// zero. Without a surface: true.
  bool closed() const { return facts_.closed; }

  /// One vertex of each connected component, the one with the greatest x; then, for each convex
  /// solid, the point of its core with the greatest x.
  const std::vector<Eigen::Vector3d>& component_points() const { return component_points_; }

  /// The distance of a point (body frame) to the surface, certified; +infinity if there is none.
  numeric::Interval DistanceTo(const Eigen::Vector3d& point) const;

  /// The winding number of the surface about a point (body frame): exact, or nullopt if the point
  /// lies on the surface or too near to tell. Requires closed().
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point) const;

  /// Memory in use by mesh, solids and tree [bytes].
  std::size_t bytes() const;

 private:
  Shape() = default;

  geometry::TriangleMesh mesh_;
  std::shared_ptr<const Shape> surface_;  ///< The surface of a compound.
  std::vector<ConvexSolid> solids_;
  geometry::MeshFacts facts_;
  sphere_tree::SphereTree tree_;
  sphere_tree::PackedTree packed_;
  OuterHull hull_;
  std::vector<Eigen::Vector3d> component_points_;
  std::shared_ptr<const char> body_ = std::make_shared<const char>();  ///< Shared by all twins.
};

}  // namespace collision::shape
