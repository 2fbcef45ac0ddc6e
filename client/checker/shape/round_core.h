// Convex cores with curved surfaces: ellipsoids, cylinders and cones.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "client/checker/shape/vector.h"

namespace collision::checker {

/// About the z axis of its own frame, with its middle at the origin, then turned and moved into the
/// body's axes [m]. Immutable.
class RoundCore {
 public:
  /// A cone has its base at −half.z, its apex at half.z.
  enum class Kind { kEllipsoid, kCylinder, kCone };

  /// "ellipsoid", "cylinder", "cone"; nullopt: none of them.
  static std::optional<Kind> KindOf(const std::string& word);

  /// `half`: of an ellipsoid the half axes; of the others x = y is the radius, z half the length.
  /// Throws std::runtime_error for a negative one, or an orientation (w, x, y, z) without length.
  RoundCore(Kind kind, const Vector& half, const std::array<double, 4>& q, const Vector& p);

  /// A point of it that is furthest along `direction`, in body axes. Any length will do.
  Vector Support(const Vector& direction) const;

  /// Its middle, a point of it.
  const Vector& centre() const { return p_; }

  /// Of a ball about the centre that contains it [m].
  double reach() const;

  /// Of the smallest ball about the reference point that contains it, to rounding [m].
  double radius_m() const;

 private:
  Kind kind_;
  Vector half_;
  std::array<Vector, 3> axes_;  // its own, in those of the body
  Vector p_;
};

}  // namespace collision::checker
