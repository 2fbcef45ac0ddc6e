#include "collision_core/narrow_phase/separation/separation_findings.h"

#include <algorithm>

#include "collision_core/narrow_phase/separation/element.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

// Squares of distances beyond this [m] may overflow.
constexpr double kSquareMax = 1e150;

// Relative tolerance for two convex solids, as a share of their distance or depth.
constexpr double kEnoughOfSolids = 0x1p-10;

double Greatest(const geometry::TrianglePoints& t) {
  return std::sqrt(std::max({t[0].squaredNorm(), t[1].squaredNorm(), t[2].squaredNorm()}));
}

// The gap of two sets' projections along about a unit vector, rounded down: supports lose
// kSupportError of the spans, the length of n, products and sums less than as much again of the
// same size.
double GapAlong(const Eigen::Vector3d& n, const geometry::ConvexSet& a,
                const geometry::ConvexSet& b) {
  const Eigen::Vector3d between = b.centre - a.centre;
  const double size = between.cwiseAbs().sum() + a.span + b.span + a.rounding + b.rounding;
  const double gap = n.dot(between) + n.dot(b.SupportPoint(-n)) - n.dot(a.SupportPoint(n));
  return gap - (a.rounding + b.rounding + a.error + b.error) * numeric::kFewRoundingsUp -
         2 * geometry::kSupportError * size - 2 * geometry::kSupportUnderflow;
}

}  // namespace

SeparationFindings::SeparationFindings(const PosedPair& pair, Goal goal,
                                       std::optional<BracketTolerance> narrow)
    : a_(pair.a),
      b_(pair.b),
      pose_(pair.pose),
      goal_(goal),
      narrow_(narrow),
      slack_(SlackOf(pair)) {}

double SeparationFindings::MeasureNodes(NodePair nodes) {
  const sphere_tree::SphereNode& a = a_.node(nodes.a);
  const sphere_tree::SphereNode& b = b_.node(nodes.b);
  const Eigen::Vector3d c_b = pose_.ToA(b.centre);
  const double distance = (c_b - a.centre).norm();
  if (!(distance < kSquareMax)) return distance > 0 ? kSquareMax / 2 : -numeric::kInfinity;
  double slack = slack_;
  if (pose_.chord_A > 0) slack += pose_.chord_A * a.centre.norm();
  if (pose_.chord_B > 0) slack += pose_.chord_B * b.centre.norm();
  const double upper = distance + a.signed_distance + b.signed_distance + slack;
  const bool is_news = upper < bracket_.upper || bracket_.witness.is_none();
  if (upper <= -pose_.translation && is_news) {
    CommonPoint(a, b, c_b, distance, slack);
    bracket_.witness = ContactWitness::Nodes(nodes);
  }
  TightenUpper(upper);
  return distance - a.radius - b.radius - slack;
}

// Keeps a point common to a ball inside one solid, or the surface near its centre, and that of the
// other body.
void SeparationFindings::CommonPoint(const sphere_tree::SphereNode& a,
                                     const sphere_tree::SphereNode& b, const Eigen::Vector3d& c_b,
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

void SeparationFindings::KeepPoint(const Eigen::Vector3d& point, double error) {
  if (!(error < bracket_.point_error)) return;
  bracket_.point = point;
  bracket_.point_error = error;
}

double SeparationFindings::TurnOfA(const geometry::TrianglePoints& t) const {
  return pose_.chord_A == 0 ? 0 : pose_.chord_A * Greatest(t);
}

// How far the corners of a triangle of B move by its turning: they are |x − offset| from its
// reference point.
double SeparationFindings::TurnOfB(const geometry::TrianglePoints& t) const {
  if (pose_.chord_B == 0) return 0;
  const geometry::TrianglePoints own = {t[0] - pose_.p_AB, t[1] - pose_.p_AB, t[2] - pose_.p_AB};
  return pose_.chord_B * Greatest(own);
}

// The gap of the projections along the shortest way found so far, a unit vector but for rounding;
// what rounding may have made of it is in the slack.
double SeparationFindings::GapAlongDirection(const geometry::TrianglePoints& a,
                                             const geometry::TrianglePoints& b) const {
  const Eigen::Vector3d& n = direction_;
  const double high = std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])});
  return std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])}) - high;
}

double SeparationFindings::MeasureTriangles(ElementPair triangles, FirstTest first,
                                            WorkBudget* work) {
  const geometry::TrianglePoints corners_a = CornersOf(*a_.shape(), triangles.a);
  const geometry::TrianglePoints corners_b = CornersOf(*b_.shape(), triangles.b, pose_);
  const double slack = slack_ + TurnOfA(corners_a) + TurnOfB(corners_b);
  work->Spend(kBoxPairUnits);
  const double along = GapAlongDirection(corners_a, corners_b) - slack;
  if (along > Limit()) return along;
  const bool cross_first = first == FirstTest::kCrossing && goal_ == Goal::kYesNo;
  if (cross_first) {
    work->Spend(kCrossingUnits);
    Cross(triangles, corners_a, corners_b);
    if (Touching()) return -numeric::kInfinity;
  }
  work->Spend(kTrianglePairUnits);
  const geometry::TriangleDistance found = geometry::DistanceOf(corners_a, corners_b);
  if (found.distance.lower <= 0 && !cross_first) Cross(triangles, corners_a, corners_b);
  const double lower = found.distance.lower - slack;
  KeepWay({found.a, found.b, lower, found.distance.upper + slack, triangles});
  return lower;
}

double SeparationFindings::MeasureElements(ElementPair elements, WorkBudget* work) {
  if (AnySolid(a_, b_, elements)) return MeasureSolids(elements, work);
  return MeasureTriangles(elements, FirstTest::kDistance, work);
}

// How narrow the bracket of two elements has to be for the goal of the search.
ConvexQuery SeparationFindings::SolidsQuery() const {
  if (goal_ == Goal::kNearest) return {ConvexGoal::kDepth, 0, 0};
  if (narrow_) return {ConvexGoal::kDepth, narrow_->relative / 4, narrow_->absolute / 4};
  if (goal_ == Goal::kYesNo && pose_.translation == 0) return {ConvexGoal::kYesNo, 0, 0};
  return {ConvexGoal::kDepth, kEnoughOfSolids, kEnoughOfSolids * pose_.translation};
}

// A query of its own, from its beginning to its end, so that it is the same wherever the search
// pauses. Along the shortest way found so far most pairs are seen to be too far apart.
double SeparationFindings::MeasureSolids(ElementPair solids, WorkBudget* work) {
  const geometry::ConvexSet of_a = PosedA(SetOf(a_, solids.a), pose_);
  const geometry::ConvexSet of_b = PosedB(SetOf(b_, solids.b), pose_);
  work->Spend(kBoxPairUnits);
  if (direction_ != Eigen::Vector3d::Zero()) {
    const double along = GapAlong(direction_, of_a, of_b);
    if (along > Limit()) return along;
  }
  WorkBudget own(kSolidPairUnits);
  geometry::GjkHint none;
  const ConvexSeparation found = SeparationOf(of_a, of_b, SolidsQuery(), &none, &own);
  work->Spend(own.spent());
  const double upper = found.separation.upper;
  if (upper <= -pose_.translation && upper < bracket_.upper) {
    KeepPoint(found.a, found.point_error);
    bracket_.witness = ContactWitness::Elements(solids);
  }
  KeepWay({found.a, found.b, found.separation.lower, upper, solids});
  return found.separation.lower;
}

double SeparationFindings::MeasureBallAgainst(ElementIndex element, WorkBudget* work) {
  if (AnySolid(a_, b_, {element, element})) return MeasureSolids({element, element}, work);
  if (a_.shape()) {
    const geometry::TrianglePoints corners = CornersOf(*a_.shape(), element);
    geometry::TriangleDistance found = geometry::DistanceOf(pose_.p_AB, corners);
    std::swap(found.a, found.b);
    return MeasureBall(PairMember::kB, element, found, slack_ + TurnOfA(corners), work);
  }
  const geometry::TrianglePoints corners = CornersOf(*b_.shape(), element, pose_);
  const geometry::TriangleDistance found = geometry::DistanceOf(Eigen::Vector3d(0, 0, 0), corners);
  return MeasureBall(PairMember::kA, element, found, slack_ + TurnOfB(corners), work);
}

// A ball and a triangle: the nearest points of its centre and of the triangle are known.
double SeparationFindings::MeasureBall(PairMember ball, ElementIndex triangle,
                                       const geometry::TriangleDistance& found, double slack,
                                       WorkBudget* work) {
  const bool ball_is_a = ball == PairMember::kA;
  const double radius = (ball_is_a ? a_ : b_).reach();
  work->Spend(kTrianglePairUnits / 2);
  Eigen::Vector3d a = found.a, b = found.b;
  const double length = (b - a).norm();
  const double share = length > 0 ? std::min(1.0, radius / length) : 0;
  if (ball_is_a) {
    a += share * (found.b - found.a);
  } else {
    b -= share * (found.b - found.a);
  }
  const double lower = found.distance.lower - radius - slack;
  const double upper = found.distance.upper - radius + slack;
  if (upper <= -pose_.translation && upper < bracket_.upper) {
    KeepPoint(ball_is_a ? found.b : found.a, slack);  // of the surface, within the ball
    bracket_.witness = ContactWitness::Elements({triangle, triangle});
  }
  KeepWay({a, b, lower, upper, {triangle, triangle}});
  return lower;
}

void SeparationFindings::RecheckElements(ElementPair elements, WorkBudget* work) {
  if (AnySolid(a_, b_, elements)) {
    MeasureSolids(elements, work);
    return;
  }
  work->Spend(kCrossingUnits);
  Cross(elements, CornersOf(*a_.shape(), elements.a), CornersOf(*b_.shape(), elements.b, pose_));
}

void SeparationFindings::Cross(ElementPair triangles, const geometry::TrianglePoints& a,
                               const geometry::TrianglePoints& b) {
  const double turning = slack_ + std::max(TurnOfA(a), TurnOfB(b));
  const double margin = geometry::CrossingMargin(a, b) - turning;
  if (!(margin > bracket_.crossing_margin)) return;
  if (margin >= pose_.translation / 2) {
    const std::optional<geometry::Crossing> crossing =
        geometry::CertainCrossing(a, b, turning + pose_.translation / 2);
    if (!crossing) return;  // the margin was a matter of rounding
    KeepPoint(crossing->point, crossing->error);
    bracket_.upper = std::min(bracket_.upper, -pose_.translation);
    bracket_.witness = ContactWitness::Elements(triangles);
  }
  bracket_.crossing_margin = margin;
}

void SeparationFindings::KeepWay(const NearestWay& way) {
  TightenUpper(way.upper);
  if (way.lower > bracket_.upper + 2 * pose_.translation) return;
  if (!way_ || way.upper < way_->upper) {
    way_ = way;
    const double length = (way.b - way.a).norm();
    if (length > 0) direction_ = (way.b - way.a) / length;
  }
  if (goal_ != Goal::kNearest) return;
  // A triangle may stand in several leaves.
  const bool known =
      std::any_of(bracket_.ways.begin(), bracket_.ways.end(), [&](const auto& other) {
        return other.a == way.a && other.b == way.b && other.upper == way.upper;
      });
  if (known) return;
  bracket_.ways.push_back(way);
  if (bracket_.ways.size() > kWaysMax) DropLonger();
}

void SeparationFindings::DropLonger() {
  const double reach = bracket_.upper + 2 * pose_.translation;
  std::erase_if(bracket_.ways, [reach](const NearestWay& way) { return way.lower > reach; });
}

// Half-way along the shortest way, where contact is not certain.
void SeparationFindings::PointBetween() {
  if (!way_ || bracket_.point_error < numeric::kInfinity) return;
  if (way_->lower > bracket_.upper + 2 * pose_.translation) return;
  bracket_.point = (way_->a + way_->b) / 2;
  bracket_.point_error = std::max(0.0, way_->upper);
  bracket_.elements = way_->elements;
}

SeparationBracket SeparationFindings::Result(const SearchEnd& end) {
  bracket_.lower = end.unopened;
  if (bracket_.upper < bracket_.lower) {
    // Nearer to each other than their surfaces are: one is inside the other, and as deep at least
    // as the surfaces are apart, since no shorter way takes it out again.
    if (bracket_.lower > 0) bracket_.upper = std::min(bracket_.upper, -bracket_.lower);
    if (bracket_.lower <= 0) bracket_.lower = bracket_.upper;
  }
  bracket_.exhausted = end.exhausted;
  bracket_.level = end.level;
  if (bracket_.witness.kind == ContactWitness::Kind::kElements) {
    bracket_.elements = bracket_.witness.elements;
  }
  PointBetween();
  DropLonger();
  if (end.exhausted || bracket_.ways.size() > kWaysMax) bracket_.ways.clear();
  return std::move(bracket_);
}

}  // namespace collision::narrow_phase
