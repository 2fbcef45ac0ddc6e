// Whether one body is inside the other, where their surfaces are apart.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {

/// Whether one of two solids whose surfaces are certainly apart is inside the other. One point of
/// each connected component decides, because the components are apart. If the work ends before all
/// components are tested, nothing is certain.
struct Containment {
  bool neither = false;  ///< Certainly neither is inside the other, not even in part.
  /// A point of one that is certainly inside the other, in A's body frame, within `point_error`;
  /// +infinity: there is none.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = numeric::kInfinity;

  bool certain() const { return point_error < numeric::kInfinity; }
};
/// The containment test. Unchecked: the surfaces are certainly apart. An open surface has no
/// inside, so nothing is inside it; a ball is solid.
Containment TestContainment(const PosedPair& pair, WorkBudget* work);

}  // namespace collision::narrow_phase
