// How a packed tree lies in memory: plain arrays, for wide vectors.
#pragma once

#include <cstdint>

#include "collision_core/base/ids.h"

namespace collision::sphere_tree {

/// Balls in a pack: what one node holds, its children or their children.
inline constexpr std::uint32_t kPackBalls = 8;

/// Triangles in a block: those of one leaf, or a part of them.
inline constexpr std::uint32_t kBlockTriangles = 4;

/// Farther away than any shape reaches, and still finite in sums with other numbers.
inline constexpr float kFarDistance = 0x1p+100f;
/// Farther away than any body, and its square is still finite.
inline constexpr float kFarCoordinate = 0x1p+60f;

/// Balls that are opened together, in single precision, as arrays [m]. A centre is exactly the
/// tree's origin + (x, y, z); the ball about it contains the one of the sphere tree, and the signed
/// distance is that of this centre. Lanes without a ball are at kFarCoordinate and have the radius
/// −kFarDistance and the signed distance kFarDistance, so that they are near nothing.
struct alignas(64) BallPack {
  float x[kPackBalls], y[kPackBalls], z[kPackBalls];
  float radius[kPackBalls];
  float signed_distance[kPackBalls];
  std::uint32_t link[kPackBalls];  ///< What the ball holds: see BallLink.
};

/// Triangles of a leaf, as arrays: x[4 k + i] is corner k of triangle i, seen from the tree's
/// origin and rounded; for k = 3 its normal, about a unit long (zero: none is known). `above` and
/// `below` are the greatest and the least of normal · corner. Lanes without a triangle repeat the
/// first.
struct alignas(64) TriangleBlock {
  float x[4 * kBlockTriangles], y[4 * kBlockTriangles], z[4 * kBlockTriangles];
  float above[kBlockTriangles], below[kBlockTriangles];
  ElementIndex element[kBlockTriangles];  ///< The triangles, or one solid and its repetitions.
  std::uint32_t left;                     ///< Elements of the leaf from this block on.
  float reach;                            ///< No corner is farther from the reference point.
};

}  // namespace collision::sphere_tree
