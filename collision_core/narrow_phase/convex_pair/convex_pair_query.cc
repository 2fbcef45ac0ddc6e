#include "collision_core/narrow_phase/convex_pair/convex_pair_query.h"

#include <algorithm>

#include "collision_core/geometry/convex/box_zonotope.h"
#include "collision_core/narrow_phase/convex_pair/box_separating_axis.h"
#include "collision_core/narrow_phase/convex_pair/capsule_distance.h"
#include "collision_core/narrow_phase/convex_pair/convex_bracket.h"
#include "collision_core/narrow_phase/convex_pair/gjk_small.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

/// Sums of a core's distance, the rounding and the errors: off by less than this share of the
/// pair's size and the rounding.
constexpr double kSumRounding = 8 * numeric::kUnitRoundoff;

/// Relative to the same: what a search leaves of an answer, 32 · 2^-53 (kGapError in
/// gjk_small_wide.h), and kSumRounding, more than three times.
constexpr double kVerdictMargin = 128 * numeric::kUnitRoundoff;

/// Relative to the same: four times kSumRounding, so that contact remains when OfSets() has counted
/// it in.
constexpr double kInsideMargin = 32 * numeric::kUnitRoundoff;

/// The bracket of the sets, given that of their cores: roundings and errors counted in.
numeric::Interval OfSets(const numeric::Interval& of_cores, double rounding,
                         const PosedCores& cores) {
  const double slack = cores.error + kSumRounding * (cores.size + rounding);
  return {(of_cores.lower - rounding) - slack, (of_cores.upper - rounding) + slack};
}

Verdict VerdictOf(const numeric::Interval& separation, double translation) {
  if (separation.lower > translation) return Verdict::kApart;
  return separation.upper <= -translation ? Verdict::kTouching : Verdict::kUndecided;
}

Verdict TestBoxes(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                  const RelativePose& pose) {
  const PosedCores cores(a, b, pose);
  const double rounding = a.rounding + b.rounding;
  const double uncertain = numeric::kFewRoundingsUp * (cores.error + pose.translation);
  const BoxPair pair{a.generators.data(),
                     b.generators.data(),
                     pose.R_AB.data(),
                     {cores.d.x(), cores.d.y(), cores.d.z()},
                     a.span,
                     kPosedSumUp * b.span,
                     cores.size,
                     numeric::kFewRoundingsUp * (rounding + uncertain),
                     std::max(0.0, uncertain - numeric::kFewRoundingsDown * rounding)};
  switch (TestSeparatingAxes(pair)) {
    case BoxSeparation::kApart:
      return Verdict::kApart;
    case BoxSeparation::kTouching:
      return Verdict::kTouching;
    case BoxSeparation::kUnknown:
      break;
  }
  return Verdict::kUndecided;
}

/// Neither smooth nor of many points.
bool IsQuick(const geometry::ConvexSet& set) {
  return set.IsThin() || set.core == geometry::ConvexCore::kBox ||
         (set.core == geometry::ConvexCore::kHull && !set.points->blocks().empty());
}

void SetCore(const geometry::ConvexSet& set, SmallGjkCore* core) {
  core->edges = set.core == geometry::ConvexCore::kBox
                    ? 3
                    : (set.core == geometry::ConvexCore::kSegment ? 1 : 0);
  if (set.core != geometry::ConvexCore::kHull) return;
  core->is_hull = true;
  for (int i = 0; i < 3; ++i) core->reach[i] = set.points->extents()[i];
  core->points = set.points->blocks().data();
  core->blocks = static_cast<int>(set.points->blocks().size() / 12);
}

/// Beyond [m], products of lengths might overflow.
constexpr double kSizeMax = 1e40;

/// The cores where they are, nothing asked yet. Requires IsQuick().
SmallGjkPair QuickPairOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                         const PosedCores& cores, const RelativePose& pose) {
  SmallGjkPair pair;
  SetCore(a, &pair.a);
  SetCore(b, &pair.b);
  for (int i = 0; i < 9; ++i) pair.a.axes[i] = a.generators.data()[i];
  const double *m = pose.R_AB.data(), *g = b.generators.data();
  for (int i = 0; i < 9; ++i) {
    const int row = i % 3, column = 3 * (i / 3);
    pair.b.axes[i] = (m[row] * g[column] + m[3 + row] * g[column + 1]) + m[6 + row] * g[column + 2];
  }
  for (int i = 0; i < 3; ++i) pair.d[i] = cores.d[i];
  pair.size = cores.size;
  pair.apart = pair.inside = numeric::kInfinity;
  pair.near = -numeric::kInfinity;
  pair.relative_tolerance = pair.absolute_tolerance = 0;
  pair.rounding = a.rounding + b.rounding;
  return pair;
}

Verdict SearchForVerdict(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                         const PosedCores& cores, const RelativePose& pose) {
  SmallGjkPair pair = QuickPairOf(a, b, cores, pose);
  const double uncertain = numeric::kFewRoundingsUp * (cores.error + pose.translation);
  const double margin = uncertain + kVerdictMargin * (cores.size + pair.rounding);
  pair.apart = pair.rounding + margin;
  if (pair.rounding > margin) pair.near = pair.rounding - margin;
  pair.inside = margin;
  const SmallGjkResult found = RunSmallGjk(pair);
  if (found.inside) return Verdict::kTouching;
  return VerdictOf(OfSets({found.lower, found.upper}, pair.rounding, cores), pose.translation);
}

numeric::Interval SearchForDistance(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                                    const PosedCores& cores, const RelativePose& pose,
                                    const ConvexQuery& query) {
  if (!(cores.size < kSizeMax)) return {-numeric::kInfinity, numeric::kInfinity};
  SmallGjkPair pair = QuickPairOf(a, b, cores, pose);
  pair.relative_tolerance = query.relative_tolerance / 4;
  pair.absolute_tolerance = query.absolute_tolerance / 4;
  // So large that contact remains when errors and roundings are counted in, see OfSets().
  const double inside = 2 * cores.error + kInsideMargin * (cores.size + pair.rounding);
  if (query.goal == ConvexGoal::kDistance) pair.inside = inside;
  const SmallGjkResult found = RunSmallGjk(pair);
  if (found.inside) return {-numeric::kInfinity, -inside};
  return {found.lower, found.upper};
}

bool IsGoodEnough(const numeric::Interval& separation, const numeric::Interval& of_cores,
                  const ConvexQuery& query, double size) {
  if (query.goal == ConvexGoal::kDistance && separation.upper <= 0) return true;
  const double least = std::max({0.0, separation.lower, -separation.upper});
  const double width = separation.upper - separation.lower;
  return width <= std::max(query.absolute_tolerance, query.relative_tolerance * least) ||
         of_cores.upper - of_cores.lower <= kTightestWidth * size;
}

}  // namespace

Verdict DecideConvexPair(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                         const RelativePose& pose, WorkBudget* work) {
  Verdict verdict = Verdict::kUndecided;
  work->Spend(kSeparatingAxisUnits);
  const bool any_box = a.core == geometry::ConvexCore::kBox || b.core == geometry::ConvexCore::kBox;
  if (any_box && IsZonotope(a) && IsZonotope(b)) verdict = TestBoxes(a, b, pose);
  if (verdict == Verdict::kUndecided && IsCapsulePair(a, b)) {
    const PosedCores cores(a, b, pose);
    const numeric::Interval of_cores = DistanceOfCores(a, b, cores, pose);
    verdict = VerdictOf(OfSets(of_cores, a.rounding + b.rounding, cores), pose.translation);
  }
  if (verdict == Verdict::kUndecided && IsQuick(a) && IsQuick(b)) {
    work->Spend(kSmallGjkUnits);
    const PosedCores cores(a, b, pose);
    if (cores.size < kSizeMax) verdict = SearchForVerdict(a, b, cores, pose);
  }
  if (verdict != Verdict::kUndecided) return verdict;
  const ConvexGoal goal = pose.translation > 0 ? ConvexGoal::kDepth : ConvexGoal::kYesNo;
  const numeric::Interval found =
      IntervalOf(PosedA(a, pose), PosedB(b, pose), {.goal = goal}, work);
  return VerdictOf(found, pose.translation);
}

numeric::Interval SeparationOfConvexPair(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                                         const RelativePose& pose, const ConvexQuery& query,
                                         WorkBudget* work) {
  const bool thin = IsCapsulePair(a, b);
  if (thin || (IsQuick(a) && IsQuick(b))) {
    work->Spend(thin ? kSeparatingAxisUnits : kSmallGjkUnits);
    const PosedCores cores(a, b, pose);
    const numeric::Interval of_cores =
        thin ? DistanceOfCores(a, b, cores, pose) : SearchForDistance(a, b, cores, pose, query);
    const numeric::Interval separation = OfSets(of_cores, a.rounding + b.rounding, cores);
    if (IsGoodEnough(separation, of_cores, query, cores.size)) return separation;
  }
  return IntervalOf(PosedA(a, pose), PosedB(b, pose), query, work);
}

}  // namespace collision::narrow_phase
