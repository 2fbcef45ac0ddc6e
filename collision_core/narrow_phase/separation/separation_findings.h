// What a search for the distance of two bodies has found so far.
#pragma once

#include <algorithm>
#include <optional>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// Ways between surfaces that are kept; with more of them the direction is not told.
inline constexpr std::size_t kWaysMax = 128;

/// A step of the search through time loses at most half of the distance when the bracket is this
/// narrow.
inline constexpr double kEnoughOfUpper = 0.5;

/// For two elements of which one is a convex solid: where they do not suffice, the bracket stays as
/// wide as it is then.
inline constexpr std::uint64_t kSolidPairUnits = 192;

/// The look as it grows: balls and triangles are measured in doubles, and what matters is kept.
class SeparationFindings {
 public:
  /// Everything passed in outlives this.
  SeparationFindings(const PosedPair& pair, Goal goal, std::optional<BracketTolerance> narrow);

  /// Pairs that are farther apart than this need not be looked at: the answer is the same without.
  double Limit() const;
  /// Contact is certain.
  bool Touching() const { return look_.CertainlyTouching(pose_.translation); }
  /// Nothing makes the answer any better.
  bool Settled() const;

  const SeparationBracket& look() const { return look_; }
  double slack() const { return slack_; }
  /// From A to B along the shortest way found: about a unit vector, or zero.
  const Eigen::Vector3d& direction() const { return direction_; }

  /// A lower bound on the distance of what was looked at to the end.
  void Resolve(double lower) { resolved_lower_ = std::min(resolved_lower_, lower); }
  double resolved_lower() const { return resolved_lower_; }

  /// Two balls, by their numbers in the sphere trees: returns the lower bound.
  double MeasureNodes(std::uint32_t a, std::uint32_t b);
  /// An upper bound for some pair of balls.
  void LowerUpper(double upper) { look_.upper = std::min(look_.upper, upper); }
  /// Two triangles, of which is known that a filter could not tell them apart: returns the lower
  /// bound. `likely_to_cross`: that is looked at first.
  double MeasureTriangles(std::uint32_t a, std::uint32_t b, bool likely_to_cross, WorkBudget* work);
  /// Where one of the two is a ball: an element of the other.
  double MeasureBeside(std::uint32_t element, WorkBudget* work);
  /// Any two elements: triangles are looked at by MeasureTriangles().
  double MeasureElements(std::uint32_t a, std::uint32_t b, bool likely_to_cross, WorkBudget* work);
  /// Whether two elements are certainly in contact; nothing more.
  void CrossAgain(std::uint32_t a, std::uint32_t b, WorkBudget* work);

  /// The whole answer. `unopened`: a lower bound on what was not looked at.
  SeparationBracket Told(double unopened, bool exhausted, std::uint32_t level);

 private:
  ConvexQuestion SolidsQuestion() const;
  double MeasureSolids(std::uint32_t a, std::uint32_t b, WorkBudget* work);
  double TurnOfA(const geometry::TrianglePoints& t) const;
  double TurnOfB(const geometry::TrianglePoints& t) const;
  double GapAlongDirection(const geometry::TrianglePoints& a,
                           const geometry::TrianglePoints& b) const;
  void CommonPoint(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b,
                   const Eigen::Vector3d& c_b, double distance, double slack);
  double Count(std::uint32_t triangle, const geometry::TriangleDistance& found, double radius,
               bool ball_is_a, double slack, WorkBudget* work);
  void KeepPoint(const Eigen::Vector3d& point, double error);
  void Cross(std::uint32_t index_a, const geometry::TrianglePoints& a, std::uint32_t index_b,
             const geometry::TrianglePoints& b);
  void KeepWay(const NearestWay& way);
  void DropLonger();
  void PointBetween();

  const BodyTree& a_;
  const BodyTree& b_;
  const RelativePose& pose_;
  const Goal goal_;
  const std::optional<BracketTolerance> narrow_;
  const double slack_;
  double resolved_lower_ = numeric::kInfinity;
  std::optional<NearestWay> way_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  SeparationBracket look_;
};

// What is resolved bounds the distance from below: once that is positive, what is farther away can
// make the bracket no better. Where it is not, other pairs may still be certain to cross, unless
// they are apart for certain themselves.
inline double SeparationFindings::Limit() const {
  const double upper = look_.upper, moved = pose_.translation;
  if (goal_ == Goal::kNearest) return std::max(0.0, upper + 2 * moved);
  const double resolved = resolved_lower_ > 0 ? resolved_lower_ : numeric::kInfinity;
  if (narrow_) {
    return std::min({upper - narrow_->absolute, upper / (1 + narrow_->relative), resolved});
  }
  if (goal_ == Goal::kYesNo) return resolved_lower_ > moved ? moved : 0;
  if (Touching()) return 0;
  return std::min(std::max(moved, kEnoughOfUpper * upper), resolved);
}

inline bool SeparationFindings::Settled() const {
  if (goal_ == Goal::kNearest) return look_.upper <= 0 || look_.ways.size() > kWaysMax;
  return goal_ != Goal::kContact && Touching();
}

}  // namespace collision::narrow_phase
