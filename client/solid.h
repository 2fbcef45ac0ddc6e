// A convex solid: a part of an agent's shape, exact, where triangles would only come near.
#pragma once

#include <vector>

#include "client/types.h"

namespace collision::client {

/// All points at most `rounding_m` away from a core of some kind, placed in the agent's body frame.
/// Plain values: made by the functions below, judged when it becomes part of a Shape.
///
///     Solid::Box({0.5, 0.3, 0.1}).Rounded(0.02)
///     Solid::Capsule(0.1, 0.4).At({0.5, 0.3, 0}, {0.5, 0.5, 0.5, 0.5})
///
/// Allowed: lengths from 0 to 10,000 km, a diameter from a micrometre to 10,000 km, nothing further
/// than 10,000 km from the reference point, 1 to 65,536 points of a hull.
struct Solid {
  enum class Kind { kBall, kCapsule, kBox, kEllipsoid, kHull };

  Kind kind = Kind::kBall;
  /// Of a box; of an ellipsoid its half axes; of a capsule z counts: half its axis without the caps.
  Vector3 half_extents_m{};
  double rounding_m = 0;               ///< The radius of a ball or capsule.
  std::vector<Vector3> points_m = {};  ///< Of a hull: in any order, inner ones too.
  Vector3 position_m{};                ///< Of the solid's frame, in the body frame.
  /// Of the solid's frame: its axes to the body's. Of any length but 0: the rotation q / |q|.
  Quaternion orientation{1, 0, 0, 0};

  /// About its origin.
  static Solid Ball(double radius_m);

  /// All points within `radius_m` of the segment from −`half_length_m` to `half_length_m` on the z
  /// axis: 2 (half_length_m + radius_m) long.
  static Solid Capsule(double radius_m, double half_length_m);

  /// From −`half_extents_m` to `half_extents_m` along its axes.
  static Solid Box(const Vector3& half_extents_m);

  /// Half axes along x, y, z.
  static Solid Ellipsoid(const Vector3& half_axes_m);

  /// The smallest convex solid around the points. A flat or straight one has no inside, and touches.
  static Solid Hull(std::vector<Vector3> points_m);

  /// Below z = 0 of its frame, as far as `reach_m` from its origin each way: a half-space for all that
  /// stays there, with a radius, as every agent has one. A hull of eight corners: distances are known
  /// to some 64 · 2^-53 of its size, 20 nm for a reach of 1,000 km.
  static Solid HalfSpace(double reach_m);

  /// The same at another place of the body frame, and turned there; instead of where it was.
  Solid At(const Vector3& position, const Quaternion& turned = {1, 0, 0, 0}) const;

  /// Grown by `more_m` all round, which makes edges round. Each call adds.
  Solid Rounded(double more_m) const;
};

/// "ball", "capsule", ...
const char* Name(Solid::Kind kind);

}  // namespace collision::client
