// The direction in which two surfaces approach each other before a contact.
#pragma once

#include <Eigen/Core>

namespace collision::narrow_phase {

/// A normal with a smaller error is good enough for a response to the contact [rad].
inline constexpr double kGoodNormal = 0.3;

/// The direction of the shortest way between two surfaces, shortly before they may touch.
struct ContactNormal {
  bool known = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Unit, from A to B, in the world.
  double error = 0;                                  ///< The true one is within this [rad].

  /// Whether the error is small enough; else an earlier instant is evaluated as well.
  bool is_good() const { return known && error < kGoodNormal; }
};

}  // namespace collision::narrow_phase
