#include "collision_core/narrow_phase/advancement/conservative_advancement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <unordered_set>

#include "collision_core/geometry/triangle/triangle_directions.h"
#include "collision_core/narrow_phase/advancement/swept_balls.h"
#include "collision_core/narrow_phase/advancement/swept_convex_pair.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/node_pair.h"
#include "collision_core/narrow_phase/separation/element.h"
#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {
namespace {

// Tangent steps for a pair of triangles, each only when no other pair may touch earlier.
constexpr int kTriangleSteps = 16;

// The direction of a way as short as this, as a share of the triangles' size, is uncertain.
constexpr double kShortWay = 0x1p-20;

// Outside of these the square of a length may have lost what it says, by underflow or overflow.
constexpr double kSquareMin = 0x1p-900, kSquareMax = 0x1p+900;

// A leaf is wide beside a ball of less than an eighth of its radius.
constexpr double kWideLeaf = 8;

using Reach = SweptPose::Growth;

class Search {
 public:
  Search(const SweptPair& pair, double duration, WorkBudget* work, const SweepDetail& detail)
      : a_(pair.a),
        b_(pair.b),
        swept_(pair.swept),
        duration_(duration),
        detail_(detail),
        until_(duration),
        work_(*work) {
    const auto& [a, b, swept] = pair;
    const RelativePose& pose = swept.pose;
    // All positions h seconds on are sums of a few of these, and of h times those; compare
    // SlackOf() in posed_pair.h. What is lost grows with h, so that soon after the start the
    // time is known as well as the pose is. The offset counts in what turns as well: a point of B
    // is seen from B's reference point only after both were posed, each with its rounding. What is
    // not known of the motion needs no share: where it is more than the bodies are apart, they may
    // touch anyway.
    const double offset = pose.p_AB.cwiseAbs().sum();
    const double extent = a.reach() + b.reach() + offset;
    const double pace = swept.velocity.cwiseAbs().sum() +
                        a.turning_reach() * swept.spin_A.cwiseAbs().sum() +
                        (b.turning_reach() + offset) * swept.spin_B.cwiseAbs().sum();
    // 1 + 2^-40 for its own rounding.
    fastest_ = (1 + 0x1p-40) * (swept.velocity.norm() + a.turning_reach() * swept.spin_A.norm() +
                                b.turning_reach() * swept.spin_B.norm());
    slack_ = numeric::AddUp(
        numeric::MultiplyUp(0x1p-48, extent),
        numeric::AddUp(pose.offset_error, numeric::MultiplyUp(pose.matrix_error, b.reach())));
    slack_growth_ = numeric::MultiplyUp(0x1p-48, pace);
  }

  ImpactBound Run() {
    ImpactBound found;
    Offer({0, 0}, 0);
    while (!heap_.empty()) {
      const Candidate front = heap_.front();
      found.seconds = front.time;
      if (front.kind == Kind::kResolved) {
        found.resolved = front.steps > 0;
        found.leaf_A = front.leaf_a;
        found.leaf_B = front.leaf_b;
        return found;
      }
      if (work_.exhausted()) {
        found.exhausted = true;
        return found;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      front.kind == Kind::kNodes ? Open(front) : Step(front);
    }
    found.seconds = numeric::kInfinity;
    return found;
  }

 private:
  enum class Kind { kNodes, kTriangles, kResolved };

  struct Candidate {
    double time;
    Kind kind;
    int steps;           // along tangents, of triangles
    std::uint32_t a, b;  // nodes or triangles
    std::uint32_t leaf_a, leaf_b;
    double size = 0;  // of two nodes

    // A heap's front is the greatest: the earliest; of equals what is looked at the farthest, so
    // that of bodies that overlap not all is opened before something is certain; of these the
    // first.
    friend bool operator<(const Candidate& x, const Candidate& y) {
      return std::tie(x.time, y.kind, x.size, x.a, x.b) >
             std::tie(y.time, x.kind, y.size, y.a, y.b);
    }
  };

  void Push(const Candidate& candidate) {
    if (candidate.time > until_) return;
    if (candidate.kind == Kind::kResolved) until_ = candidate.time;
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  // Finer than this share of what is not known of the motion spheres need not be.
  bool FineEnough(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b,
                  double time) const {
    const Reach unknown = ReachOf(0, a_.turning_reach(), b_.turning_reach());
    return a.radius + b.radius <=
           detail_.fine_enough * (unknown.c0 + time * (unknown.c1 + time * unknown.c2));
  }

  void Open(const Candidate& pair) {
    const sphere_tree::SphereNode& a = a_.node(pair.a);
    const sphere_tree::SphereNode& b = b_.node(pair.b);
    if (FineEnough(a, b, pair.time)) {
      Candidate resolved = pair;
      resolved.kind = Kind::kResolved;
      Push(resolved);
      return;
    }
    const auto offer = [&](NodePair children) { Offer(children, pair.time); };
    if (!OpenLarger(a_, b_, {pair.a, pair.b}, offer)) OfferTriangles(pair, a, b);
  }

  // Triangles are taken whole: each may stand in several leaves, with a part of it in each, and two
  // of them need be looked at once only. They do not touch before the time of this first pair of
  // leaves, although it is that of their parts here only: pairs are opened in the order of their
  // times (a child's is not before its parent's), so that the times of the other leaves, which hold
  // the other parts, are not before this one.
  void OfferTriangles(const Candidate& pair, const sphere_tree::SphereNode& a,
                      const sphere_tree::SphereNode& b) {
    boxes_of_b_.clear();
    if (b_.shape()) {
      for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
        boxes_of_b_.push_back(b_.shape()->IsSolid(t)
                                  ? BoxOfBall(t, swept_.pose.ToA(b.centre), b.radius)
                                  : BoxedTriangle(t, CornersOf(*b_.shape(), t, swept_.pose)));
      }
    } else {
      boxes_of_b_.push_back(BoxOfBall(0, swept_.pose.p_AB, b_.reach()));
    }
    // Where the work ends before all were offered the pair stays to be opened.
    const auto offer = [&](const BoxedTriangle& of_a) {
      for (const BoxedTriangle& of_b : boxes_of_b_) {
        if (work_.exhausted()) return false;
        OfferBoxes(pair, of_a, of_b);
      }
      return true;
    };
    if (!a_.shape()) {
      if (!offer(BoxOfBall(0, {0, 0, 0}, a_.reach()))) Push(pair);
      return;
    }
    for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
      if (!offer(a_.shape()->IsSolid(t) ? BoxOfBall(t, a.centre, a.radius)
                                        : BoxedTriangle(t, CornersOf(*a_.shape(), t)))) {
        return Push(pair);
      }
    }
  }

  // In place of a triangle: a point, in the box of the ball about it.
  static BoxedTriangle BoxOfBall(std::uint32_t element, const Eigen::Vector3d& centre,
                                 double radius) {
    BoxedTriangle box(element, {centre, centre, centre});
    box.lower.array() -= radius;
    box.upper.array() += radius;
    return box;
  }

  // Boxes that are far apart cannot meet at the greatest speed of any two points.
  void OfferBoxes(const Candidate& pair, const BoxedTriangle& a, const BoxedTriangle& b) {
    work_.Spend(kBoxPairUnits);
    const Reach reach = ReachOf(0, a_.turning_reach(), b_.turning_reach());
    const double time =
        numeric::FirstRoot(BoxDistance(a, b) - reach.c0, fastest_ + reach.c1, reach.c2);
    if (time > duration_ || !seen_.insert(std::uint64_t{a.index} << 32 | b.index).second) return;
    Push({std::max(pair.time, time), Kind::kTriangles, 0, a.index, b.index, pair.a, pair.b});
  }

  // What may be used up of a gap between points of A at most `far_a` from its reference point, and
  // of B likewise.
  Reach ReachOf(double radii, double far_a, double far_b) const {
    const auto& u = swept_.translation;
    const auto& ta = swept_.turning_A;
    const auto& tb = swept_.turning_B;
    return {radii + slack_ + u.c0 + ta.c0 * far_a + tb.c0 * far_b,
            slack_growth_ + swept_.velocity_error + u.c1 + ta.c1 * far_a + tb.c1 * far_b,
            std::max(0.0, u.c2 + ta.c2 * far_a + tb.c2 * far_b)};
  }

  Eigen::Vector3d VelocityOfA(const Eigen::Vector3d& x) const { return swept_.spin_A.cross(x); }
  Eigen::Vector3d VelocityOfB(const Eigen::Vector3d& y) const {
    return swept_.velocity + swept_.spin_B.cross(y - swept_.pose.p_AB);
  }

  // `parent`: before, not even the parents touch.
  void Offer(NodePair nodes, double parent) {
    work_.Spend(1);
    const sphere_tree::SphereNode& a = a_.node(nodes.a);
    const sphere_tree::SphereNode& b = b_.node(nodes.b);
    const Eigen::Vector3d c_b = swept_.pose.ToA(b.centre);
    const Reach reach = ReachOf(a.radius + b.radius, a.centre.norm(), b.centre.norm());
    const double time =
        SweptBallsTouch({c_b - a.centre, VelocityOfB(c_b) - VelocityOfA(a.centre), reach},
                        duration_, detail_.step_worth);
    // Balls within the solids that overlap already: nothing is free, and nothing need be opened.
    const bool within =
        !(time > 0) && (c_b - a.centre).norm() + a.signed_distance + b.signed_distance < 0;
    const Kind kind = within ? Kind::kResolved : Kind::kNodes;
    const double later = within || time > until_ ? time : std::max(time, WideLeafTouch(a, b, c_b));
    Push({std::max(parent, later), kind, 0, nodes.a, nodes.b, 0, 0, a.radius + b.radius});
  }

  // The ball about a leaf of large triangles holds much else: beside a small ball they are asked
  // themselves. 0: nothing is known.
  double WideLeafTouch(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b,
                       const Eigen::Vector3d& c_b) {
    const bool of_a = a.children == 0 && a.radius > kWideLeaf * b.radius;
    if (!of_a && !(b.children == 0 && b.radius > kWideLeaf * a.radius)) return 0;
    const shape::Shape* shape = (of_a ? a_ : b_).shape();
    double least = numeric::kInfinity;
    if (shape == nullptr) return 0;
    for (const std::uint32_t t : shape->tree().TrianglesOf(of_a ? a : b)) {
      if (shape->IsSolid(t) || !(least > 0) || work_.exhausted()) return 0;
      work_.Spend(kTrianglePairUnits / 2);
      const double further =
          of_a ? BallFurther(CornersOf(*shape, t), c_b, b.radius, 0)
               : BallFurther(a.centre, a.radius, CornersOf(*shape, t, swept_.pose), 0);
      least = std::min(least, further);
    }
    return least;
  }

  double FarOfB(const geometry::TrianglePoints& corners) const {
    double far = 0;
    for (const auto& y : corners) far = std::max(far, (y - swept_.pose.p_AB).norm());
    return far;
  }

  static double FarOfA(const geometry::TrianglePoints& corners) {
    return std::max({corners[0].norm(), corners[1].norm(), corners[2].norm()});
  }

  // Convex sets of points, each of which moves along its tangent.
  template <std::size_t kPoints>
  struct Moving {
    std::array<Eigen::Vector3d, kPoints> points, velocities;

    std::array<Eigen::Vector3d, kPoints> At(double h) const {
      std::array<Eigen::Vector3d, kPoints> at;
      for (std::size_t i = 0; i < kPoints; ++i) at[i] = points[i] + h * velocities[i];
      return at;
    }
  };

  template <std::size_t kPoints>
  Moving<kPoints> OfA(const std::array<Eigen::Vector3d, kPoints>& points) const {
    Moving<kPoints> moving{points, {}};
    for (std::size_t i = 0; i < kPoints; ++i) moving.velocities[i] = VelocityOfA(points[i]);
    return moving;
  }

  template <std::size_t kPoints>
  Moving<kPoints> OfB(const std::array<Eigen::Vector3d, kPoints>& points) const {
    Moving<kPoints> moving{points, {}};
    for (std::size_t i = 0; i < kPoints; ++i) moving.velocities[i] = VelocityOfB(points[i]);
    return moving;
  }

  // Points along a direction, and how fast they move along it.
  template <std::size_t kPoints>
  struct Projected {
    std::array<double, kPoints> at, speed;
    double low = numeric::kInfinity, high = -numeric::kInfinity, slowest = numeric::kInfinity,
           fastest = -numeric::kInfinity;

    Projected(const Moving<kPoints>& moving, const Eigen::Vector3d& n, double h) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        speed[i] = n.dot(moving.velocities[i]);
        at[i] = n.dot(moving.points[i]) + h * speed[i];
        low = std::min(low, at[i]);
        high = std::max(high, at[i]);
        slowest = std::min(slowest, speed[i]);
        fastest = std::max(fastest, speed[i]);
      }
    }
  };

  // Along a direction the gap is at least that of the points' projections: how much longer than h
  // does it last? At least as long as between the foremost points if they moved as fast as any; and
  // as long as between every two points, since the projections do not meet before any two of them
  // do.
  template <std::size_t kA, std::size_t kB>
  double Further(const Eigen::Vector3d& direction, const Moving<kA>& a, const Moving<kB>& b,
                 const Reach& reach, double h) const {
    const double square = direction.squaredNorm();
    if (!(square > kSquareMin && square < kSquareMax)) return 0;
    const Eigen::Vector3d n = direction / std::sqrt(square);
    const Projected<kA> of_a(a, n, h);
    const Projected<kB> of_b(b, n, h);
    const double used = reach.c0 + h * (reach.c1 + h * reach.c2);
    const double growth = reach.c1 + 2 * h * reach.c2;
    const double whole = numeric::FirstRoot(of_b.low - of_a.high - used,
                                            of_a.fastest - of_b.slowest + growth, reach.c2);
    if (!(whole > 0) || h + whole > duration_) return whole;
    double least = numeric::kInfinity;
    for (std::size_t i = 0; i < kA; ++i) {
      for (std::size_t j = 0; j < kB; ++j) {
        least =
            std::min(least, numeric::FirstRoot(of_b.at[j] - of_a.at[i] - used,
                                               of_a.speed[i] - of_b.speed[j] + growth, reach.c2));
      }
    }
    return std::max(whole, least);
  }

  // One tangent step, as in SweptBallsTouch(): from where the pair is known to be apart up to.
  void Step(Candidate pair) {
    work_.Spend(kTrianglePairUnits);
    const double further = FurtherApart(pair.a, pair.b, pair.time);
    pair.time += further;
    if (++pair.steps == kTriangleSteps || further < detail_.step_worth * duration_) {
      pair.kind = Kind::kResolved;
    }
    Push(pair);
  }

  // A ball's points move with its centre.
  MovingSet MovingA(std::uint32_t element) const {
    const Eigen::Vector3d spin = a_.shape() ? swept_.spin_A : Eigen::Vector3d::Zero();
    return {SetOf(a_, element), {Eigen::Vector3d::Zero(), spin, Eigen::Vector3d::Zero()}};
  }

  // What is not known of its turning counts with the growth.
  MovingSet MovingB(std::uint32_t element) const {
    RelativePose pose = swept_.pose;
    pose.chord_B = 0;
    const Eigen::Vector3d spin = b_.shape() ? swept_.spin_B : Eigen::Vector3d::Zero();
    return {PosedB(SetOf(b_, element), pose), {swept_.velocity, spin, pose.p_AB}};
  }

  static double FarOf(const BodyTree& surface, std::uint32_t element) {
    if (surface.shape() == nullptr) return 0;
    if (surface.shape()->IsSolid(element)) return surface.shape()->SolidAt(element).facts().radius;
    return FarOfA(CornersOf(*surface.shape(), element));
  }

  double SolidsFurther(std::uint32_t of_a, std::uint32_t of_b, double h) {
    const Reach used = ReachOf(0, FarOf(a_, of_a), FarOf(b_, of_b));
    return ApartFor({MovingA(of_a), MovingB(of_b), used}, h, duration_, &work_);
  }

  // A ball of A about x beside a triangle of B, and a triangle of A beside a ball of B.
  double BallFurther(const Eigen::Vector3d& x, double radius,
                     const geometry::TrianglePoints& corners, double h) const {
    const auto ball = OfA(std::array{x});
    const auto b = OfB(corners);
    const Eigen::Vector3d way = geometry::DistanceOf(ball.At(h)[0], b.At(h)).b - ball.At(h)[0];
    return Further(way, ball, b, ReachOf(radius, x.norm(), FarOfB(corners)), h);
  }
  double BallFurther(const geometry::TrianglePoints& corners, const Eigen::Vector3d& x,
                     double radius, double h) const {
    const auto a = OfA(corners);
    const auto ball = OfB(std::array{x});
    const Eigen::Vector3d way = ball.At(h)[0] - geometry::DistanceOf(ball.At(h)[0], a.At(h)).b;
    const double far_b = (x - swept_.pose.p_AB).norm();
    return Further(way, a, ball, ReachOf(radius, FarOfA(corners), far_b), h);
  }

  double FurtherApart(std::uint32_t of_a, std::uint32_t of_b, double h) {
    if (AnySolid(a_, of_a, b_, of_b)) return SolidsFurther(of_a, of_b, h);
    if (!a_.shape()) {
      const geometry::TrianglePoints corners = CornersOf(*b_.shape(), of_b, swept_.pose);
      return BallFurther(Eigen::Vector3d(0, 0, 0), a_.reach(), corners, h);
    }
    const geometry::TrianglePoints corners_a = CornersOf(*a_.shape(), of_a);
    if (!b_.shape()) return BallFurther(corners_a, swept_.pose.p_AB, b_.reach(), h);
    const auto a = OfA(corners_a);
    const geometry::TrianglePoints corners_b = CornersOf(*b_.shape(), of_b, swept_.pose);
    const auto b = OfB(corners_b);
    const Reach reach = ReachOf(0, FarOfA(corners_a), FarOfB(corners_b));
    const geometry::TrianglePoints at_a = a.At(h), at_b = b.At(h);
    const geometry::TriangleDistance found = geometry::DistanceOf(at_a, at_b);
    const Eigen::Vector3d d = found.b - found.a;
    double furthest = Further(d, a, b, reach, h);
    const double size = (at_a[1] - at_a[0]).cwiseAbs().sum() + (at_b[1] - at_b[0]).cwiseAbs().sum();
    if (d.squaredNorm() > kShortWay * kShortWay * size * size) return furthest;
    // Every direction is right; of features that nearly touch these tell it exactly.
    work_.Spend(kTrianglePairUnits);
    geometry::ForEachFeatureDirection(at_a, at_b, [&](const Eigen::Vector3d& n) {
      furthest = std::max({furthest, Further(n, a, b, reach, h), Further(-n, a, b, reach, h)});
    });
    return furthest;
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const SweptPose& swept_;
  const double duration_;
  const SweepDetail detail_;
  double until_;  // what comes later matters nothing
  WorkBudget& work_;
  double slack_, slack_growth_;  // of rounding: at once, and a second later
  double fastest_;               // any two points, relative to each other
  std::vector<Candidate> heap_;
  std::unordered_set<std::uint64_t> seen_;
  std::vector<BoxedTriangle> boxes_of_b_;
};

}  // namespace

ImpactBound LowerBoundOfImpact(const SweptPair& pair, double duration, WorkBudget* work,
                               const SweepDetail& detail) {
  return Search(pair, duration, work, detail).Run();
}

}  // namespace collision::narrow_phase
