#include "collision/solid.h"

#include <utility>

namespace collision::client {

Solid Solid::Ball(double radius_m) { return {.kind = Kind::kBall, .rounding_m = radius_m}; }

Solid Solid::Capsule(double radius_m, double half_length_m) {
  return {.kind = Kind::kCapsule, .half_extents_m = {0, 0, half_length_m}, .rounding_m = radius_m};
}

Solid Solid::Box(const Vector3& half_extents_m) {
  return {.kind = Kind::kBox, .half_extents_m = half_extents_m};
}

Solid Solid::Ellipsoid(const Vector3& half_axes_m) {
  return {.kind = Kind::kEllipsoid, .half_extents_m = half_axes_m};
}

Solid Solid::Cylinder(double radius_m, double half_length_m) {
  return {.kind = Kind::kCylinder, .half_extents_m = {radius_m, radius_m, half_length_m}};
}

Solid Solid::Cone(double radius_m, double half_length_m) {
  return {.kind = Kind::kCone, .half_extents_m = {radius_m, radius_m, half_length_m}};
}

Solid Solid::Hull(std::vector<Vector3> points_m) {
  return {.kind = Kind::kHull, .points_m = std::move(points_m)};
}

Solid Solid::At(const Vector3& position, const Quaternion& turned) const {
  Solid placed = *this;
  placed.position_m = position;
  placed.orientation = turned;
  return placed;
}

Solid Solid::Rounded(double more_m) const {
  Solid grown = *this;
  grown.rounding_m += more_m;
  return grown;
}

const char* Name(Solid::Kind kind) {
  switch (kind) {
    case Solid::Kind::kBall:
      return "ball";
    case Solid::Kind::kCapsule:
      return "capsule";
    case Solid::Kind::kBox:
      return "box";
    case Solid::Kind::kEllipsoid:
      return "ellipsoid";
    case Solid::Kind::kCylinder:
      return "cylinder";
    case Solid::Kind::kCone:
      return "cone";
    case Solid::Kind::kHull:
      break;
  }
  return "hull";
}

}  // namespace collision::client
