// A convex solid of the checker: a core, of triangles or round, and a radius around it.
#pragma once

#include <optional>
#include <vector>

#include "client/checker/shape/mesh.h"
#include "client/checker/shape/round_core.h"

namespace collision::checker {

/// Maximum number of points of a hull: finding its faces tests every four of them.
inline constexpr std::size_t kHullPointsMax = 64;

/// All points within `rounding_m` of the core: a point for a ball, a segment for a capsule, a
/// closed surface for a box or hull. In body axes, relative to the reference point [m].
struct Solid {
  Mesh core;
  double rounding_m = 0;
  std::optional<RoundCore> round = std::nullopt;  ///< In place of `core`, which is its centre then.

  double radius_m() const { return (round ? round->radius_m() : core.radius_m()) + rounding_m; }
};

/// The convex hull of the points: closed; or a polygon, a segment or a point (triangles without
/// area) if they have no volume. Tries every plane through three points. Throws std::runtime_error
/// for no points, more than kHullPointsMax, or faces that do not join since points lie within
/// rounding of one plane.
Mesh HullOf(const std::vector<Vector>& points);

/// The corners of a box with these half extents about the origin.
std::vector<Vector> BoxCorners(const Vector& half);

}  // namespace collision::checker
