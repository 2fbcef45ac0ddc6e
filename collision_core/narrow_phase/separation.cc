#include "collision_core/narrow_phase/separation.h"

#include <algorithm>
#include <optional>

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

// A triangle with its box.
struct BoxedTriangle {
  explicit BoxedTriangle(const TrianglePoints& points)
      : corners(points),
        lower(points[0].cwiseMin(points[1]).cwiseMin(points[2])),
        upper(points[0].cwiseMax(points[1]).cwiseMax(points[2])) {}

  TrianglePoints corners;
  Eigen::Vector3d lower, upper;
};

// At most the distance of the triangles, but for the rounding that the traversal allows for.
double BoxDistance(const BoxedTriangle& a, const BoxedTriangle& b) {
  const Eigen::Vector3d gap =
      (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(Eigen::Vector3d::Zero());
  return gap.norm();
}

double Greatest(const TrianglePoints& t) {
  return std::sqrt(std::max({t[0].squaredNorm(), t[1].squaredNorm(), t[2].squaredNorm()}));
}

class Traversal {
 public:
  Traversal(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal, Work* work)
      : a_(a), b_(b), pose_(pose), goal_(goal), work_(*work) {
    slack_ = AddUp(RoundingOf(a, b, pose),
                   AddUp(pose.offset_error, MultiplyUp(pose.matrix_error, b.reach())));
  }

  Look Run() {
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
    look_.resolved = resolved_lower_ <= unopened || heap_.front().resolved;
    if (look_.point_error == kInfinity) PointBetween();
    KeepShortest();
    return std::move(look_);
  }

 private:
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
      if (upper <= -pose_.translation) CommonPoint(a, b, c_b, distance, slack);
    }
    const double lower = std::max(parent, distance - a.radius - b.radius - slack);
    // Something else is nearer for certain: this pair need never be opened.
    if (lower > look_.upper + 2 * pose_.translation && lower > 0) {
      resolved_lower_ = std::min(resolved_lower_, lower);
      return;
    }
    Push({lower, index_a, index_b, false});
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
    const TriangleMesh& mesh = a_.shape()->mesh();
    const Triangle& t = mesh.triangles[triangle];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  }

  TrianglePoints CornersOfB(std::uint32_t triangle) const {
    const TriangleMesh& mesh = b_.shape()->mesh();
    const Triangle& t = mesh.triangles[triangle];
    return {pose_.ToA(mesh.vertices[t[0]]), pose_.ToA(mesh.vertices[t[1]]),
            pose_.ToA(mesh.vertices[t[2]])};
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
    } else if (a_.shape()) {
      for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
        const TrianglePoints corners = CornersOfA(t);
        const TriangleDistance found = DistanceOf(pose_.offset, corners);
        lower = std::min(lower, Count(found.b, found.a, found.distance, b.radius, false,
                                      slack_ + TurnOfA(corners)));
      }
    } else {
      for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
        const TrianglePoints corners = CornersOfB(t);
        const TriangleDistance found = DistanceOf(Eigen::Vector3d(0, 0, 0), corners);
        lower = std::min(lower, Count(found.a, found.b, found.distance, a.radius, true,
                                      slack_ + TurnOfB(corners)));
      }
    }
    Push({std::max(pair.lower, lower), pair.a, pair.b, true});
  }

  // A ball and a triangle: the ball is A's (`ball_is_a`) or B's. Returns the lower bound.
  double Count(const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b, Interval distance,
               double radius, bool ball_is_a, double slack) {
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
    }
    KeepWay({a, b, lower, upper});
    return lower;
  }

  double ResolveTriangles(const SphereNode& a, const SphereNode& b) {
    double lower = kInfinity;
    std::vector<BoxedTriangle> triangles_of_b;
    triangles_of_b.reserve(b.triangles);
    for (const std::uint32_t t : b_.shape()->tree().TrianglesOf(b)) {
      triangles_of_b.emplace_back(CornersOfB(t));
    }
    for (const std::uint32_t t : a_.shape()->tree().TrianglesOf(a)) {
      const BoxedTriangle of_a(CornersOfA(t));
      for (const BoxedTriangle& of_b : triangles_of_b) lower = std::min(lower, Pair(of_a, of_b));
    }
    return lower;
  }

  // Is a pair that is at least so far apart looked at closely enough?
  bool FarEnough(double lower) const {
    if (goal_ == Goal::kNearest) return lower > look_.upper + 2 * pose_.translation;
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
    if (found.distance.lower <= 0) Cross(a.corners, b.corners, slack_ + std::max(turn_A, turn_B));
    const double lower = found.distance.lower - slack;
    KeepWay({found.a, found.b, lower, found.distance.upper + slack});
    return lower;
  }

  void Cross(const TrianglePoints& a, const TrianglePoints& b, double turning) {
    const double margin = CrossingMargin(a, b) - turning;
    if (!(margin > look_.crossing_margin)) return;
    if (margin >= pose_.translation / 2) {
      const std::optional<Crossing> crossing =
          CertainCrossing(a, b, turning + pose_.translation / 2);
      if (!crossing) return;  // the margin was a matter of rounding
      KeepPoint(crossing->point, crossing->error);
      look_.upper = std::min(look_.upper, -pose_.translation);
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
  std::uint64_t margin_until_ = kNotTouching;
  double slack_;
  double resolved_lower_ = kInfinity;  // of the pairs that were looked at to the end
  std::vector<Candidate> heap_;
  Look look_;
};

// One point of each component of `of`, given in the frame of the other.
template <typename ToOther>
bool AllOutside(const Surface& of, const Surface& other, ToOther to_other, Work* work) {
  if (other.shape() == nullptr || !other.shape()->closed()) return true;  // a ball is a solid node
  const auto outside = [&](const Eigen::Vector3d& point) {
    const MeshFacts& facts = other.shape()->facts();
    if ((point.array() > facts.upper.array()).any() ||
        (point.array() < facts.lower.array()).any()) {
      return true;
    }
    work->Spend(kWindingUnits);
    return other.shape()->WindingNumberAt(point) == 0;
  };
  if (of.shape() == nullptr) return outside(to_other(Eigen::Vector3d(0, 0, 0)));
  const auto& points = of.shape()->component_points();
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& point) { return outside(to_other(point)); });
}

}  // namespace

Surface::Surface(const BodySegment& body)
    : shape_(body.shape.get()), reach_(body.shape ? body.shape->facts().radius : body.ball.radius) {
  ball_.radius = body.ball.radius;
  ball_.signed_distance = -body.ball.radius;
}

Look LookAt(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal, Work* work) {
  return Traversal(a, b, pose, goal, work).Run();
}

bool NeitherInside(const Surface& a, const Surface& b, const RelativePose& pose, Work* work) {
  return AllOutside(
             b, a, [&](const Eigen::Vector3d& x) { return pose.ToA(x); }, work) &&
         AllOutside(
             a, b, [&](const Eigen::Vector3d& x) { return pose.ToB(x); }, work);
}

}  // namespace collision
