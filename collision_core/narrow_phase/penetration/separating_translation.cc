#include "collision_core/narrow_phase/penetration/separating_translation.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/penetration/local_separating_translation.h"
#include "collision_core/narrow_phase/separation/element.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// The most nodes of a tree that are examined for one direction, since many corners may reach
/// equally far. Beyond, the hull around the shape bounds the reach: to a millionth of the size
/// where corners are few, to some hundredths along round sides.
constexpr std::uint64_t kNodesMax = 64;

/// Directions of other lengths are not tried: their squares may have lost digits.
constexpr double kLengthMin = 0x1p-500, kLengthMax = 0x1p+500;

/// What a direction as floats is off by, of its length: √3 · 2^-24 is less.
constexpr double kFloatDirectionError = 0x1p-23;

/// Relative to the shift along n, of length 1 to within 2^-50: twice that.
constexpr double kLengthShare = 0x1p-49;

/// Relative to reaches and offset. Supports are off by less than kSupportError (18 · 2^-53) of the
/// spans, and these are at most thrice the reach: 54 · 2^-53, sums and products less than as much
/// again, and more than twice all that.
constexpr double kReachRounding = 0x1p-45;

/// How far a body reaches along n, in its own frame: best first down its tree, so that few nodes
/// are examined. What rounding makes of the result, relative to the reach, the caller adds.
class ReachQuery {
 public:
  ReachQuery(const BodyTree& body, const Vector3d& n, WorkBudget* work)
      : body_(body), n_(n), work_(*work) {}

  double Find() {
    if (body_.shape() == nullptr) return body_.reach();
    Visit(sphere_tree::SphereTree::kRoot);
    if (nodes_ <= kNodesMax) return work_.exhausted() ? numeric::kInfinity : farthest_;
    const shape::OuterHull& hull = body_.shape()->hull();
    const double height = static_cast<double>(hull.Along(n_.cast<float>()).height);
    return n_.dot(hull.origin()) + height +
           (shape::kHullSupportError + kFloatDirectionError) * hull.extent();
  }

 private:
  double BoundOf(const sphere_tree::SphereNode& node) const {
    return n_.dot(node.centre) + node.radius;
  }

  void Visit(NodeIndex index) {
    const sphere_tree::SphereNode& node = body_.node(index);
    if (nodes_ > kNodesMax || work_.exhausted()) return;
    ++nodes_;
    work_.Spend(1);
    if (BoundOf(node) <= farthest_) return;
    const sphere_tree::SphereTree& tree = body_.shape()->tree();
    for (const ElementIndex element : tree.ElementsOf(node)) Take(element);
    // The child that may reach the farthest first: it makes the others needless.
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < node.children; ++i) {
      if (BoundOf(tree.node(node.child(i))) > BoundOf(tree.node(node.child(best)))) best = i;
    }
    if (!node.is_leaf()) Visit(node.child(best));
    for (std::uint32_t i = 0; i < node.children; ++i) {
      if (i != best) Visit(node.child(i));
    }
  }

  void Take(ElementIndex element) {
    const shape::Shape& shape = *body_.shape();
    if (shape.IsSolid(element)) {
      const geometry::ConvexSet& set = shape.SolidAt(element).set();
      const double core = n_.dot(set.centre) + n_.dot(set.SupportPoint(n_));
      farthest_ = std::max(farthest_, core + set.rounding + set.error);
      return;
    }
    for (const Vector3d& corner : CornersOf(shape, element)) {
      farthest_ = std::max(farthest_, n_.dot(corner));
    }
  }

  const BodyTree& body_;
  const Vector3d n_;
  WorkBudget& work_;
  std::uint64_t nodes_ = 0;
  double farthest_ = -numeric::kInfinity;
};

/// Across an element: of a triangle its normal.
Vector3d NormalOf(const BodyTree& surface, ElementIndex element) {
  if (surface.shape() == nullptr || surface.shape()->IsSolid(element)) return Vector3d::Zero();
  const geometry::TrianglePoints t = CornersOf(*surface.shape(), element);
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

}  // namespace

// Along n, of length 1 to within 2^-50: A reaches up to reach_a, B from offset − reach_b on; so
// moved by the sum less what lies between they do not overlap.
double SeparatingTranslationAlong(const PosedPair& pair, const Vector3d& n, WorkBudget* work) {
  CORE_CHECK(IsUnit(n), "the direction has length 1", n.norm());
  const BodyTree &a = pair.a, &b = pair.b;
  const RelativePose& pose = pair.pose;
  const double reach_a = ReachQuery(a, n, work).Find();
  const double reach_b = ReachQuery(b, -(pose.R_AB.transpose() * n), work).Find();
  const double size = a.reach() + b.reach() + pose.p_AB.cwiseAbs().sum();
  const double turning = pose.chord_A * a.turning_reach() + pose.chord_B * b.turning_reach();
  const double shift = reach_a + reach_b - n.dot(pose.p_AB);
  return shift + kLengthShare * std::abs(shift) + kReachRounding * size + 2 * SlackOf(pair) +
         turning * numeric::kManyRoundingsUp;
}

double SeparatingTranslation(const PosedPair& pair, const ContactWitness& witness,
                             WorkBudget* work) {
  const BodyTree &a = pair.a, &b = pair.b;
  const RelativePose& pose = pair.pose;
  // First across the witness of contact: bodies that touch are mostly taken apart that way.
  std::vector<Vector3d> ways;
  const auto add = [&](const Vector3d& direction) {
    const double length = direction.norm();
    if (length > kLengthMin && length < kLengthMax) ways.push_back(direction / length);
  };
  const auto add_axis = [&](const Vector3d& axis) {
    add(axis.dot(pose.p_AB) < 0 ? Vector3d(-axis) : axis);
  };
  if (witness.kind == ContactWitness::Kind::kNodes) {
    add(pose.ToA(b.node(witness.nodes.b).centre) - a.node(witness.nodes.a).centre);
  }
  if (witness.kind == ContactWitness::Kind::kElements) {
    const auto [of_a, of_b] = witness.elements;
    if (AnySolid(a, b, witness.elements)) {
      geometry::GjkHint none;
      add(SeparationOf(PosedA(SetOf(a, of_a), pose), PosedB(SetOf(b, of_b), pose), {}, &none, work)
              .normal);
    }
    add(NormalOf(a, of_a));
    add(pose.R_AB * -NormalOf(b, of_b));
  }
  add(pose.p_AB);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (a.shape()) add_axis(Vector3d::Unit(axis));
    if (b.shape()) add_axis(pose.R_AB.col(axis));
  }
  for (std::size_t i = 0, count = ways.size(); i < count; ++i) ways.push_back(-ways[i]);
  double least = numeric::kInfinity;
  for (const Vector3d& way : ways) {
    // Against the centres' way only a large body is left sooner than along it.
    if (way.dot(pose.p_AB) < 0 && -way.dot(pose.p_AB) >= least) continue;
    if (!work->exhausted()) least = std::min(least, SeparatingTranslationAlong(pair, way, work));
  }
  least = std::max(0.0, least);
  WorkBudget own(std::min(kLocalTranslationUnits, work->left()));
  for (const Vector3d& way : ways)
    least = LocalSeparatingTranslation(pair, way, least, witness, &own);
  work->Spend(own.spent());
  return least;
}

}  // namespace collision::narrow_phase
