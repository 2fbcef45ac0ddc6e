// Two bodies at a relative pose.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

/// The trees of A and B, and B's body frame seen from A's. What it refers to outlives it.
struct PosedPair {
  const BodyTree& a;
  const BodyTree& b;
  const RelativePose& pose;
};

/// Relative to the sum of the bodies' reaches and the offset: less than a dozen operations on terms
/// below it, of 2^-53 each.
inline constexpr double kPosedDistanceRounding = 0x1p-49;

/// An upper bound of what rounding may have made of a distance at this pose [m], computed in
/// doubles from points within the bodies' reaches, and of the sums and differences made of it.
inline double SlackOf(const PosedPair& pair) {
  const auto& [a, b, pose] = pair;
  const double rounding =
      kPosedDistanceRounding * (a.reach() + b.reach() + pose.p_AB.cwiseAbs().sum());
  return (rounding + (pose.offset_error + pose.matrix_error * b.reach())) *
         numeric::kFewRoundingsUp;
}

}  // namespace collision::narrow_phase
