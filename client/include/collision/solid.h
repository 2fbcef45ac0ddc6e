// Convex solids: parts of a shape that are exact where triangles could only approximate.
#pragma once

#include <vector>

#include "collision/export.h"
#include "collision/types.h"

namespace collision::client {

/// All points within `rounding_m` of a core of some kind, placed in the agent's body frame. A plain
/// value: the functions below make it, Shape::Make() checks it.
///
///     Solid::Box({0.5, 0.3, 0.1}).Rounded(0.02)
///     Solid::Capsule(0.1, 0.4).At({0.5, 0.3, 0}, {0.5, 0.5, 0.5, 0.5})
///
/// Allowed: lengths from 0 to 10,000 km, a diameter from a micrometre to 10,000 km, each
/// coordinate of a point and of a position within ±10,000 km, 1 to 65,536 points per hull.
struct COLLISION_API Solid {
  enum class Kind { kBall, kCapsule, kBox, kEllipsoid, kHull, kCylinder, kCone };

  Kind kind = Kind::kBall;
  /// Box: half extents. Ellipsoid: half axes. Capsule: z is half its axis without the caps.
  /// Cylinder and cone: x and y are the radius, z is half the length.
  Vector3 half_extents_m{};
  double rounding_m = 0;               ///< Ball and capsule: the radius.
  std::vector<Vector3> points_m = {};  ///< Hull: in any order; inner points are allowed.
  Vector3 position_m{};                ///< Of the solid's frame, in the body frame.
  /// Rotates the solid's axes to the body's: q / |q|, for |q| from 1e-100 to 1e100.
  Quaternion orientation{1, 0, 0, 0};

  /// About the origin of its frame.
  static Solid Ball(double radius_m);

  /// All points within `radius_m` of the segment from −`half_length_m` to `half_length_m` on the z
  /// axis: 2 (half_length_m + radius_m) long.
  static Solid Capsule(double radius_m, double half_length_m);

  /// From −`half_extents_m` to `half_extents_m` along its axes.
  static Solid Box(const Vector3& half_extents_m);

  /// Half axes along x, y, z.
  static Solid Ellipsoid(const Vector3& half_axes_m);

  /// About the z axis, from z = −`half_length_m` to `half_length_m`.
  static Solid Cylinder(double radius_m, double half_length_m);

  /// About the z axis: its base of this radius at z = −`half_length_m`, its apex at
  /// z = `half_length_m`.
  static Solid Cone(double radius_m, double half_length_m);

  /// The smallest convex set around the points; it may be flat or straight.
  static Solid Hull(std::vector<Vector3> points_m);

  /// The same solid at this position and orientation in the body frame; replaces the former ones.
  Solid At(const Vector3& position, const Quaternion& turned = {1, 0, 0, 0}) const;

  /// The same solid grown by `more_m` in every direction, which rounds its edges. Calls add up.
  Solid Rounded(double more_m) const;
};

/// "ball", "capsule", ...
COLLISION_API const char* Name(Solid::Kind kind);

}  // namespace collision::client
