// Two bodies at a relative pose.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"

namespace collision::narrow_phase {

/// The trees of A and B, and B's body frame seen from A's. What it refers to outlives it.
struct PosedPair {
  const BodyTree& a;
  const BodyTree& b;
  const RelativePose& pose;
};

/// An upper bound of what rounding may have made of a distance at this pose [m], computed in
/// doubles from points within the bodies' reaches, and of the sums and differences made of it (less
/// than a dozen operations on terms below the lengths' sum): 2^-49 of the sum covers it. A share of
/// 2^-50 covers the operations here.
inline double SlackOf(const PosedPair& pair) {
  const auto& [a, b, pose] = pair;
  const double rounding = 0x1p-49 * (a.reach() + b.reach() + pose.p_AB.cwiseAbs().sum());
  return (rounding + (pose.offset_error + pose.matrix_error * b.reach())) * (1 + 0x1p-50);
}

}  // namespace collision::narrow_phase
