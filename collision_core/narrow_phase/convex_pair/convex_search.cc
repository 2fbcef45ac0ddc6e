#include "collision_core/narrow_phase/convex_pair/convex_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/geometry/convex/box_zonotope.h"
#include "collision_core/geometry/convex/direction_polish.h"
#include "collision_core/geometry/convex/epa.h"
#include "collision_core/geometry/convex/feature_directions.h"
#include "collision_core/geometry/convex/gjk_simplex.h"

namespace collision::narrow_phase {

using Eigen::Vector3d;

ConvexSearch::ConvexSearch(const ConvexQuery& query, ConvexBracket* bracket, WorkBudget* work)
    : query_(query), bracket_(*bracket), pair_(bracket->pair()), work_(*work) {
  CORE_CHECK(!(bracket->lower() > -numeric::kInfinity), "a search begins with nothing known",
             bracket->lower());
}

void ConvexSearch::Run(geometry::GjkHint* hint) {
  if (query_.goal == ConvexGoal::kYesNo && DecideByFaces()) return;
  const geometry::GjkHint none;
  FindNearest(hint ? *hint : none);
  if (!found_.encloses && !IsGoodEnough()) TryFeatures();
  if (!found_.encloses && pair_.IsSmooth() && !IsGoodEnough()) Polish();
  if (MayOverlap()) Deepen();
  if (hint) KeepGjkHint(pair_, found_, hint);
}

bool ConvexSearch::AreZonotopes() const {
  if (pair_.a().IsThin() && pair_.b().IsThin()) return false;
  return IsZonotope(pair_.a()) && IsZonotope(pair_.b());
}

// The search for nearest points gets a quarter of the tolerances: certifying them costs the rest.
geometry::GjkGoal ConvexSearch::GjkGoalOfQuery() const {
  const double rounding = bracket_.rounding();
  geometry::GjkGoal goal{query_.relative_tolerance / 4, query_.absolute_tolerance / 4, rounding};
  goal.steps = StepsWithin(kGjkStepUnits, geometry::kGjkStepsMax);
  if (query_.goal != ConvexGoal::kYesNo) return goal;
  const double margin = 2 * (pair_.GapError() + pair_.PointError() + bracket_.error());
  goal.apart = rounding + margin;
  if (rounding > margin) goal.near = rounding - margin;
  return goal;
}

std::uint32_t ConvexSearch::StepsWithin(std::uint64_t units, std::uint32_t most) const {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(work_.left() / units + 1, most));
}

/// Whether faces alone answer yes or no. Then no points are searched: all that is known of them is
/// that the centres belong to the cores.
bool ConvexSearch::DecideByFaces() {
  if (!AreZonotopes()) return false;
  TestFaces(GjkGoalOfQuery().apart);
  if (!(bracket_.separation_lower() > 0 || bracket_.separation_upper() <= 0)) return false;
  found_.simplex[0] = pair_.At({Vector3d::Zero(), Vector3d::Zero()});
  found_.weights[0] = 1;
  found_.count = 1;
  found_.nearest = pair_.between();
  bracket_.TakeWay(found_.nearest);
  return true;
}

void ConvexSearch::TestFaces(double apart) {
  const geometry::FaceSeparation faces = SeparationOfFaces(pair_, apart);
  work_.Spend(kBoxAxesUnits);
  bracket_.TakeGap(faces.direction, faces.gap);
  bracket_.TakeBallInside(faces.inside);
}

void ConvexSearch::FindNearest(const geometry::GjkHint& hint) {
  if (pair_.a().IsThin() && pair_.b().IsThin()) {
    NearestOfSegments(pair_, &found_);
  } else {
    RunGjk(pair_, hint, GjkGoalOfQuery(), &found_);
  }
  work_.Spend(kGjkStepUnits * found_.steps);
  exhausted_ = found_.steps >= geometry::kGjkStepsMax || work_.exhausted();
  const double length = std::sqrt(found_.direction.squaredNorm());
  if (found_.gap > -numeric::kInfinity) {
    bracket_.TakeGap(found_.direction / length, found_.gap);
  } else {
    bracket_.TryDirection(found_.direction);
  }
  bracket_.TakeWay(found_.nearest);
}

/// The direction between nearest points a short way apart is uncertain; features give it exactly.
void ConvexSearch::TryFeatures() {
  const geometry::FeatureDirections features(pair_, found_.direction);
  for (const Vector3d& direction : features) {
    work_.Spend(kGjkStepUnits);
    bracket_.TryDirection(direction);
    if (IsGoodEnough()) return;
  }
}

/// Beside a smooth core: the corner, the edge or the face of the other core at which the search
/// ended, if that core has any.
void ConvexSearch::Polish() {
  std::array<Vector3d, 4> corners;
  const int count = CornersOfPolytope(&corners);
  PolishAcross(Vector3d::Zero());
  const Vector3d* const c = corners.data();
  for (int i = 1; i < count; ++i) {
    for (int j = 0; j < i && !IsGoodEnough(); ++j) PolishAcross(c[i] - c[j]);
  }
  if (count == 3 && !IsGoodEnough()) {
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
    TryWithPoints(normal.dot(found_.direction) < 0 ? Vector3d(-normal) : normal);
  }
}

/// Zero: across no edge.
void ConvexSearch::PolishAcross(const Vector3d& edge) {
  work_.Spend(kGjkStepUnits * geometry::kPolishSteps);
  TryWithPoints(WidestNear(pair_, found_.direction, edge));
}

/// Distinct corners of the simplex that belong to the core that is not smooth, seen from its
/// centre; none if both are smooth. Returns how many.
int ConvexSearch::CornersOfPolytope(std::array<Vector3d, 4>* corners) const {
  if (pair_.a().IsSmooth() && pair_.b().IsSmooth()) return 0;
  const bool in_a = pair_.b().IsSmooth();
  int count = 0;
  for (int i = 0; i < found_.count; ++i) {
    const geometry::ConvexPair::Witness& witness = found_.simplex[i].witness;
    const Vector3d x = in_a ? pair_.a().PointAt(witness.a) : pair_.b().PointAt(witness.b);
    if (std::find(corners->begin(), corners->begin() + count, x) == corners->begin() + count) {
      (*corners)[count++] = x;
    }
  }
  return count;
}

/// Tries a direction, and the simplex with the smooth core's point along it.
void ConvexSearch::TryWithPoints(const Vector3d& direction) {
  const double length = std::sqrt(direction.squaredNorm());
  if (!(length > geometry::kSupportUnderflow)) return;
  const Vector3d n = direction / length;
  const geometry::ConvexPair::Point there = pair_.Against(n);
  bracket_.TakeGap(n, n.dot(there.y));
  const geometry::GjkResult moved = WithSmoothPoints(n);
  std::array<const Vector3d*, 4> corners{};
  for (int i = 0; i < moved.count; ++i) corners[i] = &moved.simplex[i].y;
  geometry::SimplexPoint point;
  NearestOfSimplex(corners, moved.count, -1, &point);
  if (point.encloses) return;
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < point.count; ++i) {
    sum += point.weights[i] * moved.simplex[point.corners[i]].y;
  }
  if (!(sum.squaredNorm() < found_.nearest.squaredNorm())) return;
  for (int i = 0; i < point.count; ++i) {
    found_.simplex[i] = moved.simplex[point.corners[i]];
    found_.weights[i] = point.weights[i];
  }
  found_.count = point.count;
  found_.nearest = sum;
  bracket_.TakeWay(sum);
}

/// What was found, with the smooth cores' points turned towards n in every corner of the simplex.
geometry::GjkResult ConvexSearch::WithSmoothPoints(const Vector3d& n) const {
  geometry::GjkResult moved = found_;
  for (int i = 0; i < moved.count; ++i) {
    geometry::ConvexPair::Witness witness = moved.simplex[i].witness;
    if (pair_.a().IsSmooth()) witness.a = pair_.a().SupportBeside(witness.a, n);
    if (pair_.b().IsSmooth()) witness.b = pair_.b().SupportBeside(witness.b, -n);
    moved.simplex[i] = pair_.At(witness);
  }
  return moved;
}

void ConvexSearch::Deepen() {
  if (AreZonotopes()) {
    TestFaces(numeric::kInfinity);
    if (IsGoodEnough()) return;
    if (query_.goal != ConvexGoal::kDepth && bracket_.separation_upper() <= 0) return;
  }
  GrowPolytope();
}

void ConvexSearch::GrowPolytope() {
  geometry::EpaGoal goal{query_.relative_tolerance, query_.absolute_tolerance};
  if (query_.goal != ConvexGoal::kDepth) {
    goal.inside = std::max(0.0, 2 * bracket_.error() - bracket_.rounding());
  }
  goal.steps = StepsWithin(kEpaStepUnits, geometry::kEpaStepsMax);
  const geometry::Overlap overlap = RunEpa(pair_, found_, goal);
  work_.Spend(kEpaStepUnits * overlap.steps);
  exhausted_ = exhausted_ || overlap.steps >= goal.steps;
  bracket_.TakeBallInside(overlap.inside);
  bracket_.TryDirection(overlap.direction);
  if (!(bracket_.lower() > -numeric::kInfinity)) bracket_.TryDirection(Vector3d::UnitX());
}

}  // namespace collision::narrow_phase
