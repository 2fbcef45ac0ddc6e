// Triangles as an agent's surface: what is taken, what is repaired, what is refused.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace collision {

using Triangle = std::array<std::uint32_t, 3>;

/// In the body frame B, whose origin is the agent's reference point [m]. Outward is where a face is
/// seen anticlockwise.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

/// Smaller is a point, larger a planet: most likely the unit is not the one meant [m]. Of the
/// diagonal of the mesh's box.
inline constexpr double kMeshSizeMin = 1e-6;
inline constexpr double kMeshSizeMax = 1e7;

/// Faces with any number of corners: `corners` holds them one after the other, `sizes` how many
/// each has.
struct PolygonMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> sizes;
};

/// What became of the faces.
struct MeshRepair {
  std::size_t split = 0;    ///< Faces of more than three corners, cut into triangles.
  std::size_t dropped = 0;  ///< Degenerate: a corner twice, no area, or fewer than three corners.
};

/// Cuts polygons into triangles (ear clipping in the polygon's plane, so that non-convex ones keep
/// their shape) and drops degenerate faces, counted. Vertices stay as they are. Requires indices
/// within range.
TriangleMesh Triangulate(const PolygonMesh& polygons, MeshRepair* repair);

/// Drops degenerate triangles: two equal corners (by index or by position), or certified without
/// area (all three on a line, exactly). Returns how many.
std::size_t DropDegenerate(TriangleMesh* mesh);

/// Why a mesh cannot be an agent's shape, as a sentence with the value and the allowed range:
/// no triangles, not finite, an index out of range, more than `triangles_max`, size out of range.
/// nullopt: it can.
std::optional<std::string> RefusalOf(const TriangleMesh& mesh, std::size_t triangles_max);
std::optional<std::string> RefusalOf(const PolygonMesh& mesh, std::size_t triangles_max);

/// Facts of a mesh that passed RefusalOf() and has no degenerate triangle.
struct MeshFacts {
  /// The oriented edge chain sums to zero: every edge is passed as often one way as the other, where
  /// vertices at the same position count as one.
  bool closed = false;
  std::size_t components = 0;    ///< Connected through vertices (by position).
  double radius = 0;             ///< Of the ball about the origin that contains it, rounded up [m].
  Eigen::Vector3d lower, upper;  ///< Its box.
};
MeshFacts FactsOf(const TriangleMesh& mesh);

}  // namespace collision
