#include "collision_core/narrow_phase/separation.h"

#include <algorithm>
#include <optional>

#include "collision_core/narrow_phase/boxed_triangle.h"

namespace collision {
namespace {

// Ways between surfaces that are kept; with more of them the direction is not told.
constexpr std::size_t kWaysMax = 128;

// A step of the search through time loses at most half of the distance when the bracket is this
// narrow.
constexpr double kEnoughOfUpper = 0.5;

// A distance computed in doubles from points of these lengths, and the sums and differences made of
// it (less than a dozen operations on terms below the lengths' sum): 2^-49 of the sum covers it.
double RoundingOf(const Surface& a, const Surface& b, const RelativePose& pose) {
  const double offset = pose.offset.cwiseAbs().sum();
  return MultiplyUp(0x1p-49, a.reach() + b.reach() + offset);
}

// What rounding may have made of a distance at this pose.
double SlackOf(const Surface& a, const Surface& b, const RelativePose& pose) {
  return AddUp(RoundingOf(a, b, pose),
               AddUp(pose.offset_error, MultiplyUp(pose.matrix_error, b.reach())));
}

double Greatest(const TrianglePoints& t) {
  return std::sqrt(std::max({t[0].squaredNorm(), t[1].squaredNorm(), t[2].squaredNorm()}));
}

class Traversal {
 public:
  Traversal(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal, Work* work)
      : a_(a), b_(b), pose_(pose), goal_(goal), work_(*work), slack_(SlackOf(a, b, pose)) {}

  Look Run(const Evidence& hint) {
    if (hint.kind == Evidence::Kind::kLeaves) Resolve({-kInfinity, hint.a, hint.b, false});
    heap_.clear();  // the leaves are met again in their turn
    Offer(0, 0, -kInfinity);
    while (!heap_.empty() && !Decided(heap_.front())) {
      if (work_.exhausted()) {
        look_.exhausted = true;
        break;
      }
      Open(Pop());
      if (margin_until_ == kNotTouching && Touching()) margin_until_ = work_.spent() + kMarginUnits;
    }
    const double unopened = heap_.empty() ? kInfinity : heap_.front().lower;
    look_.lower = std::min(resolved_lower_, unopened);
    if (look_.point_error == kInfinity) PointBetween();
    KeepShortest();
    return std::move(look_);
  }

  Look RunUntil(double width, double share) {
    narrow_ = Narrow{width, share};
    return Run({});
  }

  /// Nothing but this evidence of contact.
  Look RunAgain(const Evidence& evidence) {
    LookAgainAt(evidence);
    look_.lower = -kInfinity;
    return std::move(look_);
  }

 private:
  struct Narrow {
    double width, share;
  };

  struct Candidate {
    double lower;
    std::uint32_t a, b;
    bool resolved;

    // A heap's front is the greatest: the least lower bound, of equals the first nodes.
    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.lower != y.lower) return x.lower > y.lower;
      if (x.a != y.a) return x.a > y.a;
      return x.b > y.b;
    }
  };

  // A resolved pair at the front says that nothing is nearer. Where it may be touching, others may
  // still be certain to cross.
  bool Decided(const Candidate& front) const {
    const double lower = std::min(front.lower, resolved_lower_);
    if (narrow_) {
      return Touching() || look_.upper - lower <= std::max(narrow_->width, narrow_->share * lower);
    }
    if (goal_ == Goal::kYesNo) return Touching() || lower > pose_.translation;
    if (goal_ == Goal::kNearest) {
      if (look_.upper <= 0 || look_.ways.size() > kWaysMax) return true;
      return lower > 0 && front.lower > look_.upper + 2 * pose_.translation;
    }
    if (Touching()) {
      return goal_ == Goal::kDecision || front.lower > 0 || work_.spent() > margin_until_;
    }
    if (front.resolved && lower > 0) return true;
    return lower > pose_.translation && lower >= kEnoughOfUpper * look_.upper;
  }

  bool Touching() const {
    return look_.upper <= -pose_.translation || look_.crossing_margin >= pose_.translation / 2;
  }

  Candidate Pop() {
    std::pop_heap(heap_.begin(), heap_.end());
    const Candidate popped = heap_.back();
    heap_.pop_back();
    return popped;
  }

  void Push(const Candidate& candidate) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  void Open(const Candidate& pair) {
    const SphereNode& a = a_.node(pair.a);
    const SphereNode& b = b_.node(pair.b);
    look_.level = std::max({look_.level, a.level, b.level});
    if (pair.resolved) {
      resolved_lower_ = std::min(resolved_lower_, pair.lower);
    } else if (a.children == 0 && b.children == 0) {
      Resolve(pair);
    } else if (b.children == 0 || (a.children > 0 && a.radius >= b.radius)) {
      for (std::uint32_t i = 0; i < a.children; ++i) Offer(a.first_child + i, pair.b, pair.lower);
    } else {
      for (std::uint32_t i = 0; i < b.children; ++i) Offer(pair.a, b.first_child + i, pair.lower);
    }
  }

  // A pair of spheres. `parent`: its lower bound holds for its children.
  void Offer(std::uint32_t index_a, std::uint32_t index_b, double parent) {
    work_.Spend(1);
    const SphereNode& a = a_.node(index_a);
    const SphereNode& b = b_.node(index_b);
    const Eigen::Vector3d c_b = pose_.ToA(b.centre);
    const double distance = (c_b - a.centre).norm();
    double slack = slack_;
    if (pose_.chord_A > 0) slack += pose_.chord_A * a.centre.norm();
    if (pose_.chord_B > 0) slack += pose_.chord_B * b.centre.norm();
    const double upper = distance + a.signed_distance + b.signed_distance + slack;
    if (upper < look_.upper) {
      look_.upper = upper;
      if (upper <= -pose_.translation) {
        CommonPoint(a, b, c_b, distance, slack);
        look_.evidence = {Evidence::Kind::kNodes, index_a, index_b};
      }
    }
    const double lower = std::max(parent, distance - a.radius - b.radius - slack);
    // Something else is nearer for certain: this pair need never be opened.
    if (lower > look_.upper + 2 * pose_.translation && lower > 0) {
      resolved_lower_ = std::min(resolved_lower_, lower);
      return;
    }
    Push({lower, index_a, index_b, false});
  }

  void LookAgainAt(const Evidence& evidence) {
    const bool meshes = a_.shape() && b_.shape();
    switch (evidence.kind) {
      case Evidence::Kind::kNone:
        return;
      case Evidence::Kind::kNodes:
        return Offer(evidence.a, evidence.b, -kInfinity);
      case Evidence::Kind::kTriangles:
        if (meshes) return CrossAgain(evidence.a, evidence.b);
        BallAndTriangle(evidence.a);
        return;
      case Evidence::Kind::kLeaves:
        if (!meshes) return Resolve({0, evidence.a, evidence.b, false});
        for (const std::uint32_t a : a_.shape()->tree().TrianglesOf(a_.node(evidence.a))) {
          for (const std::uint32_t b : b_.shape()->tree().TrianglesOf(b_.node(evidence.b))) {
            CrossAgain(a, b);
          }
        }
    }
  }

  void CrossAgain(std::uint32_t a, std::uint32_t b) {
    work_.Spend(kCrossingUnits);
    Cross({a, CornersOfA(a)}, {b, CornersOfB(b)});
  }

  // Where a ball inside a solid, or the surface near a centre, overlaps the other one's.
  void CommonPoint(const SphereNode& a, const SphereNode& b, const Eigen::Vector3d& c_b,
                   double distance, double slack) {
    const double s_a = a.signed_distance, s_b = b.signed_distance;
    const double error = std::max({0.0, s_a, s_b}) + slack;
    if (s_a >= 0) {
      KeepPoint(a.centre, error);
    } else if (s_b >= 0 || distance == 0) {
      KeepPoint(c_b, error);
    } else {
      const double from = std::max(0.0, distance + s_b), to = std::min(distance, -s_a);
      KeepPoint(a.centre + (c_b - a.centre) * ((from + to) / (2 * distance)), error);
    }
  }

  void KeepPoint(const Eigen::Vector3d& point, double error) {
    if (!(error < look_.point_error)) return;
    look_.point = point;
    look_.point_error = error;
  }

  TrianglePoints CornersOfA(std::uint32_t triangle) const {
    return CornersOf(*a_.shape(), triangle);
  }

  TrianglePoints CornersOfB(std::uint32_t triangle) const {
    return CornersOf(*b_.shape(), triangle, pose_);
  }

  // How far the corners of a triangle of B move by its turning: they are |x − offset| from its
  // reference point.
  double TurnOfB(const TrianglePoints& t) const {
    if (pose_.chord_B == 0) return 0;
    const TrianglePoints own = {t[0] - pose_.offset, t[1] - pose_.offset, t[2] - pose_.offset};
    return pose_.chord_B * Greatest(own);
  }

  double TurnOfA(const TrianglePoints& t) const {
    return pose_.chord_A == 0 ? 0 : pose_.chord_A * Greatest(t);
  }

  // Two leaves: by their triangles, and by the ball where one is a ball.
  void Resolve(const Candidate& pair) {
    const SphereNode& a = a_.node(pair.a);
    const SphereNode& b = b_.node(pair.b);
    double lower = kInfinity;
    if (a_.shape() && b_.shape()) {
      lower = ResolveTriangles(a, b);
    } else {
      const SphereNode& meshed = a_.shape() ? a : b;
      for (const std::uint32_t t : MeshOf().tree().TrianglesOf(meshed)) {
        lower = std::min(lower, BallAndTriangle(t));
      }
    }
    Push({std::max(pair.lower, lower), pair.a, pair.b, true});
  }

  // Where one of the two is a ball: the shape of the other.
  const Shape& MeshOf() const { return a_.shape() ? *a_.shape() : *b_.shape(); }

  double BallAndTriangle(std::uint32_t t) {
    if (a_.shape()) {
      const TrianglePoints corners = CornersOfA(t);
      const TriangleDistance found = DistanceOf(pose_.offset, corners);
      return Count(t, found.b, found.a, found.distance, b_.reach(), false,
                   slack_ + TurnOfA(corners));
    }
    const TrianglePoints corners = CornersOfB(t);
    const TriangleDistance found = DistanceOf(Eigen::Vector3d(0, 0, 0), corners);
    return Count(t, found.a, found.b, found.distance, a_.reach(), true, slack_ + TurnOfB(corners));
  }

  // A ball and a triangle: the ball is A's (`ball_is_a`) or B's. Returns the lower bound.
  double Count(std::uint32_t triangle, const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b,
               Interval distance, double radius, bool ball_is_a, double slack) {
    work_.Spend(kTrianglePairUnits / 2);
    Eigen::Vector3d a = on_a, b = on_b;
    const double length = (b - a).norm();
    if (length > 0) {
      const double share = std::min(1.0, radius / length);
      if (ball_is_a) {
        a += share * (on_b - on_a);
      } else {
        b -= share * (on_b - on_a);
      }
    }
    const double lower = distance.lower - radius - slack, upper = distance.upper - radius + slack;
    if (upper <= -pose_.translation && upper < look_.upper) {
      KeepPoint(ball_is_a ? on_b : on_a, slack);  // of the surface, within the ball
      look_.evidence = {Evidence::Kind::kTriangles, triangle, triangle};
    }
    KeepWay({a, b, lower, upper});
    return lower;
  }

  double ResolveTriangles(const SphereNode& a, const SphereNode& b) {
    double lower = kInfinity;
    std::vector<BoxedTriangle> triangles_of_b;
    triangles_of_b.reserve(b.triangles);
    for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
      triangles_of_b.emplace_back(t, CornersOfB(t));
    }
    for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
      const BoxedTriangle of_a(t, CornersOfA(t));
      for (const BoxedTriangle& of_b : triangles_of_b) lower = std::min(lower, Pair(of_a, of_b));
    }
    return lower;
  }

  // Is a pair that is at least so far apart looked at closely enough?
  bool FarEnough(double lower) const {
    if (narrow_ || goal_ == Goal::kNearest) return lower > look_.upper + 2 * pose_.translation;
    if (goal_ == Goal::kYesNo) return lower > pose_.translation;
    return lower > pose_.translation && lower >= kEnoughOfUpper * look_.upper;
  }

  double Pair(const BoxedTriangle& a, const BoxedTriangle& b) {
    const double turn_A = TurnOfA(a.corners), turn_B = TurnOfB(b.corners);
    const double slack = slack_ + turn_A + turn_B;
    work_.Spend(kBoxPairUnits);
    const double boxes = BoxDistance(a, b) - slack;
    if (FarEnough(boxes)) return boxes;
    work_.Spend(kTrianglePairUnits);
    const TriangleDistance found = DistanceOf(a.corners, b.corners);
    if (found.distance.lower <= 0) Cross(a, b);
    const double lower = found.distance.lower - slack;
    KeepWay({found.a, found.b, lower, found.distance.upper + slack});
    return lower;
  }

  void Cross(const BoxedTriangle& a, const BoxedTriangle& b) {
    const double turning = slack_ + std::max(TurnOfA(a.corners), TurnOfB(b.corners));
    const double margin = CrossingMargin(a.corners, b.corners) - turning;
    if (!(margin > look_.crossing_margin)) return;
    if (margin >= pose_.translation / 2) {
      const std::optional<Crossing> crossing =
          CertainCrossing(a.corners, b.corners, turning + pose_.translation / 2);
      if (!crossing) return;  // the margin was a matter of rounding
      KeepPoint(crossing->point, crossing->error);
      look_.upper = std::min(look_.upper, -pose_.translation);
      look_.evidence = {Evidence::Kind::kTriangles, a.index, b.index};
    }
    look_.crossing_margin = margin;
  }

  void KeepWay(const NearestWay& way) {
    look_.upper = std::min(look_.upper, way.upper);
    const double reach = look_.upper + 2 * pose_.translation;
    if (way.lower > reach) return;
    if (goal_ == Goal::kNearest) {
      // A triangle may stand in several leaves.
      const bool known = std::any_of(look_.ways.begin(), look_.ways.end(), [&](const auto& other) {
        return other.a == way.a && other.b == way.b && other.upper == way.upper;
      });
      if (known) return;
      look_.ways.push_back(way);
      if (look_.ways.size() > kWaysMax) DropLonger();
    } else if (look_.ways.empty() || way.upper < look_.ways.front().upper) {
      look_.ways.assign(1, way);
    }
  }

  void DropLonger() {
    const double reach = look_.upper + 2 * pose_.translation;
    std::erase_if(look_.ways, [reach](const NearestWay& way) { return way.lower > reach; });
  }

  // Of the ways kept, those that may still be the shortest.
  void KeepShortest() {
    DropLonger();
    if (goal_ != Goal::kNearest || look_.exhausted || look_.ways.size() > kWaysMax) {
      look_.ways.clear();
    }
  }

  void PointBetween() {
    if (look_.ways.empty()) return;
    const auto shortest =
        std::min_element(look_.ways.begin(), look_.ways.end(),
                         [](const auto& x, const auto& y) { return x.upper < y.upper; });
    look_.point = (shortest->a + shortest->b) / 2;
    look_.point_error = std::max(0.0, shortest->upper);
  }

  static constexpr std::uint64_t kNotTouching = ~std::uint64_t{0};

  const Surface& a_;
  const Surface& b_;
  const RelativePose& pose_;
  const Goal goal_;
  Work& work_;
  const double slack_;
  std::optional<Narrow> narrow_;
  std::uint64_t margin_until_ = kNotTouching;
  double resolved_lower_ = kInfinity;  // of the pairs that were looked at to the end
  std::vector<Candidate> heap_;
  Look look_;
};

enum class Side { kOutside, kInside, kUnknown };

Side SideOf(const Eigen::Vector3d& point, const Surface& of, Work* work) {
  if (of.shape() == nullptr || !of.shape()->closed())
    return Side::kOutside;  // a ball's node is solid
  const MeshFacts& facts = of.shape()->facts();
  const bool off =
      (point.array() > facts.upper.array()).any() || (point.array() < facts.lower.array()).any();
  if (off) return Side::kOutside;
  work->Spend(kWindingUnits);
  const std::optional<int> winding = of.shape()->WindingNumberAt(point);
  if (!winding) return Side::kUnknown;
  return *winding == 0 ? Side::kOutside : Side::kInside;
}

std::vector<Eigen::Vector3d> PointsOf(const Surface& surface) {
  if (surface.shape() == nullptr) return {Eigen::Vector3d(0, 0, 0)};
  return surface.shape()->component_points();
}

}  // namespace

Surface::Surface(const BodySegment& body)
    : shape_(body.shape.get()), reach_(body.shape ? body.shape->facts().radius : body.ball.radius) {
  ball_.radius = body.ball.radius;
  ball_.signed_distance = -body.ball.radius;
}

Look LookAt(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal, Work* work,
            const Evidence& hint) {
  return Traversal(a, b, pose, goal, work).Run(hint);
}

Look BracketAt(const Surface& a, const Surface& b, const RelativePose& pose, double width,
               double share, Work* work) {
  return Traversal(a, b, pose, Goal::kDecision, work).RunUntil(width, share);
}

Look LookAgain(const Surface& a, const Surface& b, const RelativePose& pose,
               const Evidence& evidence, Work* work) {
  return Traversal(a, b, pose, Goal::kDecision, work).RunAgain(evidence);
}

Nesting NestingOf(const Surface& a, const Surface& b, const RelativePose& pose, Work* work) {
  Nesting nesting;
  nesting.neither = true;
  const double turning = AddUp(MultiplyUp(pose.chord_A, a.turning_reach()),
                               MultiplyUp(pose.chord_B, b.turning_reach()));
  const double slack = AddUp(turning, SlackOf(a, b, pose));
  const auto judge = [&](Side side, const Eigen::Vector3d& point) {
    if (side != Side::kOutside) nesting.neither = false;
    if (side == Side::kInside) nesting.point = point, nesting.point_error = slack;
  };
  for (const Eigen::Vector3d& x_B : PointsOf(b)) {
    const Eigen::Vector3d x_A = pose.ToA(x_B);
    judge(SideOf(x_A, a, work), x_A);
    if (!nesting.neither) return nesting;
  }
  for (const Eigen::Vector3d& x_A : PointsOf(a)) {
    judge(SideOf(pose.ToB(x_A), b, work), x_A);
    if (!nesting.neither) return nesting;
  }
  return nesting;
}

}  // namespace collision
