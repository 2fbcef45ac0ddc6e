// A point of a body that turns about an axis n through its reference point keeps its height z = n·x
// and its distance ρ = |x − z n| from the axis: a part of the body stays in a ring z0 <= z <= z1,
// ρ0 <= ρ <= ρ1. Another point at (ρ, z) is at least as far from it as from that rectangle. What of
// the other body is a ball, a triangle or a solid in its box covers such a rectangle itself; if the
// other turns as well, its part stays in a ball about its own axis.
//
// Both bodies' rings give such a bound, and neither changes faster than the reference points move
// relative to each other.
//
// A part may stay in a ring about another axis m, at the angle φ to n, with the middle c, half the
// height h and the outer radius R. Its heights along n are then n·c ± (h |cos φ| + R sin φ), and
// across n it reaches no farther than h sin φ + R from c.
#include "collision_core/narrow_phase/advancement/swept_ring.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/node_pair.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Steps for one pair of parts; each goes on from where the last one ended.
constexpr int kSteps = 8;

// Steps shorter than this share of the duration are not worth another.
constexpr double kStepWorth = 1e-4;

/// A corner of a box, of |c| and the span: three products and three sums, 2^-53 of these each, in
/// three coordinates; below 11 · 2^-53.
constexpr double kCornerRounding = 0x1p-49;

/// Relative to reaches, offset and way: four times the share that PointMotion takes for tangents,
/// since heights and radii about the axis are sums of products with its coordinates, rounded as
/// well.
constexpr double kRingRounding = 0x1p-46;

/// The hull of some points, one to eight, rounded by `radius`: a ball, a triangle, or what holds a
/// convex solid; seen from its body's reference point.
struct Part {
  std::array<Vector3d, 8> corners;
  int count = 0;
  double radius = 0;

  Part() { corners.fill(Vector3d::Zero()); }
  static Part Ball(const Vector3d& centre, double radius) {
    Part part;
    part.Add(centre);
    part.radius = radius;
    return part;
  }
  void Add(const Vector3d& corner) { corners[count++] = corner; }
  double far() const {
    double most = 0;
    for (int i = 0; i < count; ++i) most = std::max(most, corners[i].norm());
    return most;
  }
};

/// Around a solid in its body frame: an end of a capsule's core each, else the corners of a box.
Part Around(const shape::ConvexSolid& solid) {
  const geometry::ConvexSet& set = solid.set();
  if (set.core == geometry::ConvexCore::kPoint) {
    return Part::Ball(set.centre, numeric::AddUp(set.rounding, set.error));
  }
  Part part;
  if (set.core == geometry::ConvexCore::kHull || set.core == geometry::ConvexCore::kTriangle) {
    const shape::ConvexFacts& facts = solid.facts();
    for (int i = 0; i < 8; ++i) {
      part.Add({(i & 1 ? facts.upper : facts.lower).x(), (i & 2 ? facts.upper : facts.lower).y(),
                (i & 4 ? facts.upper : facts.lower).z()});
    }
    return part;
  }
  // Ellipsoids, cylinders and cones lie in the box of their axes.
  const int corners = set.core == geometry::ConvexCore::kSegment ? 2 : 8;
  for (int i = 0; i < corners; ++i) {
    part.Add(set.centre +
             set.PointAt({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}));
  }
  const double rounding =
      numeric::MultiplyUp(kCornerRounding, numeric::AddUp(set.span, set.centre.cwiseAbs().sum()));
  part.radius = numeric::AddUp(numeric::AddUp(set.rounding, set.error), rounding);
  return part;
}

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The distance of the origin to a triangle in the plane.
double DistanceToOrigin(const std::array<Vector2d, 3>& t) {
  double least = numeric::kInfinity;
  int left = 0, right = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector2d &p = t[i], e = t[(i + 1) % 3] - p;
    const double square = e.squaredNorm();
    const double at = square > 0 ? std::clamp(-p.dot(e) / square, 0.0, 1.0) : 0;
    least = std::min(least, (p + at * e).norm());
    const double side = Cross(p, e);
    left += side >= 0;
    right += side <= 0;
  }
  return left == 3 || right == 3 ? 0 : least;
}

/// No point of the hull is nearer to the origin. All of it lies beyond a line across the way to its
/// middle.
double InnerOf(const std::array<Vector2d, 8>& points, int count, double outer) {
  if (count == 1) return outer;
  if (count == 3) return DistanceToOrigin({points[0], points[1], points[2]});
  Vector2d middle = Vector2d::Zero();
  for (int i = 0; i < count; ++i) middle += points[i];
  const double length = middle.norm();
  if (!(length > 0)) return 0;
  double inner = outer;
  for (int i = 0; i < count; ++i) inner = std::min(inner, points[i].dot(middle) / length);
  return std::max(0.0, inner);
}

/// What a part covers of heights along an axis, and of distances from it.
struct Ring {
  double low = numeric::kInfinity, high = -numeric::kInfinity;
  double inner = 0, outer = 0;

  double DistanceTo(const Ring& other) const {
    const double along = std::max({0.0, low - other.high, other.low - high});
    const double across = std::max({0.0, inner - other.outer, other.inner - outer});
    return std::sqrt(along * along + across * across);
  }
};

class Axis {
 public:
  explicit Axis(const Vector3d& spin) : turns_(!spin.isZero(0)), n_(spin.normalized()) {
    const int least = n_.x() * n_.x() < 0.5 ? 0 : 1;
    u_ = n_.cross(Vector3d::Unit(least)).normalized();
    v_ = n_.cross(u_);
  }

  bool turns() const { return turns_; }

  /// The ring of a part moved by `by`, seen from the axis' body.
  Ring RingOf(const Part& part, const Vector3d& by) const {
    Ring ring;
    std::array<Vector2d, 8> across;
    for (int i = 0; i < part.count; ++i) {
      const Vector3d x = part.corners[i] + by;
      const double z = n_.dot(x);
      ring.low = std::min(ring.low, z);
      ring.high = std::max(ring.high, z);
      across[i] = {u_.dot(x), v_.dot(x)};
      ring.outer = std::max(ring.outer, across[i].norm());
    }
    ring.inner = InnerOf(across, part.count, ring.outer);
    return ring;
  }

  /// The ring that contains a ring about another axis, whose body is at `by`.
  Ring RingOf(const Axis& axis, const Ring& of_part, const Vector3d& by) const {
    const double half = 0.5 * (of_part.high - of_part.low);
    const Vector3d middle = by + (of_part.low + half) * axis.n_;
    const double cosine = std::abs(n_.dot(axis.n_)), sine = n_.cross(axis.n_).norm();
    const double along = n_.dot(middle), extent = half * cosine + of_part.outer * sine;
    const double across = std::hypot(u_.dot(middle), v_.dot(middle));
    const double reach = half * sine + of_part.outer;
    return {along - extent, along + extent, std::max(0.0, across - reach), across + reach};
  }

 private:
  bool turns_;
  Vector3d n_, u_, v_;
};

class Search {
 public:
  Search(const SweptPair& pair, double duration, WorkBudget* work)
      : a_(pair.a),
        b_(pair.b),
        swept_(pair.swept),
        axis_a_(pair.swept.spin_A),
        axis_b_(pair.swept.spin_B),
        duration_(duration),
        work_(*work) {
    const auto& [a, b, swept] = pair;
    const RelativePose& pose = swept.pose;
    const double reach = a.reach() + b.reach();
    speed_ = swept.velocity.norm() * numeric::kManyRoundingsUp + swept.velocity_error;
    // As for tangents (point_motion.cc); and the axes are off by what turned them.
    slack_ = numeric::AddUp(
        numeric::MultiplyUp(kRingRounding, reach + pose.p_AB.cwiseAbs().sum() + duration * speed_),
        numeric::AddUp(pose.offset_error, numeric::MultiplyUp(3 * pose.matrix_error, reach)));
  }

  double Run() {
    OfferNodes({}, 0);
    while (!heap_.empty()) {
      const Candidate front = heap_.front();
      if (front.resolved || work_.exhausted()) return front.time;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      Open(front);
    }
    return numeric::kInfinity;
  }

 private:
  struct Candidate {
    double time;
    NodePair nodes;
    bool resolved;

    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.time != y.time) return x.time > y.time;
      return x.nodes.a != y.nodes.a ? x.nodes.a > y.nodes.a : x.nodes.b > y.nodes.b;
    }
  };

  void Open(const Candidate& pair) {
    const auto offer = [&](NodePair children) { OfferNodes(children, pair.time); };
    if (!OpenLarger(a_, b_, pair.nodes, offer)) OfferParts(pair);
  }

  void OfferNodes(NodePair nodes, double parent) {
    work_.Spend(1);
    const sphere_tree::SphereNode &a = a_.node(nodes.a), &b = b_.node(nodes.b);
    const Part of_a = Part::Ball(a.centre, a.radius);
    const Part of_b = Part::Ball(SeenFromB(b.centre), b.radius);
    Push({std::max(parent, LowerBoundOfImpact(of_a, of_b)), nodes, false});
  }

  // Two leaves are resolved by the earliest of their triangles; where the work ends before all were
  // looked at, by their balls.
  void OfferParts(const Candidate& pair) {
    const std::vector<Part> of_a = PartsOfA(pair.nodes.a), of_b = PartsOfB(pair.nodes.b);
    double earliest = numeric::kInfinity;
    for (const Part& a : of_a) {
      for (const Part& b : of_b) {
        if (work_.exhausted()) return Push({pair.time, pair.nodes, true});
        work_.Spend(kTrianglePairUnits);
        earliest = std::min(earliest, LowerBoundOfImpact(a, b));
      }
    }
    Push({std::max(pair.time, earliest), pair.nodes, true});
  }

  Vector3d SeenFromB(const Vector3d& x_B) const { return swept_.pose.ToA(x_B) - swept_.pose.p_AB; }

  /// The elements of a leaf of A, or A itself if it is a ball.
  std::vector<Part> PartsOfA(NodeIndex leaf) const { return PartsOf(a_, leaf); }

  /// The same of B, in the axes of A's body.
  std::vector<Part> PartsOfB(NodeIndex leaf) const {
    std::vector<Part> parts = PartsOf(b_, leaf);
    if (b_.shape() == nullptr) return parts;
    for (Part& part : parts) {
      for (int i = 0; i < part.count; ++i) part.corners[i] = SeenFromB(part.corners[i]);
    }
    return parts;
  }

  static std::vector<Part> PartsOf(const BodyTree& body, NodeIndex leaf) {
    if (body.shape() == nullptr) return {Part::Ball(Vector3d::Zero(), body.reach())};
    std::vector<Part> parts;
    for (const ElementIndex element : body.shape()->tree().ElementsOf(body.node(leaf))) {
      Part part;
      if (body.shape()->IsSolid(element)) {
        part = Around(body.shape()->SolidAt(element));
      } else {
        for (const Vector3d& corner : CornersOf(*body.shape(), element)) part.Add(corner);
      }
      parts.push_back(part);
    }
    return parts;
  }

  void Push(const Candidate& candidate) {
    if (candidate.time > duration_) return;
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  // `offset`: of B's reference point seen from A's.
  double Distance(const Part& a, const Part& b, const Ring& ring_a, const Ring& ring_b,
                  const Vector3d& offset) const {
    double distance = -numeric::kInfinity;
    if (axis_a_.turns()) {
      const Ring of_b =
          axis_b_.turns() ? axis_a_.RingOf(axis_b_, ring_b, offset) : axis_a_.RingOf(b, offset);
      distance = ring_a.DistanceTo(of_b);
    }
    if (axis_b_.turns()) {
      const Ring of_a =
          axis_a_.turns() ? axis_b_.RingOf(axis_a_, ring_a, -offset) : axis_b_.RingOf(a, -offset);
      distance = std::max(distance, ring_b.DistanceTo(of_a));
    }
    return distance - a.radius - b.radius;
  }

  double LowerBoundOfImpact(const Part& a, const Part& b) const {
    const Ring ring_a = axis_a_.RingOf(a, Vector3d::Zero());
    const Ring ring_b = axis_b_.RingOf(b, Vector3d::Zero());
    const auto &u = swept_.translation, &ta = swept_.turning_A, &tb = swept_.turning_B;
    const double far_a = a.far() * numeric::kManyRoundingsUp,
                 far_b = b.far() * numeric::kManyRoundingsUp;
    const double c0 = slack_ + u.c0 + ta.c0 * far_a + tb.c0 * far_b;
    const double c1 = u.c1 + ta.c1 * far_a + tb.c1 * far_b;
    const double c2 = std::max(0.0, u.c2 + ta.c2 * far_a + tb.c2 * far_b);
    double h = 0;
    for (int step = 0; step < kSteps; ++step) {
      const Vector3d offset = swept_.pose.p_AB + h * swept_.velocity;
      const double gap = Distance(a, b, ring_a, ring_b, offset) - (c0 + h * (c1 + h * c2));
      const double further = numeric::FirstRoot(gap, speed_ + c1 + 2 * h * c2, c2);
      h += further;
      if (h > duration_) return numeric::kInfinity;
      if (further < kStepWorth * duration_) break;
    }
    return h;
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const SweptPose& swept_;
  const Axis axis_a_, axis_b_;
  const double duration_;
  WorkBudget& work_;
  double slack_ = 0, speed_ = 0;
  std::vector<Candidate> heap_;
};

}  // namespace

double SweptRingBound(const SweptPair& pair, double duration, WorkBudget* work) {
  return Search(pair, duration, work).Run();
}

}  // namespace collision::narrow_phase
