// A shape as bytes: what travels in ShapePart, and what the content hash is of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/sha256.h"

namespace collision {

/// Vertices [m] in the body frame, triangles as indices into them.
struct ShapeContent {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

inline constexpr std::uint64_t kShapeHeaderBytes = 16;    ///< Before the first vertex.
inline constexpr std::uint64_t kShapeVertexBytes = 24;    ///< Each.
inline constexpr std::uint64_t kShapeTriangleBytes = 12;  ///< Each.
inline constexpr std::uint64_t kShapeHashBytes = 32;

/// A shape travels in parts of so many bytes; the last one may be shorter, none is empty. As
/// SHAPE_PART_BYTES_MAX in collision.idl.
inline constexpr std::uint64_t kShapePartBytes = 49152;

/// How many parts `total_bytes` make.
constexpr std::uint64_t ShapeParts(std::uint64_t total_bytes) {
  return total_bytes / kShapePartBytes + (total_bytes % kShapePartBytes != 0);
}

/// Little-endian, without padding: the eight bytes "CSHAPE\0\1", u32 vertices, u32 triangles, then
/// each vertex as three IEEE 754 doubles x y z, each triangle as three u32 indices. Throws
/// std::length_error for more than 2^32 - 1 of either.
std::string EncodeShape(const ShapeContent& content);

/// nullopt, with the reason in *error: too short, another format, a length that does not match the
/// counts. Values are not judged: not finite numbers and indices out of range pass.
std::optional<ShapeContent> DecodeShape(const std::string& bytes, std::string* error);

}  // namespace collision
