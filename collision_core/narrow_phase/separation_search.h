// The search for the distance of two bodies: it may stop at any moment, and go on later.
#pragma once

#include "collision_core/narrow_phase/pack_scan_pose.h"
#include "collision_core/narrow_phase/separation_findings.h"
#include "collision_core/narrow_phase/separation_frontier.h"

namespace collision {

/// Units: up to eight pairs of balls in one wide step cost about as much as one pair elsewhere; four
/// triangles beside four others, as filter.
inline constexpr std::uint64_t kPackRowUnits = 1;
inline constexpr std::uint64_t kBlockPairUnits = 3;

/// Which pair is opened next. Of the newest first, the lower end of the bracket rises only when most
/// is done, but no order has to be kept: where the end is what counts, that is the faster one.
enum class SearchOrder : std::uint8_t {
  kAsGoal,   ///< The newest first for Goal::kYesNo and for a bracket of some width.
  kNearest,  ///< Those that may be the nearest first.
};

/// One pair of bodies at a pose. Every step opens one pair of balls (or measures two blocks of
/// triangles); the bracket only becomes narrower. Deterministic: the same steps in the same order,
/// whatever the budgets between which it pauses.
class SeparationSearch {
 public:
  /// Everything passed in outlives this.
  SeparationSearch(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal,
                   std::optional<BracketWidth> narrow = {},
                   SearchOrder order = SearchOrder::kAsGoal,
                   const PackScan& scan = WidestPackScan());

  /// The two roots: costs one unit, and gives a first bracket.
  void Start(Work* work);
  /// Triangles that are likely to be the nearest.
  void Try(const Evidence& leaves, Work* work);
  /// Until nothing is left to do, or the budget is spent.
  void Refine(Work* work);
  bool done() const { return done_; }

  /// The bracket as it is.
  double lower() const;
  double upper() const { return findings_.look().upper; }

  /// The answer; the search ends with it.
  Look Told();

 private:
  struct Opening;

  void Open(const BallPair& pair, float limit, Work* work);
  void OpenBalls(const BallPair& pair, Opened opened, float limit, Work* work);
  void OpenLeaves(BallPair pair, float limit, Work* work);
  Eigen::Vector3f DirectionBetween(const BallPair& pair, const Eigen::Vector3f& other) const;
  void OpenBlocks(const BallPair& pair, const TriangleBlock& a, const TriangleBlock& b, float limit,
                  Work* work);
  void OpenSolids(const BallPair& pair, std::uint32_t of_a, std::uint32_t of_b, Work* work);
  void OpenBlock(const BallPair& pair, const TriangleBlock& block, Work* work);
  /// Where only the limit counts, what is known of pairs is an order and no bound.
  float BoundOf(const BallPair& pair) const { return only_within_ ? -kNowhere : pair.lower; }
  void LowerUpper(const Opening& opening, const BallScanTask& task, float upper);

  const Surface& a_;
  const Surface& b_;
  const PackScan& scan_;
  const PackedBody body_a_, body_b_;
  SeparationFindings findings_;
  ScanPose pose_;
  const double moved_;
  const bool looks_for_margin_, only_within_;
  std::uint64_t margin_units_ = 0;  ///< Spent since contact was certain.
  double root_lower_ = -kInfinity;
  bool done_ = false;
  LeastBeyond beyond_;  ///< What was not looked at more closely is farther apart than this.
  BallRef deepest_a_ = 0, deepest_b_ = 0;
  Frontier frontier_;
};

}  // namespace collision
