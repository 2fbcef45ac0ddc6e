#include "collision_core/geometry/triangle/enclosing_ball.h"

#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Steps towards the farthest point; more make the ball smaller by less than a hundredth.
constexpr int kSteps = 24;

/// Coordinates are below it [m], so that their squares and sums of these stay finite.
constexpr double kCoordinateMax = 1e100;

struct Farthest {
  std::size_t index = 0;
  double distance2 = 0;
};

Farthest FarthestFrom(const Vector3d& centre, std::span<const Vector3d> points) {
  Farthest farthest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance2 = (points[i] - centre).squaredNorm();
    if (distance2 > farthest.distance2) farthest = {i, distance2};
  }
  return farthest;
}

/// A computed |d|² is off by a relative 5 u at most, u = 2^−53 (two for each rounded difference,
/// one for each square, two for the sums), the root by 2.5 u + u: kFewRoundingsUp covers them and
/// its own rounding. Squares below 1e-308 lose digits, so distances below kDistanceMin [m] are
/// raised to it.
constexpr double kDistanceMin = 1e-150;
double RadiusOf(double distance2) {
  return std::sqrt(distance2) * numeric::kFewRoundingsUp + kDistanceMin;
}

}  // namespace

// Bădoiu and Clarkson, "Smaller core-sets for balls", 2003: step towards the farthest point by
// 1 / (i + 1). From the middle of the box the first steps may be shorter.
EnclosingBall SmallBallAround(std::span<const Vector3d> points) {
  CORE_CHECK(!points.empty(), "a ball is about at least one point");
  Vector3d lower = points[0], upper = points[0];
  for (const Vector3d& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  CORE_CHECK(lower.minCoeff() > -kCoordinateMax && upper.maxCoeff() < kCoordinateMax,
             "the squares of coordinates are finite", lower.minCoeff(), upper.maxCoeff());
  Vector3d centre = lower + 0.5 * (upper - lower), best_centre = centre;
  double best = numeric::kInfinity;
  for (int i = 0; i <= kSteps; ++i) {
    const Farthest farthest = FarthestFrom(centre, points);
    if (farthest.distance2 < best) best = farthest.distance2, best_centre = centre;
    centre += (points[farthest.index] - centre) / (i + 4);
  }
  return {best_centre, RadiusOf(best)};
}

}  // namespace collision::geometry
