// Triangles as an agent's surface: which meshes are accepted, repaired or refused.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace collision::geometry {

/// Indices of three vertices, anticlockwise as seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// In the body frame B, whose origin is the agent's reference point [m]. Outward is where a face is
/// seen anticlockwise.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

/// Allowed diagonals of the mesh's box [m]. A mesh outside this range most likely uses another unit
/// than the one stated.
inline constexpr double kMeshSizeMin = 1e-6;
inline constexpr double kMeshSizeMax = 1e7;

/// The largest allowed distance of a coordinate from the reference point [m]: a body farther from
/// the point about which it turns is most likely given in the wrong frame.
inline constexpr double kMeshReachMax = 1e7;

/// The most corners of one face: cutting a polygon costs the cube of their number at worst.
inline constexpr std::size_t kPolygonCornersMax = 1024;

/// Faces with any number of corners: `corners` holds them one after the other, `sizes` how many
/// each has.
struct PolygonMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> sizes;
};

/// What Triangulate() changed.
struct MeshRepair {
  std::size_t split = 0;  ///< Faces of more than three corners, cut into triangles.
  /// Faces with fewer than three corners once consecutive equal ones are merged, and degenerate
  /// triangles (DropDegenerate()).
  std::size_t dropped = 0;
};

/// Cuts polygons into triangles (ear clipping in the polygon's plane, so that non-convex ones keep
/// their shape) and drops degenerate faces, counted. Vertices stay as they are. A polygon that
/// crosses itself becomes some triangles with the same boundary. Requires a mesh that passed
/// RefusalOf().
TriangleMesh Triangulate(const PolygonMesh& polygons, MeshRepair* repair);

/// Drops degenerate triangles: two equal corners (by index or by position), or certified without
/// area (all three on a line, exactly). Returns how many.
std::size_t DropDegenerate(TriangleMesh* mesh);

/// Why a mesh cannot be an agent's shape, as a sentence with the value and the allowed range: no
/// triangles, a number that is not finite, an index out of range, more than `triangles_max`
/// triangles, size or place out of range. nullopt: it can. Test again after a repair, which may
/// leave no triangle.
std::optional<std::string> RefusalOf(const TriangleMesh& mesh, std::size_t triangles_max);
/// At least one triangle, and all corners are vertices of the mesh: what every function of a mesh
/// needs. RefusalOf() is narrower, for meshes that others send.
bool IsWellFormed(const TriangleMesh& mesh);
/// The same for polygons; a face with more than kPolygonCornersMax corners is refused as well.
std::optional<std::string> RefusalOf(const PolygonMesh& mesh, std::size_t triangles_max);

/// Facts of a mesh that passed RefusalOf() and has no degenerate triangle.
///
/// A mesh is *closed* if its oriented edge chain sums to zero: vertices at one position are one,
/// and every edge is passed as often one way as the other. That is exactly when the winding number
/// is defined off the surface. It asks for no manifold, so meshes that cross themselves, nest or
/// touch are accepted. The solid is then the triangles and all points of winding number other than
/// 0: a surface within another of the same orientation makes no hole, one of the opposite
/// orientation does. A mesh with a single gap has no inside; it is an open surface.
///
/// Triangles without area that fill a T-junction (a vertex on a neighbour's edge) have been dropped
/// as degenerate by now. If the edge chain closed only through them, the mesh counts as open. That
/// is safe, and the owner is told.
struct MeshFacts {
  /// The oriented edge chain sums to zero, where vertices at the same position count as one.
  bool closed = false;
  std::size_t components = 0;    ///< Parts connected through vertices (by position).
  double radius = 0;             ///< Radius of a ball about the origin that contains the mesh [m].
  Eigen::Vector3d lower, upper;  ///< Its box [m]. Vertices without a triangle are not counted.
};
/// Computes the facts; linear in the mesh but for sorting its edges. Requires IsWellFormed(mesh).
/// Unchecked: it has no degenerate triangle.
MeshFacts FactsOf(const TriangleMesh& mesh);

/// One vertex of each connected component, the one with the greatest x (of equal ones, the greatest
/// y, then z); components in the order of their first triangles. Requires IsWellFormed(mesh).
std::vector<Eigen::Vector3d> ComponentPoints(const TriangleMesh& mesh);

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> MergedVertices(const TriangleMesh& mesh);

}  // namespace collision::geometry
