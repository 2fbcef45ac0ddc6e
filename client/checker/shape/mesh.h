// A mesh of triangles with a tree of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client/checker/shape/triangles.h"

namespace collision::checker {

/// Relative to the body's reference point, in body axes [m]. Immutable.
class Mesh {
 public:
  /// A box around the triangles [first, first + triangles), or around its two children.
  struct Node {
    Vector centre;
    Vector half;                  ///< Half its extent along each axis.
    std::uint32_t child = 0;      ///< The first child; the second follows it. Leaf: 0.
    std::uint32_t first = 0;      ///< Leaf: the first triangle.
    std::uint32_t triangles = 0;  ///< 0: not a leaf.
  };

  /// Triangles without area are dropped. Throws std::runtime_error if none is left, a number is not
  /// finite or an index names no vertex.
  Mesh(std::vector<Vector> vertices, const std::vector<std::array<std::uint32_t, 3>>& indices);

  /// A segment, or a point if both ends are equal: one triangle without area, which has distances
  /// but crosses and contains nothing.
  static Mesh OfSegment(const Vector& from, const Vector& to);

  /// The root first.
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Vector>& vertices() const { return vertices_; }

  /// Whether every edge is passed as often one way as the other, with vertices at one place taken
  /// as one. Then the surface bounds a solid: the points with a winding number other than 0.
  bool closed() const { return closed_; }

  /// One vertex of each connected part.
  const std::vector<Vector>& part_points() const { return part_points_; }

  /// Radius of the ball about the reference point that contains it [m].
  double radius_m() const { return radius_m_; }

  /// How often the surface winds around a point off it, by the solid angles of its triangles
  /// (van Oosterom and Strackee, 1983). Requires closed().
  int WindingNumber(const Vector& point) const;

  /// Whether the point is inside the solid; false for an open surface.
  bool Contains(const Vector& point) const;

 private:
  Mesh() = default;
  void FindEdges(const std::vector<std::array<std::uint32_t, 3>>& indices);
  void Build(std::uint32_t node, std::uint32_t first, std::uint32_t count);

  std::vector<Vector> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<Vector> part_points_;
  bool closed_ = false;
  double radius_m_ = 0;
};

}  // namespace collision::checker
