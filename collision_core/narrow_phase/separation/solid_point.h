// A point that shows that two bodies overlap, however little.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {

/// A point fixed to one of the bodies, on its surface or near it, with a bound of its signed
/// distance to that surface: negative within the solid. The two overlap if the other solid contains
/// a ball about the point whose radius exceeds this signed distance. Unlike triangles that cross
/// this shows a shallow contact of parallel faces, or of edges that coincide: there no edge passes
/// through the inside of a triangle.
struct SolidPoint {
  PairMember body = PairMember::kA;             ///< The body to which it is fixed.
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  ///< In that body's frame.
  double signed_distance = numeric::kInfinity;  ///< To that body's surface, rounded up.
};

/// Units of the distance of one point to a surface.
inline constexpr std::uint64_t kPointUnits = 100;

/// A point of a body frame, with what is certain of it.
SolidPoint PointOfA(const BodyTree& a, const Eigen::Vector3d& x_A, WorkBudget* work);
SolidPoint PointOfB(const BodyTree& b, const Eigen::Vector3d& x_B, WorkBudget* work);

/// A bound of the distance of the two bodies as in SeparationBracket::upper, by this point alone:
/// where it is below 0 they overlap by at least that much. The uncertainty of rounding and turning
/// is counted in, that of translation is not.
double UpperBy(const SolidPoint& point, const PosedPair& pair, WorkBudget* work);

/// A bound of the signed distance of a point, in the body frame: negative only where it is
/// certainly within a solid. A ball is solid.
double SignedDistanceTo(const BodyTree& surface, const Eigen::Vector3d& x, WorkBudget* work);

}  // namespace collision::narrow_phase
