#include "collision_core/narrow_phase/convex_pair/convex_bracket.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

using Eigen::Vector3d;

ConvexBracket::ConvexBracket(const geometry::ConvexSet& a, const geometry::ConvexSet& b)
    : pair_(a, b), rounding_(a.rounding + b.rounding), error_(numeric::AddUp(a.error, b.error)) {}

// The shortest way w of the exact cores has n·w >= L and |w| <= U: its angle θ with n has
// cos θ >= L / U.
double ConvexBracket::NormalError() const {
  const double lower = numeric::AddDown(lower_, -error_), upper = numeric::AddUp(upper_, error_);
  if (!(lower > 0) || !(lower <= upper)) return std::numbers::pi;
  const double sine = std::sqrt((upper - lower) * (upper + lower)) / upper;
  return std::min(std::numbers::pi,
                  numeric::kManyRoundingsUp * kHalfPiUp * sine + kUnitVectorError);
}

}  // namespace collision::narrow_phase
