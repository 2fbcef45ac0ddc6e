#include "collision_core/narrow_phase/swept_pair.h"

#include <algorithm>

#include "collision_core/narrow_phase/boxed_triangle.h"

namespace collision {
namespace {

// Tangent steps for one pair of balls; each goes on from where the last one ended.
constexpr int kTangentSteps = 4;

// Steps shorter than this share of the duration are not worth another.
constexpr double kStepWorth = 1e-3;

// A root computed in a dozen roundings of 2^-53 each, none of them after a cancellation.
constexpr double kRootShare = 1 - 0x1p-40;

// A lower bound on the least x >= 0 with gap − closing x − growth x² <= 0; growth >= 0.
double RootOf(double gap, double closing, double growth) {
  if (!(gap > 0)) return 0;
  const double root = std::sqrt(closing * closing + 4 * growth * gap);
  if (closing >= 0) {
    const double sum = closing + root;
    return sum > 0 ? kRootShare * (2 * gap / sum) : kInfinity;
  }
  return growth > 0 ? kRootShare * ((root - closing) / (2 * growth)) : kInfinity;
}

struct Reach {
  double c0, c1, c2;
};

// Up to when |d + w h| > reach(h): at each h the distance is at least its part along the direction
// at h, so that steps of that tangent never go too far.
double BallsTouch(const Eigen::Vector3d& d, const Eigen::Vector3d& w, const Reach& reach,
                  double duration) {
  double h = 0;
  for (int step = 0; step < kTangentSteps; ++step) {
    const Eigen::Vector3d between = d + h * w;
    const double distance = between.norm();
    const double gap = distance - (reach.c0 + h * (reach.c1 + h * reach.c2));
    if (!(gap > 0)) return h;
    const double closing = reach.c1 + 2 * h * reach.c2 - between.dot(w) / distance;
    const double further = RootOf(gap, closing, reach.c2);
    h += further;
    if (h > duration) return kInfinity;
    if (further < kStepWorth * duration) break;
  }
  return h;
}

class Search {
 public:
  Search(const Surface& a, const Surface& b, const SweptPose& swept, double duration, Work* work)
      : a_(a), b_(b), swept_(swept), duration_(duration), work_(*work) {
    const RelativePose& pose = swept.pose;
    // All positions within the duration are sums of a few of these; compare RoundingOf() in
    // separation.cc.
    const double extent = a.reach() + b.reach() + pose.offset.cwiseAbs().sum() +
                          duration * (swept.velocity.cwiseAbs().sum() +
                                      a.turning_reach() * swept.spin_A.cwiseAbs().sum() +
                                      b.turning_reach() * swept.spin_B.cwiseAbs().sum());
    slack_ = AddUp(MultiplyUp(0x1p-48, extent),
                   AddUp(pose.offset_error, MultiplyUp(pose.matrix_error, b.reach())));
  }

  FirstTouch Run() {
    FirstTouch found;
    Offer(0, 0, 0);
    while (!heap_.empty()) {
      const Candidate front = heap_.front();
      found.seconds = front.time;
      if (front.resolved) {
        found.resolved = true;
        found.leaf_A = front.a;
        found.leaf_B = front.b;
        return found;
      }
      if (work_.exhausted()) {
        found.exhausted = true;
        return found;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      Open(front);
    }
    found.seconds = kInfinity;
    return found;
  }

 private:
  struct Candidate {
    double time;
    std::uint32_t a, b;
    bool resolved;

    // A heap's front is the greatest: the earliest, of equals the first nodes.
    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.time != y.time) return x.time > y.time;
      if (x.a != y.a) return x.a > y.a;
      return x.b > y.b;
    }
  };

  void Push(const Candidate& candidate) {
    if (candidate.time > duration_) return;
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  void Open(const Candidate& pair) {
    const SphereNode& a = a_.node(pair.a);
    const SphereNode& b = b_.node(pair.b);
    if (a.children == 0 && b.children == 0) {
      Push({std::max(pair.time, LeavesTouch(a, b)), pair.a, pair.b, true});
    } else if (b.children == 0 || (a.children > 0 && a.radius >= b.radius)) {
      for (std::uint32_t i = 0; i < a.children; ++i) Offer(a.first_child + i, pair.b, pair.time);
    } else {
      for (std::uint32_t i = 0; i < b.children; ++i) Offer(pair.a, b.first_child + i, pair.time);
    }
  }

  // What may be used up of a gap between points of A at most `far_a` from its reference point, and
  // of B likewise.
  Reach ReachOf(double radii, double far_a, double far_b) const {
    const auto& u = swept_.translation;
    const auto& ta = swept_.turning_A;
    const auto& tb = swept_.turning_B;
    return {radii + slack_ + u.c0 + ta.c0 * far_a + tb.c0 * far_b,
            swept_.velocity_error + u.c1 + ta.c1 * far_a + tb.c1 * far_b,
            std::max(0.0, u.c2 + ta.c2 * far_a + tb.c2 * far_b)};
  }

  Eigen::Vector3d VelocityOfA(const Eigen::Vector3d& x) const { return swept_.spin_A.cross(x); }
  Eigen::Vector3d VelocityOfB(const Eigen::Vector3d& y) const {
    return swept_.velocity + swept_.spin_B.cross(y - swept_.pose.offset);
  }

  // `parent`: before, not even the parents touch.
  void Offer(std::uint32_t index_a, std::uint32_t index_b, double parent) {
    work_.Spend(1);
    const SphereNode& a = a_.node(index_a);
    const SphereNode& b = b_.node(index_b);
    const Eigen::Vector3d c_b = swept_.pose.ToA(b.centre);
    const Reach reach = ReachOf(a.radius + b.radius, a.centre.norm(), b.centre.norm());
    const double time =
        BallsTouch(c_b - a.centre, VelocityOfB(c_b) - VelocityOfA(a.centre), reach, duration_);
    Push({std::max(parent, time), index_a, index_b, false});
  }

  double LeavesTouch(const SphereNode& a, const SphereNode& b) {
    double time = kInfinity;
    if (a_.shape() && b_.shape()) {
      corners_of_b_.clear();
      for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
        corners_of_b_.emplace_back(t, CornersOf(*b_.shape(), t, swept_.pose));
      }
      for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
        const BoxedTriangle of_a(t, CornersOf(*a_.shape(), t));
        for (const BoxedTriangle& of_b : corners_of_b_) {
          time = std::min(time, TrianglesTouch(of_a, of_b));
        }
      }
    } else if (a_.shape()) {
      for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
        const TrianglePoints corners = CornersOf(*a_.shape(), t);
        time = std::min(time, BallTouches(swept_.pose.offset, b.radius, corners, false));
      }
    } else {
      for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
        const TrianglePoints corners = CornersOf(*b_.shape(), t, swept_.pose);
        time = std::min(time, BallTouches({0, 0, 0}, a.radius, corners, true));
      }
    }
    return time;
  }

  double FarOfB(const TrianglePoints& corners) const {
    double far = 0;
    for (const auto& y : corners) far = std::max(far, (y - swept_.pose.offset).norm());
    return far;
  }

  static double FarOfA(const TrianglePoints& corners) {
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

  // Along a direction the gap is at least that of the points' projections: how much longer than h
  // does it last?
  template <std::size_t kA, std::size_t kB>
  static double Further(const Eigen::Vector3d& direction, const Moving<kA>& a, const Moving<kB>& b,
                        const Reach& reach, double h) {
    const double length = direction.norm();
    if (!(length > 0)) return 0;
    const Eigen::Vector3d n = direction / length;
    double front_a = -kInfinity, fastest_a = -kInfinity;
    for (std::size_t i = 0; i < kA; ++i) {
      const double speed = n.dot(a.velocities[i]);
      front_a = std::max(front_a, n.dot(a.points[i]) + h * speed);
      fastest_a = std::max(fastest_a, speed);
    }
    double front_b = kInfinity, fastest_b = kInfinity;
    for (std::size_t i = 0; i < kB; ++i) {
      const double speed = n.dot(b.velocities[i]);
      front_b = std::min(front_b, n.dot(b.points[i]) + h * speed);
      fastest_b = std::min(fastest_b, speed);
    }
    const double used = reach.c0 + h * (reach.c1 + h * reach.c2);
    return RootOf(front_b - front_a - used, fastest_a - fastest_b + reach.c1 + 2 * h * reach.c2,
                  reach.c2);
  }

  // As BallsTouch(), with the directions in which `nearest` finds them apart.
  template <std::size_t kA, std::size_t kB, typename Nearest>
  double ConvexTouch(const Moving<kA>& a, const Moving<kB>& b, const Reach& reach,
                     Nearest nearest) {
    double h = 0;
    for (int step = 0; step < kTangentSteps; ++step) {
      work_.Spend(kTrianglePairUnits);
      const double further = Further(nearest(a.At(h), b.At(h)), a, b, reach, h);
      h += further;
      if (h > duration_) return kInfinity;
      if (further < kStepWorth * duration_) break;
    }
    return h;
  }

  double TrianglesTouch(const BoxedTriangle& a, const BoxedTriangle& b) {
    work_.Spend(kBoxPairUnits);
    const double far_a = FarOfA(a.corners), far_b = FarOfB(b.corners);
    const Reach reach = ReachOf(0, far_a, far_b);
    const double fastest = swept_.velocity.norm() + swept_.spin_A.norm() * far_a +
                           swept_.spin_B.norm() * far_b + reach.c1;
    if (RootOf(BoxDistance(a, b) - reach.c0, fastest, reach.c2) > duration_) return kInfinity;
    return ConvexTouch(OfA(a.corners), OfB(b.corners), reach,
                       [](const TrianglePoints& x, const TrianglePoints& y) {
                         const TriangleDistance found = DistanceOf(x, y);
                         return Eigen::Vector3d(found.b - found.a);
                       });
  }

  double BallTouches(const Eigen::Vector3d& centre, double radius, const TrianglePoints& corners,
                     bool ball_is_a) {
    using Point = std::array<Eigen::Vector3d, 1>;
    const auto to_triangle = [](const Point& point, const TrianglePoints& triangle) {
      return Eigen::Vector3d(DistanceOf(point[0], triangle).b - point[0]);
    };
    if (ball_is_a) {
      return ConvexTouch(OfA(Point{centre}), OfB(corners), ReachOf(radius, 0, FarOfB(corners)),
                         to_triangle);
    }
    return ConvexTouch(OfA(corners), OfB(Point{centre}), ReachOf(radius, FarOfA(corners), 0),
                       [&](const TrianglePoints& triangle, const Point& point) {
                         return Eigen::Vector3d(-to_triangle(point, triangle));
                       });
  }

  const Surface& a_;
  const Surface& b_;
  const SweptPose& swept_;
  const double duration_;
  Work& work_;
  double slack_;
  std::vector<Candidate> heap_;
  std::vector<BoxedTriangle> corners_of_b_;
};

}  // namespace

FirstTouch TouchOf(const Surface& a, const Surface& b, const SweptPose& swept, double duration,
                   Work* work) {
  return Search(a, b, swept, duration, work).Run();
}

}  // namespace collision
