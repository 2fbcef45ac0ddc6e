// The search that narrows the bracket of two convex sets: what it proposes, in which order.
//
// Segments and boxes have closed forms. Otherwise GJK proposes nearest points and a direction;
// where these are mostly rounding, the directions that edges and faces determine come next, and
// against a smooth core Newton's method on its support function. Cores that may overlap are
// followed by EPA, boxes first by the separating axis test, as far as the query needs it.
#pragma once

#include <array>

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/convex_pair/convex_bracket.h"

namespace collision::narrow_phase {

/// One search. What it is given outlives it. Not thread-safe.
class ConvexSearch {
 public:
  /// Narrows `bracket`. Requires a bracket whose lower bound nothing has raised yet.
  ConvexSearch(const ConvexQuery& query, ConvexBracket* bracket, WorkBudget* work);

  /// Searches until the bracket is good enough, or a limit on steps or the work allowed ends the
  /// search. `hint` (or null): where an earlier search of the same sets ended; set to where this
  /// one ends, if it takes steps. It changes the speed, not the certainty.
  void Run(geometry::GjkHint* hint);

  /// The nearest points of the cores that were found, as a simplex and its weights.
  const geometry::GjkResult& found() const { return found_; }
  /// A limit ended the search before the bracket was good enough.
  bool exhausted() const { return exhausted_ && !IsGoodEnough(); }

 private:
  bool IsGoodEnough() const { return bracket_.IsGoodEnough(query_); }
  bool MayOverlap() const { return !(bracket_.lower() > 0) && !IsGoodEnough(); }
  bool AreZonotopes() const;
  geometry::GjkGoal GjkGoalOfQuery() const;
  std::uint32_t StepsWithin(std::uint64_t units, std::uint32_t most) const;

  bool DecideByFaces();
  void TestFaces(double apart);
  void FindNearest(const geometry::GjkHint& hint);
  void TryFeatures();
  void Polish();
  void PolishAcross(const Eigen::Vector3d& edge);
  int CornersOfPolytope(std::array<Eigen::Vector3d, 4>* corners) const;
  void TryWithPoints(const Eigen::Vector3d& direction);
  geometry::GjkResult WithSmoothPoints(const Eigen::Vector3d& n) const;
  void Deepen();
  void GrowPolytope();

  const ConvexQuery& query_;
  ConvexBracket& bracket_;
  const geometry::ConvexPair& pair_;  // the bracket's
  WorkBudget& work_;
  geometry::GjkResult found_;
  bool exhausted_ = false;
};

}  // namespace collision::narrow_phase
