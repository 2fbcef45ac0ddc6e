// Two bodies at a relative pose.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"

namespace collision::narrow_phase {

/// What rounding may have made of a distance at this pose, computed in doubles from points of these
/// lengths, and of the sums and differences made of it (less than a dozen operations on terms below
/// the lengths' sum): 2^-49 of the sum covers it. A share of 2^-50 for the operations here.
inline double SlackOf(const BodyTree& a, const BodyTree& b, const RelativePose& pose) {
  const double rounding = 0x1p-49 * (a.reach() + b.reach() + pose.offset.cwiseAbs().sum());
  return (rounding + (pose.offset_error + pose.matrix_error * b.reach())) * (1 + 0x1p-50);
}

}  // namespace collision::narrow_phase
