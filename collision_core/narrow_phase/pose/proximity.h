// How near two agents are at one instant, and how well that is known.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <numbers>
#include <optional>

#include "collision_core/base/ids.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// What kept a bracket from being narrower.
enum class BracketLimit {
  kNone,     ///< Nothing but rounding.
  kBudget,   ///< The work allowed: more would help.
  kMotion,   ///< What is not known of the motion between two states.
  kGeometry  ///< The shapes: for bodies that overlap only bounds of the depth are known.
};

/// The bracket of the distance at one instant, with point and normal. All of it holds for every
/// motion within the bounds.
struct Proximity {
  /// Distance of the surfaces [m]; for bodies that overlap, minus the penetration depth. upper <=
  /// 0: contact.
  numeric::Interval separation{-numeric::kInfinity, numeric::kInfinity};
  double depth_lower = 0;  ///< Translational penetration depth is at least this [m].
  /// In contact: a point common to both lies within `point_error`. Apart: half-way between the
  /// surfaces where they are nearest, within as much.
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();
  double point_error = numeric::kInfinity;
  /// Unit, from A to B: along the shortest way between the surfaces, or between the centres of two
  /// balls; zero where there is none. Within `normal_error` [rad]; π says nothing.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double normal_error = std::numbers::pi;
  /// The triangle or solid of each body that touches there, or is nearest; none of a ball, and
  /// where only balls of the trees were compared.
  std::optional<ElementIndex> element_A, element_B;
  std::uint32_t level = 0;  ///< The deepest level of the sphere trees that was opened.
  BracketLimit limited_by = BracketLimit::kMotion;
};

}  // namespace collision::narrow_phase
