// The shape of an agent that is more than a ball: triangles in its body frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/types.h"

namespace collision::client {

/// Triangles of a surface, about the reference point [m]; outward is where a face is seen
/// anticlockwise.
struct Triangles {
  std::vector<Vector3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> indices;
};

/// An immutable mesh with its content hash; agents of equal shape share one, and it travels to the
/// service once. Made by Make() or LoadShape() (client/mesh_file.h).
class Shape {
 public:
  /// Throws std::invalid_argument, naming what is wrong and the allowed range, on what the service
  /// would refuse: no triangles, not finite, an index out of range, too many, a size that is a point
  /// or a planet. Degenerate triangles are dropped, and counted; vertices at the same position
  /// become one and those that no triangle uses go, which changes no point of the surface.
  static std::shared_ptr<const Shape> Make(Triangles triangles);

  const Triangles& triangles() const { return triangles_; }
  /// Of the smallest ball about the reference point that contains it, rounded up.
  double radius_m() const { return radius_m_; }
  /// It bounds a solid. An open surface has no inside: only crossing triangles are a contact.
  bool closed() const { return closed_; }
  std::size_t dropped() const { return dropped_; }  ///< Degenerate triangles.

  /// What travels (idl/shape_bytes.h) and its SHA-256.
  const std::string& bytes() const { return bytes_; }
  const std::string& hash() const { return hash_; }

 private:
  Shape() = default;
  Triangles triangles_;
  double radius_m_ = 0;
  bool closed_ = false;
  std::size_t dropped_ = 0;
  std::string bytes_;
  std::string hash_;
};

/// A hash as people read it: two hexadecimal digits a byte.
std::string HexText(const std::string& bytes);

}  // namespace collision::client
