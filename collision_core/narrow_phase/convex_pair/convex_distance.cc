#include "collision_core/narrow_phase/convex_pair/convex_distance.h"

#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/convex_pair/convex_search.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// Relative to the lengths that a point is the sum of: a rounding of 2^-53 for each of two sums, in
/// three coordinates; below 3.5 · 2^-53.
constexpr double kPointRounding = 0x1p-51;

/// What sums of a centre and a point, both in doubles, are off by.
double CentreError(const ConvexBracket& bracket) {
  const geometry::ConvexPair& pair = bracket.pair();
  return kPointRounding * (pair.a().centre.cwiseAbs().sum() + pair.size() + bracket.rounding());
}

/// Points a of A and b of B that are ρ apart. The difference holds the ball of the certain depth
/// m, so that there are a', b' with b' − a' = −(m / ρ)(b − a): on the way from a to a' and from b
/// to b' the share ρ / (ρ + m) is a common point, no further from a than that share of A's
/// diameter, nor from b than that of B's. The point reported is half-way between a and b.
double DistanceToCommonPoint(const ConvexBracket& bracket, double length, double certain,
                             double depth) {
  const geometry::ConvexPair& pair = bracket.pair();
  const double apart = std::max(0.0, length - bracket.rounding()) + 2 * certain;
  const double diameter = 2 * (std::min(pair.a().span, pair.b().span) + bracket.rounding());
  return numeric::kManyRoundingsUp * (0.5 * apart + diameter * (apart / (apart + depth)));
}

/// Sets the points of the result, of which all else is set.
void SetPoints(const ConvexBracket& bracket, const geometry::GjkResult& found,
               ConvexSeparation* result) {
  const geometry::ConvexPair& pair = bracket.pair();
  Vector3d on_a = Vector3d::Zero(), on_b = Vector3d::Zero();
  for (int i = 0; i < found.count; ++i) {
    on_a += found.weights[i] * found.simplex[i].witness.a;
    on_b += found.weights[i] * found.simplex[i].witness.b;
  }
  on_a = pair.a().PointAt(on_a);
  on_b = pair.between() + pair.b().PointAt(on_b);
  const double upper = result->separation.upper;
  const double certain =
      pair.PointError() + bracket.error() + kUnitVectorError * bracket.rounding();
  const Vector3d way = on_b - on_a;
  const double length = std::sqrt(way.squaredNorm());
  const double radius_a = pair.a().rounding, radius_b = pair.b().rounding;
  if (upper > 0) {
    const Vector3d n = length > 0 ? Vector3d(way / length) : bracket.normal();
    const double shorter = bracket.rounding() > length ? length / bracket.rounding() : 1;
    result->a = pair.a().centre + on_a + shorter * radius_a * n;
    result->b = pair.a().centre + on_b - shorter * radius_b * n;
    result->point_error = certain + CentreError(bracket);
    return;
  }
  // Within radius_a of one and radius_b of the other, if the radii reach so far.
  const double along = std::clamp(0.5 * (length - radius_b + radius_a), 0.0, length);
  const Vector3d common = length > 0 ? Vector3d(on_a + along / length * way) : on_a;
  result->a = result->b = pair.a().centre + common;
  result->point_error =
      certain + CentreError(bracket) + DistanceToCommonPoint(bracket, length, certain, -upper);
}

}  // namespace

ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                              const ConvexQuery& query, geometry::GjkHint* hint, WorkBudget* work) {
  ConvexBracket bracket(a, b);
  ConvexSearch search(query, &bracket, work);
  search.Run(hint);
  ConvexSeparation result;
  result.separation = {bracket.separation_lower(), bracket.separation_upper()};
  result.normal = bracket.normal();
  result.normal_error = bracket.NormalError();
  result.exhausted = search.exhausted();
  SetPoints(bracket, search.found(), &result);
  return result;
}

numeric::Interval IntervalOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                             const ConvexQuery& query, WorkBudget* work) {
  ConvexBracket bracket(a, b);
  ConvexSearch(query, &bracket, work).Run(nullptr);
  return {bracket.separation_lower(), bracket.separation_upper()};
}

}  // namespace collision::narrow_phase
