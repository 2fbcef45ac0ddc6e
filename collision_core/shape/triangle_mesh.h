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

/// No coordinate may be farther from the reference point [m]: a body that far from the point it is
/// said to turn about is a mistake of frames.
inline constexpr double kMeshReachMax = 1e7;

/// Corners of one face: cutting a polygon costs the cube of them at worst.
inline constexpr std::size_t kPolygonCornersMax = 1024;

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
/// their shape) and drops degenerate faces, counted. Vertices stay as they are. A polygon that
/// crosses itself becomes some triangles with the same boundary. Requires a mesh that passed
/// RefusalOf().
TriangleMesh Triangulate(const PolygonMesh& polygons, MeshRepair* repair);

/// Drops degenerate triangles: two equal corners (by index or by position), or certified without
/// area (all three on a line, exactly). Returns how many.
std::size_t DropDegenerate(TriangleMesh* mesh);

/// Why a mesh cannot be an agent's shape, as a sentence with the value and the allowed range:
/// no triangles, not finite, an index out of range, more than `triangles_max`, size or place out of
/// range, a face with too many corners. nullopt: it can. A mesh that was repaired is to be asked
/// again: nothing may be left of it.
std::optional<std::string> RefusalOf(const TriangleMesh& mesh, std::size_t triangles_max);
std::optional<std::string> RefusalOf(const PolygonMesh& mesh, std::size_t triangles_max);

/// Facts of a mesh that passed RefusalOf() and has no degenerate triangle.
struct MeshFacts {
  /// The oriented edge chain sums to zero: every edge is passed as often one way as the other, where
  /// vertices at the same position count as one.
  bool closed = false;
  std::size_t components = 0;    ///< Connected through vertices (by position).
  double radius = 0;             ///< Of the ball about the origin that contains it, rounded up [m].
  Eigen::Vector3d lower, upper;  ///< Its box. Vertices without a triangle count nowhere.
};
MeshFacts FactsOf(const TriangleMesh& mesh);

/// One vertex of each connected component, the one with the greatest x (of equal ones, the greatest
/// y, then z); components in the order of their first triangles.
std::vector<Eigen::Vector3d> ComponentPoints(const TriangleMesh& mesh);

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> MergedVertices(const TriangleMesh& mesh);

}  // namespace collision
