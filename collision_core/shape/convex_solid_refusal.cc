// Why a convex solid cannot be an agent's shape.

#include <cmath>

#include "collision_core/base/number_text.h"
#include "collision_core/shape/convex_solid.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;
using Refusal = std::optional<std::string>;

bool IsIn(double x, double lower, double upper) { return x >= lower && x <= upper; }

std::string Axis(int axis) { return std::string(".") + "xyz"[axis]; }

Refusal RefusalOfLength(const std::string& field, double x) {
  if (IsIn(x, 0, kConvexSizeMax)) return std::nullopt;
  return field + " is " + NumberText(x) + "; allowed are 0 to " + NumberText(kConvexSizeMax) + " m";
}

Refusal RefusalOfPlace(const std::string& field, const Vector3d& p) {
  for (int i = 0; i < 3; ++i) {
    if (IsIn(p[i], -kConvexReachMax, kConvexReachMax)) continue;
    return field + Axis(i) + " is " + NumberText(p[i]) + "; allowed are finite values within ±" +
           NumberText(kConvexReachMax) + " m";
  }
  return std::nullopt;
}

/// Allowed lengths of a quaternion: outside, squares overflow or lose their digits.
constexpr double kTurnLengthMin = 1e-100;
constexpr double kTurnLengthMax = 1e100;

Refusal RefusalOfTurn(const Eigen::Quaterniond& q) {
  const double length = q.coeffs().stableNorm();
  if (IsIn(length, kTurnLengthMin, kTurnLengthMax)) return std::nullopt;
  return "convex.q_BS has the length " + NumberText(length) + "; allowed are " +
         NumberText(kTurnLengthMin) + " to " + NumberText(kTurnLengthMax);
}

Refusal RefusalOfPoints(const std::vector<Vector3d>& points) {
  if (points.empty() || points.size() > kHullPointsMax) {
    return "convex.points: there are " + std::to_string(points.size()) + "; allowed are 1 to " +
           std::to_string(kHullPointsMax);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string field = "convex.points[" + std::to_string(i) + "]";
    if (auto refusal = RefusalOfPlace(field, points[i])) return refusal;
  }
  return std::nullopt;
}

bool IsTurned(const ConvexDescription& d) {
  return d.core == geometry::ConvexCore::kCylinder || d.core == geometry::ConvexCore::kCone;
}

/// The size that is checked: for a hull the diagonal of the points' box, for other solids twice
/// their half measures.
double SizeOf(const ConvexDescription& d) {
  double size = 0;
  if (d.core == geometry::ConvexCore::kSegment) size = 2 * d.half.z();
  if (d.core == geometry::ConvexCore::kBox) size = 2 * d.half.norm();
  if (d.core == geometry::ConvexCore::kEllipsoid) size = 2 * d.half.maxCoeff();
  if (IsTurned(d)) size = 2 * std::hypot(d.half.x(), d.half.z());
  if (d.core == geometry::ConvexCore::kHull) {
    Vector3d lower = d.points[0], upper = d.points[0];
    for (const Vector3d& p : d.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
    size = (upper - lower).norm();
  }
  return size + 2 * d.rounding;
}

Refusal RefusalOfMeasures(const ConvexDescription& d) {
  if (d.core == geometry::ConvexCore::kTriangle) {
    return "convex.core is a triangle; allowed are point, segment, box, ellipsoid, "
           "cylinder, cone and hull";
  }
  if (auto refusal = RefusalOfLength("convex.rounding", d.rounding)) return refusal;
  if (d.core == geometry::ConvexCore::kHull) return RefusalOfPoints(d.points);
  for (int i = 0; i < 3; ++i) {
    const bool counts = d.core != geometry::ConvexCore::kPoint &&
                        (d.core != geometry::ConvexCore::kSegment || i == 2);
    if (!counts) continue;
    if (auto refusal = RefusalOfLength("convex.half" + Axis(i), d.half[i])) return refusal;
  }
  if (IsTurned(d) && d.half.x() != d.half.y()) {
    return "convex.half.y is " + NumberText(d.half.y()) +
           "; allowed is the radius, as in x: " + NumberText(d.half.x());
  }
  return std::nullopt;
}

}  // namespace

Refusal RefusalOf(const ConvexDescription& d) {
  if (auto refusal = RefusalOfMeasures(d)) return refusal;
  if (auto refusal = RefusalOfTurn(d.q_BS)) return refusal;
  if (auto refusal = RefusalOfPlace("convex.p_BS", d.p_BS)) return refusal;
  const double size = SizeOf(d);
  if (IsIn(size, kConvexSizeMin, kConvexSizeMax)) return std::nullopt;
  return "convex: its size is " + NumberText(size) + " m; allowed are " +
         NumberText(kConvexSizeMin) + " to " + NumberText(kConvexSizeMax) +
         " m (most likely the unit is not the one meant)";
}

}  // namespace collision::shape
