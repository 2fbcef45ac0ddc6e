#include "collision_core/narrow_phase/advancement/conservative_advancement.h"

#include <algorithm>
#include <unordered_set>

#include "collision_core/narrow_phase/advancement/impact_queue.h"
#include "collision_core/narrow_phase/advancement/swept_balls.h"
#include "collision_core/narrow_phase/advancement/swept_elements.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/node_pair.h"
#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {
namespace {

// Tangent steps for a pair of elements, each only when no other pair may touch earlier.
constexpr int kElementSteps = 16;

// A leaf is wide beside a ball of less than an eighth of its radius.
constexpr double kWideLeaf = 8;

using Kind = ImpactCandidate::Kind;

// In place of a solid or a ball: a point, in the box of the ball about it.
BoxedTriangle BoxOfBall(ElementIndex element, const Eigen::Vector3d& centre, double radius) {
  BoxedTriangle box(element, {centre, centre, centre});
  box.lower.array() -= radius;
  box.upper.array() += radius;
  return box;
}

// The search for the first impact: opens pairs of nodes, then follows pairs of elements.
class Search {
 public:
  Search(const SweptPair& pair, double duration, WorkBudget* work, const SweepDetail& detail)
      : a_(pair.a),
        b_(pair.b),
        swept_(pair.swept),
        motion_(pair),
        elements_(pair, motion_, duration, work),
        duration_(duration),
        detail_(detail),
        work_(*work),
        queue_(duration) {}

  ImpactBound Run() {
    ImpactBound found;
    OfferNodes({}, 0);
    while (!queue_.empty()) {
      const ImpactCandidate& front = queue_.front();
      found.seconds = front.time;
      if (front.kind == Kind::kResolved) {
        found.resolved = front.has_elements();
        if (found.resolved) found.leaves = front.nodes;
        return found;
      }
      if (work_.exhausted()) {
        found.exhausted = true;
        return found;
      }
      const ImpactCandidate next = queue_.Pop();
      next.kind == Kind::kNodes ? Open(next) : Step(next);
    }
    found.seconds = numeric::kInfinity;
    return found;
  }

 private:
  // Spheres need not be finer than a share of what is not known of the motion.
  bool IsFineEnough(const ImpactCandidate& pair) const {
    const SweptPose::Growth unknown = motion_.UsedUp();
    return pair.size <=
           detail_.fine_enough * (unknown.c0 + pair.time * (unknown.c1 + pair.time * unknown.c2));
  }

  void Open(const ImpactCandidate& pair) {
    if (IsFineEnough(pair)) {
      ImpactCandidate resolved = pair;
      resolved.kind = Kind::kResolved;
      queue_.Push(resolved);
      return;
    }
    const auto offer = [&](NodePair children) { OfferNodes(children, pair.time); };
    if (!OpenLarger(a_, b_, pair.nodes, offer)) OfferElements(pair);
  }

  // Triangles are taken whole: each may stand in several leaves, with a part of it in each, and two
  // of them need be examined once only. They do not touch before the time of this first pair of
  // leaves, although it is that of their parts here only: pairs are opened in the order of their
  // times (a child's is not before its parent's), so that the times of the other leaves, which hold
  // the other parts, are not before this one.
  //
  // Where the work ends before all were offered the pair of leaves stays to be opened.
  void OfferElements(const ImpactCandidate& leaves) {
    boxes_of_b_.clear();
    AddBoxesOfB(b_.node(leaves.nodes.b));
    const auto offer = [&](const BoxedTriangle& of_a) {
      for (const BoxedTriangle& of_b : boxes_of_b_) {
        if (work_.exhausted()) return false;
        OfferBoxes(leaves, of_a, of_b);
      }
      return true;
    };
    if (!a_.shape()) {
      if (!offer(BoxOfBall({}, {0, 0, 0}, a_.reach()))) queue_.Push(leaves);
      return;
    }
    const sphere_tree::SphereNode& a = a_.node(leaves.nodes.a);
    for (const ElementIndex t : a_.shape()->tree().ElementsOf(a)) {
      if (!offer(a_.shape()->IsSolid(t) ? BoxOfBall(t, a.centre, a.radius)
                                        : BoxedTriangle(t, CornersOf(*a_.shape(), t)))) {
        return queue_.Push(leaves);
      }
    }
  }

  void AddBoxesOfB(const sphere_tree::SphereNode& leaf) {
    if (!b_.shape()) {
      boxes_of_b_.push_back(BoxOfBall({}, swept_.pose.p_AB, b_.reach()));
      return;
    }
    for (const ElementIndex t : b_.shape()->tree().ElementsOf(leaf)) {
      boxes_of_b_.push_back(b_.shape()->IsSolid(t)
                                ? BoxOfBall(t, swept_.pose.ToA(leaf.centre), leaf.radius)
                                : BoxedTriangle(t, CornersOf(*b_.shape(), t, swept_.pose)));
    }
  }

  // Boxes that are far apart cannot meet at the greatest speed of any two points.
  void OfferBoxes(const ImpactCandidate& leaves, const BoxedTriangle& a, const BoxedTriangle& b) {
    work_.Spend(kBoxPairUnits);
    const SweptPose::Growth used = motion_.UsedUp();
    const double time =
        numeric::FirstRoot(BoxDistance(a, b) - used.c0, motion_.fastest() + used.c1, used.c2);
    const std::uint64_t key = std::uint64_t{a.index.value()} << 32 | b.index.value();
    if (time > duration_ || !seen_.insert(key).second) return;
    queue_.Push({std::max(leaves.time, time), Kind::kElements, leaves.nodes, {a.index, b.index}});
  }

  // Before `parent` [s] not even the parents touch.
  void OfferNodes(NodePair nodes, double parent) {
    work_.Spend(1);
    const sphere_tree::SphereNode& a = a_.node(nodes.a);
    const sphere_tree::SphereNode& b = b_.node(nodes.b);
    const Eigen::Vector3d c_b = swept_.pose.ToA(b.centre);
    const SweptPose::Growth used =
        motion_.UsedUp(a.radius + b.radius, a.centre.norm(), b.centre.norm());
    const Eigen::Vector3d d = c_b - a.centre;
    const Eigen::Vector3d w = motion_.VelocityOfB(c_b) - motion_.VelocityOfA(a.centre);
    const numeric::QuickBall difference{
        {d.x(), d.y(), d.z()}, {w.x(), w.y(), w.z()}, used.c0, used.c1, used.c2};
    const double time = SweptBallsTouch(difference, duration_, detail_.step_worth);
    // Balls within the solids that overlap already: nothing is free, and nothing need be opened.
    const bool within = !(time > 0) && d.norm() + a.signed_distance + b.signed_distance < 0;
    const double later =
        within || time > queue_.until() ? time : std::max(time, WideLeafTouch(a, b, c_b));
    ImpactCandidate candidate{std::max(parent, later), Kind::kNodes, nodes};
    if (within) candidate.kind = Kind::kResolved;
    candidate.size = a.radius + b.radius;
    queue_.Push(candidate);
  }

  // The ball about a leaf of large triangles holds much else: beside a small ball its triangles are
  // examined themselves. 0: nothing is known.
  double WideLeafTouch(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b,
                       const Eigen::Vector3d& c_b) {
    const bool of_a = a.is_leaf() && a.radius > kWideLeaf * b.radius;
    if (!of_a && !(b.is_leaf() && b.radius > kWideLeaf * a.radius)) return 0;
    const shape::Shape* shape = (of_a ? a_ : b_).shape();
    if (shape == nullptr) return 0;
    double least = numeric::kInfinity;
    for (const ElementIndex t : shape->tree().ElementsOf(of_a ? a : b)) {
      if (shape->IsSolid(t) || !(least > 0) || work_.exhausted()) return 0;
      work_.Spend(kTrianglePairUnits / 2);
      least = std::min(least, of_a ? elements_.ApartFor(t, CentredBall{c_b, b.radius})
                                   : elements_.ApartFor(CentredBall{a.centre, a.radius}, t));
    }
    return least;
  }

  // One tangent step, as in SweptBallsTouch(): from where the pair is known to be apart up to.
  void Step(ImpactCandidate pair) {
    work_.Spend(kTrianglePairUnits);
    const double further = elements_.ApartFor(pair.elements, pair.time);
    pair.time += further;
    if (++pair.steps == kElementSteps || further < detail_.step_worth * duration_) {
      pair.kind = Kind::kResolved;
    }
    queue_.Push(pair);
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const SweptPose& swept_;
  const PointMotion motion_;
  const SweptElements elements_;
  const double duration_;
  const SweepDetail detail_;
  WorkBudget& work_;
  ImpactQueue queue_;
  std::unordered_set<std::uint64_t> seen_;  ///< Pairs of elements that were offered.
  std::vector<BoxedTriangle> boxes_of_b_;
};

}  // namespace

ImpactBound LowerBoundOfImpact(const SweptPair& pair, double duration, WorkBudget* work,
                               const SweepDetail& detail) {
  return Search(pair, duration, work, detail).Run();
}

}  // namespace collision::narrow_phase
