// A shape as bytes: what travels in ShapePart, and what the content hash is of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace collision {

/// Vertices [m] in the body frame, triangles as indices into them.
struct ShapeContent {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Little-endian, without padding: the eight bytes "CSHAPE\0\1", u32 vertices, u32 triangles, then
/// each vertex as three IEEE 754 doubles x y z, each triangle as three u32 indices.
std::string EncodeShape(const ShapeContent& content);

/// nullopt, with the reason in *error: too short, another format, a length that does not match the
/// counts. Values are not judged: not finite numbers and indices out of range pass.
std::optional<ShapeContent> DecodeShape(const std::string& bytes, std::string* error);

/// SHA-256 (FIPS 180-4): 32 bytes.
std::string Sha256(const std::string& bytes);

}  // namespace collision
