#include "collision_core/sphere_tree/fitted/fitted_distance.h"

#include <algorithm>

#include "collision_core/geometry/triangle/ray_passage.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// A computed length is off by a relative 3.5 u, u = 2^−53, and kDistanceUnderflow; 16 u.
constexpr double kLengthUp = 1 + 0x1p-49;

/// Lowers a computed distance by more than it may be off, so that what is as near need not be
/// measured again.
constexpr double kLessThanSeen = 1 - 0x1p-40;

/// Whether a point lies in the ball about a centre that is certainly inside.
bool IsInBallOf(const CentreFacts& near, const Vector3d& point) {
  return near.inside &&
         (point - near.centre).norm() * kLengthUp + kDistanceUnderflow < -near.signed_distance;
}

}  // namespace

/// Every triangle is certainly farther than what `limit` is when it is visited, or lowers it.
double FittedDistance::LowerBound(const Vector3d& centre, double from) const {
  double limit = std::max(from, 0.0);
  boxes_.VisitWithin(centre, &limit, [&](ElementIndex triangle) {
    const geometry::TrianglePoints corners = boxes_.CornersOf(triangle);
    if (geometry::IsCertainlyFarther(centre, corners, limit)) return;
    limit = std::min(limit, geometry::DistanceToTriangle(centre, corners).distance.lower);
  });
  return limit;
}

/// As SurfaceQuery::WindingNumberAt(), where each triangle is met once.
std::optional<int> FittedDistance::WindingNumberAt(const Vector3d& point) const {
  // Towards the nearer end of the surface: fewer triangles there.
  const bool forward = point.x() - boxes_.lower().x() >= boxes_.upper().x() - point.x();
  const geometry::Passing asked =
      forward ? geometry::Passing::kForward : geometry::Passing::kBackward;
  int winding = 0;
  bool known = true;
  boxes_.VisitAlongX(point, asked, [&](ElementIndex triangle) {
    const geometry::RayPassage passage = geometry::PassageOf(boxes_.CornersOf(triangle), point);
    known = known && passage.passing != geometry::Passing::kUnknown;
    if (passage.passing == asked) winding += forward ? passage.sign : -passage.sign;
  });
  return known ? std::optional(winding) : std::nullopt;
}

CentreFacts FittedDistance::Certify(const Vector3d& centre, double slack, const CentreFacts& near,
                                    ElementIndex triangle) const {
  CentreFacts facts;
  facts.centre = centre;
  const NearPoint nearest = boxes_.Nearest(centre, triangle, 0, 0.5 * slack);
  if (kind_ == SurfaceKind::kClosed &&
      (IsInBallOf(near, centre) || WindingNumberAt(centre).value_or(0) != 0)) {
    const double lower = LowerBound(centre, nearest.distance * kLessThanSeen - 0.5 * slack);
    facts.inside = lower > 0;
    if (facts.inside) {
      facts.signed_distance = -lower;
      return facts;
    }
  }
  facts.signed_distance =
      geometry::DistanceToTriangle(centre, boxes_.CornersOf(nearest.triangle)).distance.upper;
  return facts;
}

}  // namespace collision::sphere_tree
