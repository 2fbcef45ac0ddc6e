// The search for the distance of two bodies: it may stop at any moment and continue later.
//
// Order. If the budget may end the search, the pair that may be nearest comes first (a heap).
// Yes/no queries and brackets of a fixed width search depth-first, nearest child first, without a
// heap; a pair farther than Limit() is never kept.
//
// A step opens one pair: two packs of eight children each, 64 pairs in single precision, B's balls
// posed on the way; or one pack against one ball, where the other one is a leaf, or much smaller.
// Two leaves are two blocks of four triangles: 16 lower bounds, along the shortest way found so far
// (or from ball to ball), along both normals, and across all pairs of edges, each only if the ones
// before leave a pair that matters. Triangles across edges are told apart by the edges' moments,
// without a normal, root or quotient for each of the nine pairs. What is left, seldom more than one
// pair in ten, is measured in doubles. So single precision decides where that is certain
// (kBallSlack, kTriangleSlack: a millionth of the scene's size, derived in sphere_pair_kernel.h),
// and the last digits come from triangle_pair.h. AVX-512, AVX2 and plain loops give the same bits:
// same operations, same order, nothing fused.
#pragma once

#include "collision_core/narrow_phase/separation/separation_findings.h"
#include "collision_core/narrow_phase/separation/separation_frontier.h"
#include "collision_core/narrow_phase/sphere_pairs/kernel_pose.h"

namespace collision::narrow_phase {

/// Work units of one ball against a pack of up to eight.
inline constexpr std::uint64_t kPackRowUnits = 1;
/// Work units of the filter of four triangles against four.
inline constexpr std::uint64_t kBlockPairUnits = 3;

/// Which pair is opened next. With the newest first the lower end of the bracket rises only when
/// most is done, but no heap has to be kept: where only the final answer counts, that is faster.
enum class SearchOrder : std::uint8_t {
  kAsGoal,   ///< The newest first for Goal::kYesNo and for a bracket of a fixed width.
  kNearest,  ///< Always the pair that may be the nearest first.
};

/// One pair of bodies at a pose. Every step opens one pair of balls (or measures two blocks of
/// triangles); the bracket only becomes narrower. Deterministic: the same steps in the same order,
/// whatever the budgets between which it pauses.
class SeparationSearch {
 public:
  /// Everything passed in outlives this.
  SeparationSearch(const PosedPair& pair, Goal goal, std::optional<BracketTolerance> narrow = {},
                   SearchOrder order = SearchOrder::kAsGoal,
                   const SpherePairKernel& scan = WidestSpherePairKernel());

  /// Measures the two roots: costs one unit, and gives a first bracket.
  void Start(WorkBudget* work);
  /// Measures all elements of two leaves that are likely to be the nearest.
  void TryLeaves(NodePair leaves, WorkBudget* work);
  /// Opens pairs until nothing is left to do, or the budget is spent.
  void Refine(WorkBudget* work);
  bool done() const { return done_; }

  /// The bracket as it is.
  double lower() const;
  double upper() const { return findings_.bracket().upper; }

  /// The answer. The search ends with this call.
  SeparationBracket Result();

 private:
  struct Opening;

  void Open(const BallPair& pair, float limit, WorkBudget* work);
  void OpenBalls(const BallPair& pair, Opened opened, float limit, WorkBudget* work);
  void OpenLeaves(BallPair pair, float limit, WorkBudget* work);
  Eigen::Vector3f DirectionBetween(const BallPair& pair, const Eigen::Vector3f& other) const;
  void OpenBlocks(const BallPair& pair, const sphere_tree::TriangleBlock& a,
                  const sphere_tree::TriangleBlock& b, float limit, WorkBudget* work);
  void OpenSolids(const BallPair& pair, ElementPair elements, WorkBudget* work);
  void OpenBlock(const BallPair& pair, const sphere_tree::TriangleBlock& block, WorkBudget* work);
  /// The lower bound of a pair; −kFarDistance where only the limit counts, because the key is then
  /// an order and no bound.
  float BoundOf(const BallPair& pair) const {
    return only_within_ ? -sphere_tree::kFarDistance : pair.lower;
  }
  void TightenUpper(const Opening& opening, const BallScanTask& task, float upper);

  const BodyTree& a_;
  const BodyTree& b_;
  const SpherePairKernel& scan_;
  const PackedBody body_a_, body_b_;
  SeparationFindings findings_;
  KernelPose pose_;
  const double moved_;
  const bool looks_for_margin_, only_within_;
  std::uint64_t margin_units_ = 0;  ///< Spent since contact was certain.
  double root_lower_ = -numeric::kInfinity;
  bool done_ = false;
  LeastBeyond beyond_;  ///< What was not opened is farther apart than this.
  sphere_tree::BallRef deepest_a_ = 0, deepest_b_ = 0;
  Frontier frontier_;
};

}  // namespace collision::narrow_phase
