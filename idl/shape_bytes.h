// A shape as bytes: what travels in ShapePart, and what the content hash is of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/limits.h"
#include "idl/sha256.h"

namespace collision {

/// What a convex solid is, as a number in its bytes.
enum class SolidKind : std::uint32_t {
  kBall = 1,       ///< A point, rounded.
  kCapsule = 2,    ///< A segment along z, rounded; half its length is half_extents[2].
  kBox = 3,        ///< May be rounded.
  kEllipsoid = 4,  ///< The half axes are half_extents.
  kHull = 5,       ///< Of `points`; may be rounded.
  kCylinder = 6,   ///< half_extents: its radius twice, half its length along z; may be rounded.
  kCone = 7        ///< Likewise; its apex is at +z, the centre of its base at −z.
};

/// A convex solid in a frame of its own: all points at most `rounding` [m] away from its core.
struct SolidContent {
  SolidKind kind = SolidKind::kBall;
  std::array<double, 3> position{};                ///< Of its frame, in the body frame [m].
  std::array<double, 4> orientation{1, 0, 0, 0};   ///< w, x, y, z: its frame to the body frame.
  std::array<double, 3> half_extents{};            ///< [m]
  double rounding = 0;                             ///< [m]
  std::vector<std::array<double, 3>> points = {};  ///< Of a hull, in its frame [m].
};

/// A surface of triangles, convex solids, or both: the agent is all of it together.
struct ShapeContent {
  std::vector<std::array<double, 3>> vertices;          ///< In the body frame [m].
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< As indices of vertices.
  std::vector<SolidContent> solids = {};
};

inline constexpr std::uint64_t kShapeHeaderBytes = 16;    ///< Before the first vertex, version 1.
inline constexpr std::uint64_t kSolidHeaderBytes = 8;     ///< So many more in version 2.
inline constexpr std::uint64_t kSolidBytes = 96;          ///< Each, without its points.
inline constexpr std::uint64_t kShapeVertexBytes = 24;    ///< Each.
inline constexpr std::uint64_t kShapeTriangleBytes = 12;  ///< Each.
inline constexpr std::uint64_t kShapeHashBytes = 32;

/// How many parts `total_bytes` make.
constexpr std::uint64_t ShapeParts(std::uint64_t total_bytes) {
  return total_bytes / wire::kShapePartBytes + (total_bytes % wire::kShapePartBytes != 0);
}

/// Little-endian, without padding: the eight bytes "CSHAPE\0\1", u32 vertices, u32 triangles, then
/// each vertex as three IEEE 754 doubles x y z, each triangle as three u32 indices.
///
/// With solids "CSHAPE\0\2", u32 vertices, u32 triangles, u32 solids, u32 points of all hulls, then
/// vertices and triangles as above, then each solid as u32 kind, u32 points and eleven doubles
/// (position, orientation, half extents, rounding), then all points as vertices. So a mesh alone
/// has the same bytes, and the same hash, as ever.
///
/// Throws std::length_error for more than 2^32 - 1 of any.
std::string EncodeShape(const ShapeContent& content);

/// nullopt, with the reason in *error: too short, another format, a length that does not match the
/// counts. Values are not judged: not finite numbers, indices out of range and unknown kinds pass.
std::optional<ShapeContent> DecodeShape(const std::string& bytes, std::string* error);

}  // namespace collision
