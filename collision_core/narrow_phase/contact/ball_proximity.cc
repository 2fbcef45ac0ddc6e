#include "collision_core/narrow_phase/contact/ball_proximity.h"

#include <algorithm>

namespace collision::narrow_phase {
namespace {

// Covers the rounding of a dozen operations on positive terms, 2^-49 of the result.
constexpr double kRounding = 1 + 1e-12;

// The coordinates of a unit vector [rad] and of a point, as a share of its greatest coordinate, are
// rounded by a few units of 2^-53.
constexpr double kCoordinateRounding = 1e-15;

}  // namespace

Proximity BallProximity(const BallSegment& a, const BallSegment& b, double delta) {
  const SeparationAt found = EvaluateBallsAt(a, b, delta);
  Proximity proximity;
  // Bounds of two states that agree only up to rounding may contradict each other by as much.
  proximity.separation = {std::min(found.separation.lower, found.separation.upper),
                          std::max(found.separation.lower, found.separation.upper)};
  proximity.depth_lower = std::max(0.0, -proximity.separation.upper);
  const Eigen::Vector3d d = found.p_WB - found.p_WA;
  const double distance = d.norm();
  const double error = found.error_A + found.error_B;
  // The direction of d turns by at most asin(error / distance), and asin x <= π/2 x.
  if (distance > error) {
    proximity.normal = d / distance;
    proximity.normal_error =
        std::numbers::pi / 2 * (error / distance) * kRounding + kCoordinateRounding;
  }
  // Half-way between the two surfaces along the normal.
  const double gap = proximity.separation.middle();
  proximity.p_WC = found.p_WA + proximity.normal * (a.radius + gap / 2);
  proximity.point_error = (found.error_A + proximity.separation.width() +
                           a.radius * std::min(proximity.normal_error, 2.0)) *
                              kRounding +
                          kCoordinateRounding * found.p_WA.lpNorm<Eigen::Infinity>();
  return proximity;
}

}  // namespace collision::narrow_phase
