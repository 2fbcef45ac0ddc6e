// What a search for the distance of two bodies has found so far.
#pragma once

#include <algorithm>
#include <optional>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// The most shortest-way candidates that are kept; if there are more, no direction is reported.
inline constexpr std::size_t kWaysMax = 128;

/// With Goal::kDecision, pairs whose lower bound exceeds this share of `upper` are not opened: a
/// step through time then loses at most half of the distance.
inline constexpr double kEnoughOfUpper = 0.5;

/// Units for a pair of elements of which one is a convex solid. If they do not suffice, the bracket
/// of the pair stays as wide as it is then.
inline constexpr std::uint64_t kSolidPairUnits = 192;

/// Which test of two triangles comes first where yes or no is asked for: a crossing decides at
/// once, but the distance is needed where they do not cross.
enum class FirstTest { kDistance, kCrossing };

/// How a search ended.
struct SearchEnd {
  double unopened = -numeric::kInfinity;  ///< No pair that was not opened is nearer [m].
  bool exhausted = false;                 ///< The budget ended it.
  std::uint32_t level = 0;                ///< The deepest level of the trees that was opened.
};

/// The bracket of a search while it narrows: pairs of balls and of elements are measured in
/// doubles, and what may matter for the answer is kept.
class SeparationFindings {
 public:
  /// Everything passed in outlives this.
  SeparationFindings(const PosedPair& pair, Goal goal, std::optional<BracketTolerance> narrow);

  /// Pairs farther apart than this need not be measured: the answer is the same without them [m].
  double Limit() const;
  /// Contact is certain.
  bool Touching() const { return bracket_.CertainlyTouching(pose_.translation); }
  /// No further pair can improve the answer.
  bool IsFinal() const;

  const SeparationBracket& bracket() const { return bracket_; }
  double slack() const { return slack_; }
  /// From A to B along the shortest way found so far: a unit vector but for rounding; zero if there
  /// is none.
  const Eigen::Vector3d& direction() const { return direction_; }

  /// Adds a lower bound on the distance of a pair that is measured and will not be opened again.
  void AddResolved(double lower) { resolved_lower_ = std::min(resolved_lower_, lower); }
  double resolved_lower() const { return resolved_lower_; }

  /// Measures the balls of two nodes; returns the lower bound.
  double MeasureNodes(NodePair nodes);
  /// Adds an upper bound of the distance, found for some pair of balls.
  void TightenUpper(double upper) { bracket_.upper = std::min(bracket_.upper, upper); }
  /// Measures two triangles that the filter could not separate; returns the lower bound.
  double MeasureTriangles(ElementPair triangles, FirstTest first, WorkBudget* work);
  /// If one of the bodies is a ball: measures it against an element of the other body.
  double MeasureBallAgainst(ElementIndex element, WorkBudget* work);
  /// Measures any two elements; two triangles by their distance first.
  double MeasureElements(ElementPair elements, WorkBudget* work);
  /// Tests only whether two elements are certainly in contact.
  void RecheckElements(ElementPair elements, WorkBudget* work);

  /// The whole answer.
  SeparationBracket Result(const SearchEnd& end);

 private:
  ConvexQuery SolidsQuery() const;
  double MeasureSolids(ElementPair solids, WorkBudget* work);
  double TurnOfA(const geometry::TrianglePoints& t) const;
  double TurnOfB(const geometry::TrianglePoints& t) const;
  double GapAlongDirection(const geometry::TrianglePoints& a,
                           const geometry::TrianglePoints& b) const;
  void CommonPoint(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b,
                   const Eigen::Vector3d& c_b, double distance, double slack);
  double MeasureBall(PairMember ball, ElementIndex triangle,
                     const geometry::TriangleDistance& found, double slack, WorkBudget* work);
  void KeepPoint(const Eigen::Vector3d& point, double error);
  void Cross(ElementPair triangles, const geometry::TrianglePoints& a,
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
  SeparationBracket bracket_;
};

// The resolved pairs bound the distance from below: once that bound is positive, pairs farther away
// cannot improve the bracket. While it is not positive, other pairs may still be found to cross,
// unless they are certainly apart themselves.
inline double SeparationFindings::Limit() const {
  const double upper = bracket_.upper, moved = pose_.translation;
  if (goal_ == Goal::kNearest) return std::max(0.0, upper + 2 * moved);
  const double resolved = resolved_lower_ > 0 ? resolved_lower_ : numeric::kInfinity;
  if (narrow_) {
    return std::min({upper - narrow_->absolute, upper / (1 + narrow_->relative), resolved});
  }
  if (goal_ == Goal::kYesNo) return resolved_lower_ > moved ? moved : 0;
  if (Touching()) return 0;
  return std::min(std::max(moved, kEnoughOfUpper * upper), resolved);
}

inline bool SeparationFindings::IsFinal() const {
  if (goal_ == Goal::kNearest) return bracket_.upper <= 0 || bracket_.ways.size() > kWaysMax;
  return goal_ != Goal::kContact && Touching();
}

}  // namespace collision::narrow_phase
