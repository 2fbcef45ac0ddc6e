#include <Eigen/Geometry>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/geometry/convex/gjk.h"
#include "collision_core/geometry/convex/segment_fractions.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

Vector3d AxisOf(const ConvexSet& set) {
  return set.core == ConvexCore::kSegment ? Vector3d(set.generators.col(0)) : Vector3d(0, 0, 0);
}

/// Removes what rounding left along an axis to which the way must be perpendicular.
void TakeOut(const Vector3d& axis, double fraction, Vector3d* way) {
  const double square = axis.squaredNorm();
  if (square > 0 && std::abs(fraction) < 1) *way -= way->dot(axis) / square * axis;
}

}  // namespace

void NearestOfSegments(const ConvexPair& pair, GjkResult* found) {
  CORE_CHECK(pair.a().IsThin() && pair.b().IsThin(), "both cores are points or segments");
  const Vector3d g = AxisOf(pair.a()), h = AxisOf(pair.b());
  const auto [s, t] = NearestOnSegments(pair.between(), g, h);
  GjkResult& result = *found;
  ConvexPair::Point& point = result.simplex[0];
  point = pair.At({Vector3d(s, 0, 0), Vector3d(t, 0, 0)});
  result.weights[0] = 1;
  result.count = 1;
  result.steps = 1;
  result.nearest = result.direction = point.y;
  if (std::abs(s) < 1 && std::abs(t) < 1) {
    // The direction perpendicular to both axes: the way may be so short that its own direction is
    // nothing but rounding.
    const Vector3d across = g.cross(h);
    const double square = across.squaredNorm();
    const Vector3d along = square > 0 ? Vector3d(across * (across.dot(point.y) / square)) : point.y;
    if (along.squaredNorm() > 0) result.direction = along;
  }
  TakeOut(g, s, &result.direction);
  TakeOut(h, t, &result.direction);
}

}  // namespace collision::geometry
