#include "collision_core/narrow_phase/separation/separation_search.h"

#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/separation/element.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

// If two balls have children, both are opened, unless one is larger than this times the other.
constexpr float kMuchLarger = 4;

// A search checks the budget before each step, and spends no more than this in one: all triangles
// of two blocks measured. Two elements of which one is a solid cost no more (kSolidPairUnits).
constexpr std::uint64_t kStepUnitsMax =
    kBlockPairUnits + sphere_tree::kBlockTriangles * sphere_tree::kBlockTriangles *
                          (kBoxPairUnits + kCrossingUnits + kTrianglePairUnits);
static_assert(kStepUnitsMax + kPoseUnits + kPackRowUnits == kBatchUnits);

// Bodies that are farther apart than this [m] are not examined more closely: their sizes, at most
// 4e7 m (kMeshReachMax), are nothing beside it, and squares stay within single precision.
constexpr double kFarApart = 1e15;

float FloatDown(double x) { return -numeric::FloatUp(-x); }

Eigen::Vector3f NormalOf(const sphere_tree::TriangleBlock& block) {
  constexpr std::uint32_t kNormals = 3 * sphere_tree::kBlockTriangles;
  return {block.x[kNormals], block.y[kNormals], block.z[kNormals]};
}

/// Element i of a leaf that begins with this block.
ElementIndex ElementAt(const sphere_tree::TriangleBlock* leaf, std::uint32_t i) {
  return leaf[i / sphere_tree::kBlockTriangles].element[i % sphere_tree::kBlockTriangles];
}

}  // namespace

SeparationSearch::SeparationSearch(const PosedPair& pair, Goal goal,
                                   std::optional<BracketTolerance> narrow, SearchOrder order,
                                   const SpherePairKernel& scan)
    : a_(pair.a),
      b_(pair.b),
      scan_(scan),
      body_a_(a_),
      body_b_(b_),
      findings_(pair, goal, narrow),
      pose_(KernelPoseOf(body_a_, body_b_, pair.pose, findings_.slack())),
      moved_(pair.pose.translation),
      looks_for_margin_(goal == Goal::kContact),
      only_within_(goal == Goal::kYesNo),
      frontier_(order == SearchOrder::kAsGoal && (goal == Goal::kYesNo || narrow)
                    ? FrontierOrder::kNewestFirst
                    : FrontierOrder::kNearestFirst) {
  std::fill_n(beyond_, kLanesOver, sphere_tree::kFarDistance);
}

void SeparationSearch::Start(WorkBudget* work) {
  work->Spend(kPackRowUnits);
  root_lower_ = findings_.MeasureNodes({});
  const Eigen::Map<const Eigen::Vector3f> offset(pose_.offset);
  if (!(offset.cwiseAbs().maxCoeff() < kFarApart)) {
    findings_.AddResolved(root_lower_);
    done_ = true;
    return;
  }
  frontier_.Push({FloatDown(root_lower_), 0, 0, 0});
}

void SeparationSearch::Refine(WorkBudget* work) {
  while (!done_) {
    if (frontier_.empty() || findings_.IsFinal()) {
      done_ = true;
      return;
    }
    if (work->exhausted()) return;
    const double limit = findings_.Limit();
    if (static_cast<double>(frontier_.next().lower) > limit) {
      // No pair that is left is nearer; with the newest first this holds for the present pair only.
      if (frontier_.order() == FrontierOrder::kNewestFirst) {
        findings_.AddResolved(static_cast<double>(frontier_.Pop().lower));
      } else {
        done_ = true;
      }
      continue;
    }
    const std::uint64_t before = work->spent();
    Open(frontier_.Pop(), numeric::FloatUp(limit), work);
    if (looks_for_margin_ && findings_.Touching()) {
      margin_units_ += work->spent() - before;
      done_ = margin_units_ > kMarginUnits;
    }
  }
}

void SeparationSearch::Open(const BallPair& pair, float limit, WorkBudget* work) {
  deepest_a_ = std::max(deepest_a_, pair.a);
  deepest_b_ = std::max(deepest_b_, pair.b);
  const bool leaf_a = sphere_tree::BallLink::IsLeaf(body_a_.LinkOf(pair.a));
  const bool leaf_b = sphere_tree::BallLink::IsLeaf(body_b_.LinkOf(pair.b));
  if (leaf_a && leaf_b) return OpenLeaves(pair, limit, work);
  if (leaf_a) return OpenBalls(pair, Opened::kB, limit, work);
  if (leaf_b) return OpenBalls(pair, Opened::kA, limit, work);
  const float radius_a = body_a_.RadiusOf(pair.a), radius_b = body_b_.RadiusOf(pair.b);
  const bool much_a = radius_a > kMuchLarger * radius_b;
  const bool much_b = radius_b > kMuchLarger * radius_a;
  OpenBalls(pair, much_a ? Opened::kA : much_b ? Opened::kB : Opened::kBoth, limit, work);
}

/// One step: the balls of pair 0, and by which part of its number, lane or row, others differ.
struct SeparationSearch::Opening {
  sphere_tree::BallRef a, b;
  std::uint32_t lanes_of_a, lanes_of_b, rows_of_a;  ///< Masks.

  BallPair PairOf(std::uint32_t code, float lower) const {
    const std::uint32_t lane = code % sphere_tree::kPackBalls, row = code / sphere_tree::kPackBalls;
    return {lower, a + (lane & lanes_of_a) + (row & rows_of_a), b + (lane & lanes_of_b), 0};
  }
};

void SeparationSearch::OpenBalls(const BallPair& pair, Opened opened, float limit,
                                 WorkBudget* work) {
  const std::uint32_t link_a = body_a_.LinkOf(pair.a), link_b = body_b_.LinkOf(pair.b);
  const std::uint32_t inner_a = sphere_tree::BallLink::Index(link_a),
                      inner_b = sphere_tree::BallLink::Index(link_b);
  constexpr std::uint32_t kAll = sphere_tree::kPackBalls - 1;
  BallScanTask task;
  task.opened = opened;
  task.a = body_a_.packs + (opened == Opened::kB ? pair.a / sphere_tree::kPackBalls : inner_a);
  task.b = body_b_.packs + (opened == Opened::kA ? pair.b / sphere_tree::kPackBalls : inner_b);
  task.lane = (opened == Opened::kA ? pair.b : pair.a) % sphere_tree::kPackBalls;
  task.rows = opened == Opened::kBoth ? sphere_tree::BallLink::Count(link_a) : 1;
  task.parent = BoundOf(pair);
  task.limit = limit;
  task.upper = numeric::FloatUp(only_within_ ? std::min(upper(), -moved_) : upper());
  task.only_within = only_within_;
  const Opening opening =
      opened == Opened::kA   ? Opening{inner_a * sphere_tree::kPackBalls, pair.b, kAll, 0, 0}
      : opened == Opened::kB ? Opening{pair.a, inner_b * sphere_tree::kPackBalls, 0, kAll, 0}
                             : Opening{inner_a * sphere_tree::kPackBalls,
                                       inner_b * sphere_tree::kPackBalls, 0, kAll, kAll};
  work->Spend(task.rows * kPackRowUnits);
  BallHits hits;
  scan_.balls(pose_, task, beyond_, &hits, nullptr);
  if (static_cast<double>(hits.upper) < upper()) TightenUpper(opening, task, hits.upper);
  BallPair* const pairs = frontier_.Room(kPairsMax);
  std::size_t count = 0;
  for (std::uint64_t within = hits.within; within != 0; within &= within - 1) {
    const auto code = static_cast<std::uint32_t>(__builtin_ctzll(within));
    pairs[count++] = opening.PairOf(code, hits.lowers[code]);
  }
  frontier_.Take(count);
}

// Where this bound makes contact certain, finds the pair of balls that gave it, the witness.
void SeparationSearch::TightenUpper(const Opening& opening, const BallScanTask& task, float upper) {
  if (static_cast<double>(upper) <= -moved_) {
    BallHits hits;
    float uppers[kPairsMax + kLanesOver];
    scan_.balls(pose_, task, beyond_, &hits, uppers);
    const float* const nearest =
        std::find(uppers, uppers + task.rows * sphere_tree::kPackBalls, upper);
    const BallPair balls = opening.PairOf(static_cast<std::uint32_t>(nearest - uppers), 0);
    findings_.MeasureNodes({body_a_.NodeOf(balls.a), body_b_.NodeOf(balls.b)});
  }
  findings_.TightenUpper(static_cast<double>(upper));
}

// Measures one pair of blocks, or of elements of which one is a solid, and puts the others back
// into the frontier.
void SeparationSearch::OpenLeaves(BallPair pair, float limit, WorkBudget* work) {
  const std::uint32_t first_a = sphere_tree::BallLink::Index(body_a_.LinkOf(pair.a));
  const std::uint32_t first_b = sphere_tree::BallLink::Index(body_b_.LinkOf(pair.b));
  const sphere_tree::TriangleBlock* const a =
      body_a_.tree ? body_a_.tree->blocks() + first_a : nullptr;
  const sphere_tree::TriangleBlock* const b =
      body_b_.tree ? body_b_.tree->blocks() + first_b : nullptr;
  const bool any_solid =
      AnySolid(a_, b_, {a ? a->element[0] : ElementIndex(), b ? b->element[0] : ElementIndex()});
  const std::uint32_t at_once = any_solid ? 1 : sphere_tree::kBlockTriangles;
  const auto turns_of = [&](const sphere_tree::TriangleBlock* leaf) {
    return leaf ? (leaf->left + at_once - 1) / at_once : 1;
  };
  const std::uint32_t of_a = turns_of(a), of_b = turns_of(b);
  const std::uint32_t at_a = pair.next / of_b, at_b = pair.next % of_b;
  if (any_solid) {
    OpenSolids(pair,
               {a ? ElementAt(a, at_a) : ElementIndex(), b ? ElementAt(b, at_b) : ElementIndex()},
               work);
  } else if (a && b) {
    OpenBlocks(pair, a[at_a], b[at_b], limit, work);
  } else {
    OpenBlock(pair, a ? a[at_a] : b[at_b], work);
  }
  if (++pair.next < of_a * of_b) frontier_.Push(pair);
}

void SeparationSearch::OpenSolids(const BallPair& pair, ElementPair elements, WorkBudget* work) {
  const double lower = findings_.MeasureElements(elements, work);
  findings_.AddResolved(std::max(lower, static_cast<double>(BoundOf(pair))));
}

// From ball to ball, about a unit vector; `other` where the centres nearly coincide.
Eigen::Vector3f SeparationSearch::DirectionBetween(const BallPair& pair,
                                                   const Eigen::Vector3f& other) const {
  const Eigen::Vector3f c_a = body_a_.CentreOf(pair.a), c_b = body_b_.CentreOf(pair.b);
  const float* const m = pose_.matrix;
  const Eigen::Vector3f turned((m[0] * c_b[0] + m[1] * c_b[1]) + m[2] * c_b[2],
                               (m[3] * c_b[0] + m[4] * c_b[1]) + m[5] * c_b[2],
                               (m[6] * c_b[0] + m[7] * c_b[1]) + m[8] * c_b[2]);
  const Eigen::Vector3f way = (turned + Eigen::Vector3f(pose_.offset)) - c_a;
  const float square = (way[0] * way[0] + way[1] * way[1]) + way[2] * way[2];
  return square > kDistinctMin * kDistinctMin ? way * (1 / std::sqrt(square)) : other;
}

void SeparationSearch::OpenBlocks(const BallPair& pair, const sphere_tree::TriangleBlock& a,
                                  const sphere_tree::TriangleBlock& b, float limit,
                                  WorkBudget* work) {
  work->Spend(kBlockPairUnits);
  // Along the shortest way found, or as long as there is none, from ball to ball.
  const bool has_way = findings_.direction() != Eigen::Vector3d::Zero();
  const Eigen::Vector3f direction =
      has_way ? findings_.direction().cast<float>() : DirectionBetween(pair, NormalOf(a));
  std::copy_n(direction.data(), 3, pose_.direction);
  // Sums and products of floats, up by more than they are rounded.
  const float turning = pose_.turn_a * a.reach + pose_.turn_b * b.reach;
  const float slack = (pose_.triangle_slack + turning) * numeric::kSomeFloatRoundingsUp;
  float lowers[sphere_tree::kBlockTriangles * sphere_tree::kBlockTriangles];
  unsigned within =
      scan_.triangles(pose_, {&a, &b, slack, BoundOf(pair), limit, only_within_}, beyond_, lowers);
  const double least = static_cast<double>(BoundOf(pair));
  for (; within != 0; within &= within - 1) {
    const auto code = static_cast<std::uint32_t>(__builtin_ctz(within));
    const std::uint32_t row = code / sphere_tree::kBlockTriangles,
                        column = code % sphere_tree::kBlockTriangles;
    if (row >= a.left || column >= b.left) continue;
    const FirstTest first = lowers[code] + slack <= 0 ? FirstTest::kCrossing : FirstTest::kDistance;
    const double lower =
        findings_.MeasureTriangles({a.element[row], b.element[column]}, first, work);
    findings_.AddResolved(std::max(lower, least));
    if (findings_.IsFinal()) break;
  }
}

// Triangles beside a ball.
void SeparationSearch::OpenBlock(const BallPair& pair, const sphere_tree::TriangleBlock& block,
                                 WorkBudget* work) {
  const double least = static_cast<double>(BoundOf(pair));
  for (std::uint32_t i = 0; i < std::min(block.left, sphere_tree::kBlockTriangles); ++i) {
    findings_.AddResolved(std::max(findings_.MeasureBallAgainst(block.element[i], work), least));
  }
}

void SeparationSearch::TryLeaves(NodePair leaves, WorkBudget* work) {
  const sphere_tree::SphereNode& a = a_.node(leaves.a);
  const sphere_tree::SphereNode& b = b_.node(leaves.b);
  if (!a_.shape() || !b_.shape()) {
    const sphere_tree::SphereTree& tree = (a_.shape() ? a_ : b_).shape()->tree();
    for (const ElementIndex t : tree.ElementsOf(a_.shape() ? a : b)) {
      if (work->exhausted()) return;
      findings_.MeasureBallAgainst(t, work);
    }
    return;
  }
  for (const ElementIndex t : a_.shape()->tree().ElementsOf(a)) {
    for (const ElementIndex u : b_.shape()->tree().ElementsOf(b)) {
      if (work->exhausted()) return;
      findings_.MeasureElements({t, u}, work);
    }
  }
}

double SeparationSearch::lower() const {
  const auto beyond = static_cast<double>(*std::min_element(beyond_, beyond_ + kLanesOver));
  double least = frontier_.Least();
  if (only_within_ && !frontier_.empty()) least = -numeric::kInfinity;
  return std::max(root_lower_, std::min({findings_.resolved_lower(), least, beyond}));
}

SeparationBracket SeparationSearch::Result() {
  const std::uint32_t level = std::max(a_.node(body_a_.NodeOf(deepest_a_)).level,
                                       b_.node(body_b_.NodeOf(deepest_b_)).level);
  return findings_.Result({.unopened = lower(), .exhausted = !done_, .level = level});
}

}  // namespace collision::narrow_phase
