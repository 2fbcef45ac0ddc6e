// Shapes of agents that are more than a ball: triangles and convex solids in the body frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "collision/export.h"
#include "collision/solid.h"
#include "collision/types.h"

namespace collision::client {

/// Triangles of a surface, relative to the reference point [m]; the outside of a face is where its
/// corners run anticlockwise.
struct Triangles {
  std::vector<Vector3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> indices;
};

/// What a shape is made of: a surface, solids, or both. The agent is their union, with what a
/// closed surface encloses.
struct Geometry {
  Triangles triangles = {};
  std::vector<Solid> solids = {};
};

/// Immutable triangles and solids with their content hash. Agents of equal shape share one, and it
/// is sent to the service once. Made by Make().
///
///     Shape::Make({.solids = {Solid::Box({0.5, 0.3, 0.1}),
///                             Solid::Capsule(0.1, 0.4).At({0.5, 0.3, 0})}})
class COLLISION_API Shape {
 public:
  /// Throws std::invalid_argument with the cause and the allowed range for what the service would
  /// refuse: no triangles, more than 5,000,000, a coordinate that is not finite, an index out of
  /// range, a size below a micrometre or above 10,000 km. Degenerate triangles are dropped and
  /// counted. Vertices at one position become one, and unused ones are dropped, which changes no
  /// point of the surface.
  static std::shared_ptr<const Shape> Make(Triangles triangles);

  /// The same with solids. Throws likewise, with number, kind and field of the solid, for a length
  /// or position out of range, an orientation without a length, a hull without points or with too
  /// many, a field that is not 0 and means nothing to the kind; and for more than 65,536 solids or
  /// 1,048,576 points of hulls.
  static std::shared_ptr<const Shape> Make(Geometry geometry);

  const Triangles& triangles() const { return geometry_.triangles; }
  const std::vector<Solid>& solids() const { return geometry_.solids; }
  /// Radius of the smallest ball about the reference point that contains the shape, rounded up.
  double radius_m() const { return radius_m_; }
  /// Whether the surface bounds a solid; true without triangles. An open surface has no inside:
  /// only crossing it is a contact.
  bool closed() const { return closed_; }
  std::size_t dropped() const { return dropped_; }  ///< Degenerate triangles.

  /// What is sent (idl/shape_bytes.h), and its SHA-256.
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

/// Two hexadecimal digits per byte.
COLLISION_API std::string HexText(const std::string& bytes);

}  // namespace collision::client
