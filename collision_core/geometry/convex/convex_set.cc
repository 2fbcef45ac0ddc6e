// Rounding of support points. With u = 2^-53, n a unit vector to within 2^-20, and second order
// left to the margin of the constant:
//
//   kSegment, kBox  A wrong sign of n·g_i, off by 3u |g_i|, costs twice that: 6u span. The sum of
//                   the generators is off by 2u span: the point is that near to a corner.
//   kTriangle       A corner that is not the furthest costs twice 3u span. The point is exact.
//   kEllipsoid      m = Gᵀn is off by 3u span. z = m / |m| has a length of 1 ± 4.5u and, exactly,
//                   n·Gz >= |m| (1 − 4.5u) − 3u span >= |Gᵀn| − 10.5u span. Gz is off by 3u span,
//                   and within 4.5u span of a point of the ellipsoid: 7.5u span in all.
//   kCylinder       Its disc is an ellipse, with two generators; its axis a segment.
//   kCone           With ρ = max |g_0|, |g_1|, 2ρ of the span: n·apex and the greatest n·x of the
//                   base are off by 3u |g_2| each, of the base by 3.4u 2ρ more: m by 3u √2 ρ, its
//                   length by 2.5u ρ. So the wrong end costs 6u |g_2| + 3.4u 2ρ. On the base n·Gz
//                   >= |m| (1 − 4.5u) − 3u √2 ρ >= |Gᵀn| − 6.5u 2ρ, and the point is off as that of
//                   an ellipsoid: less than 10.5u span and 7.5u span.
//   kHull           span is twice the points' reach ρ. G is a rotation to within 2^-20: m = Gᵀn is
//                   off by 3u √3, counted twice, the choice by 16u ρ: 26.4u ρ. Gx is off by
//                   3u √3 ρ.
//
// To tell n·point, exactly, from the greatest n·x the point's own error counts as well: at most
// 13.5u span in all, of a hull 15.8u; 18u leave room for the product n·point itself (3u |point|).
#include "collision_core/geometry/convex/convex_set.h"

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/interval.h"

namespace collision::geometry {

using Eigen::Vector3d;

/// Relative to the span: each difference of corners is off by 2^-53 of itself, a weighted sum of
/// two of them by no more than the longer one; twice that.
constexpr double kDifferenceError = 0x1p-52;

ConvexSet TriangleSet(const std::array<Vector3d, 3>& corners) {
  ConvexSet set;
  set.core = ConvexCore::kTriangle;
  set.centre = corners[0];
  set.generators.col(0).setZero();
  set.generators.col(1) = corners[1] - corners[0];
  set.generators.col(2) = corners[2] - corners[0];
  // A root of rounded squares is off by 2.5 · 2^-53 of itself.
  const double longest =
      std::sqrt(std::max(set.generators.col(1).squaredNorm(), set.generators.col(2).squaredNorm()));
  set.span = numeric::kFewRoundingsUp * longest + kSupportUnderflow;
  set.error = kDifferenceError * set.span;
  return set;
}

ConvexSet BallSet(const Vector3d& centre, double radius) {
  ConvexSet set;
  set.centre = centre;
  set.rounding = radius;
  return set;
}

}  // namespace collision::geometry
