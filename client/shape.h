// The shape of an agent that is more than a ball: triangles and convex solids in its body frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/solid.h"
#include "client/types.h"

namespace collision::client {

/// Triangles of a surface, about the reference point [m]; outward is where a face is seen
/// anticlockwise.
struct Triangles {
  std::vector<Vector3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> indices;
};

/// What a shape is made of: a surface, solids, or both. The agent is all of it together, and what a
/// closed surface encloses.
struct Geometry {
  Triangles triangles = {};
  std::vector<Solid> solids = {};
};

/// Immutable triangles and solids with their content hash; agents of equal shape share one, and it
/// travels to the service once. Made by Make() or LoadShape() (client/mesh_file.h).
///
///     Shape::Make({.solids = {Solid::Box({0.5, 0.3, 0.1}),
///                             Solid::Capsule(0.1, 0.4).At({0.5, 0.3, 0})}})
class Shape {
 public:
  /// Throws std::invalid_argument, naming what is wrong and the allowed range, on what the service
  /// would refuse: no triangles, not finite, an index out of range, too many, a size that is a point
  /// or a planet. Degenerate triangles are dropped, and counted; vertices at the same position
  /// become one and those that no triangle uses go, which changes no point of the surface.
  static std::shared_ptr<const Shape> Make(Triangles triangles);

  /// The same with solids. Of these is refused, by number, kind and field: a length or place that is
  /// negative, not finite or out of range, a size that is a point or a planet, an orientation without
  /// a length, no points or too many, a field that means nothing to the kind and is not 0; more than
  /// 65,536 solids or 1,048,576 points of hulls.
  static std::shared_ptr<const Shape> Make(Geometry geometry);

  const Triangles& triangles() const { return geometry_.triangles; }
  const std::vector<Solid>& solids() const { return geometry_.solids; }
  /// Of the smallest ball about the reference point that contains it, rounded up.
  double radius_m() const { return radius_m_; }
  /// The surface bounds a solid, or there is none. An open surface has no inside: only what crosses
  /// it is a contact.
  bool closed() const { return closed_; }
  std::size_t dropped() const { return dropped_; }  ///< Degenerate triangles.

  /// What travels (idl/shape_bytes.h) and its SHA-256.
  const std::string& bytes() const { return bytes_; }
  const std::string& hash() const { return hash_; }

 private:
  Shape() = default;
  Geometry geometry_;
  double radius_m_ = 0;
  bool closed_ = false;
  std::size_t dropped_ = 0;
  std::string bytes_;
  std::string hash_;
};

/// A hash as people read it: two hexadecimal digits a byte.
std::string HexText(const std::string& bytes);

}  // namespace collision::client
