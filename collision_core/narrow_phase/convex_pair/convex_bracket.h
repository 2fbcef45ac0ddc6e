// The bracket of the distance of two convex sets, narrowed by whatever a search proposes.
//
// Three kinds of facts narrow it, and each is certain whatever proposed it: the gap of the
// projections of the cores along a direction is a lower bound; a way between a point of one core
// and a point of the other is an upper bound; and a ball about 0 that lies in the difference B − A
// is an upper bound below 0, since no shift by less than its radius takes the two apart. So a wrong
// proposal makes the bracket wide, never wrong.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision_core/geometry/convex/gjk.h"
#include "collision_core/narrow_phase/convex_pair/convex_query.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// Relative error of a computed unit vector, of its length, and of a product with it: a few
/// roundings of 2^-53 each.
inline constexpr double kUnitVectorError = 8 * numeric::kUnitRoundoff;

/// π / 2, rounded up: θ <= (π / 2) sin θ up to a right angle.
inline constexpr double kHalfPiUp = 1.5707963267948968;

/// A bracket narrower than this share of the pair's size is as good as the arithmetic.
inline constexpr double kTightestWidth = 96 * numeric::kUnitRoundoff;

/// Bounds of the distance of two convex sets in one frame. The sets outlive it. Not thread-safe;
/// each operation costs a pair of support points or less.
class ConvexBracket {
 public:
  ConvexBracket(const geometry::ConvexSet& a, const geometry::ConvexSet& b);

  /// Raises the lower bound to the gap of the cores' projections along a direction from A to B, of
  /// any length. The zero vector changes nothing.
  void TryDirection(const Eigen::Vector3d& direction);
  /// Raises the lower bound to a gap that the caller computed, off by at most the pair's
  /// GapError(). n is a unit vector to within kUnitVectorError.
  void TakeGap(const Eigen::Vector3d& n, double computed);
  /// Lowers the upper bound to the length of a weighted sum of points of B − A, off by at most the
  /// pair's PointError().
  void TakeWay(const Eigen::Vector3d& way);
  /// Lowers the upper bound to −radius, for a ball of this radius [m] about 0 that certainly lies
  /// in B − A. A radius <= 0 changes nothing.
  void TakeBallInside(double radius);

  /// Bounds of the distance of the sets [m], with their rounding radii and their errors.
  double separation_lower() const;
  double separation_upper() const;
  /// The lower bound of the distance of the cores [m]; −infinity at first.
  double lower() const { return lower_; }
  /// The direction that gave lower(): a unit vector; zero at first.
  const Eigen::Vector3d& normal() const { return normal_; }
  /// The angle between normal() and the shortest way is at most this [rad]; π where nothing is
  /// known.
  double NormalError() const;

  /// Whether the query needs no narrower bracket, or doubles give none.
  bool IsGoodEnough(const ConvexQuery& query) const;

  const geometry::ConvexPair& pair() const { return pair_; }
  double rounding() const { return rounding_; }  ///< The radii of both sets together [m].
  double error() const { return error_; }        ///< The errors of both sets together [m].

 private:
  const geometry::ConvexPair pair_;
  const double rounding_;
  const double error_;
  double lower_ = -numeric::kInfinity;  // of the cores, along the normal
  double upper_ = numeric::kInfinity;   // of the cores
  Eigen::Vector3d normal_{0, 0, 0};
};

inline void ConvexBracket::TakeGap(const Eigen::Vector3d& n, double computed) {
  const double gap = computed - pair_.GapError();
  const double certain = gap - 2 * kUnitVectorError * std::abs(gap);
  if (certain > lower_) lower_ = certain, normal_ = n;
}

inline void ConvexBracket::TakeBallInside(double radius) {
  if (radius > 0) upper_ = std::min(upper_, -radius);
}

inline double ConvexBracket::separation_lower() const {
  const double rounding = numeric::AddUp(pair_.a().rounding, pair_.b().rounding);
  return numeric::AddDown(lower_, -numeric::AddUp(rounding, error_));
}

inline double ConvexBracket::separation_upper() const {
  const double rounding = numeric::AddDown(pair_.a().rounding, pair_.b().rounding);
  return numeric::AddUp(upper_, numeric::AddUp(error_, -rounding));
}

inline void ConvexBracket::TryDirection(const Eigen::Vector3d& direction) {
  const double length = std::sqrt(direction.squaredNorm());
  if (!(length > geometry::kSupportUnderflow)) return;
  const Eigen::Vector3d n = direction / length;
  TakeGap(n, n.dot(pair_.Against(n).y));
}

inline void ConvexBracket::TakeWay(const Eigen::Vector3d& way) {
  const double length = std::sqrt(way.squaredNorm());
  upper_ = std::min(upper_, numeric::AddUp(numeric::MultiplyUp(length, 1 + kUnitVectorError),
                                           pair_.PointError()));
}

inline bool ConvexBracket::IsGoodEnough(const ConvexQuery& query) const {
  const double lower = separation_lower();
  if (query.goal == ConvexGoal::kYesNo && lower > 0) return true;
  const double upper = separation_upper();
  if (query.goal == ConvexGoal::kYesNo && upper <= 0) return true;
  const double least = std::max({0.0, lower, -upper});
  const double share = query.relative_tolerance * least;
  return upper_ - lower_ <=
         std::max({query.absolute_tolerance, share, kTightestWidth * pair_.size()});
}

}  // namespace collision::narrow_phase
