#include "collision_core/narrow_phase/separation/containment.h"

#include <algorithm>

#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {
namespace {

enum class Side { kOutside, kInside, kUnknown };

bool OffBox(const Eigen::Vector3d& point, const geometry::MeshFacts& facts) {
  return (point.array() > facts.upper.array()).any() || (point.array() < facts.lower.array()).any();
}

// On which side of the closed surface of `of` a point lies. If the work is spent, the side of a
// point in its box is unknown.
Side SideOf(const Eigen::Vector3d& point, const shape::Shape& of, WorkBudget* work) {
  if (OffBox(point, of.facts())) return Side::kOutside;
  if (work->exhausted()) return Side::kUnknown;
  work->Spend(kWindingUnits);
  const std::optional<int> winding = of.WindingNumberAt(point);
  if (!winding) return Side::kUnknown;
  return *winding == 0 ? Side::kOutside : Side::kInside;
}

// Whether a body of one component has a point off the other one's box: then none of it is inside.
// Points as seen by `ToOther`.
template <typename ToOther>
bool HasPointOff(const shape::Shape& shape, const shape::Shape& other, ToOther to_other) {
  if (shape.facts().components != 1 || !shape.solids().empty()) return false;
  const auto& extremes = shape.packed().extremes();
  return std::any_of(extremes.begin(), extremes.end(), [&](const Eigen::Vector3d& point) {
    return OffBox(to_other(point), other.facts());
  });
}

// Calls `visit(side, point)` for the points of `body` that decide, until it returns false: one of
// each component; for a ball its centre, which is its reference point.
template <typename ToOther, typename Visit>
void VisitSides(const BodyTree& body, const shape::Shape& other, ToOther to_other, Visit visit,
                WorkBudget* work) {
  if (body.shape() == nullptr) {
    const Eigen::Vector3d centre(0, 0, 0);
    visit(SideOf(to_other(centre), other, work), centre);
    return;
  }
  if (HasPointOff(*body.shape(), other, to_other)) return;
  for (const Eigen::Vector3d& point : body.shape()->component_points()) {
    if (!visit(SideOf(to_other(point), other, work), point)) return;
  }
}

// Whether the balls around the two bodies are certainly apart.
bool AreRootsApart(const PosedPair& pair, double slack) {
  const BodyTree &a = pair.a, &b = pair.b;
  const RelativePose& pose = pair.pose;
  const sphere_tree::SphereNode& root_a = a.root();
  const sphere_tree::SphereNode& root_b = b.root();
  const double distance = (pose.ToA(root_b.centre) - root_a.centre).norm();
  return distance > root_a.radius + root_b.radius + slack;
}

}  // namespace

// The surfaces are apart by more than all that is uncertain: so a point's side is that of the point
// where it is computed to be.
Containment TestContainment(const PosedPair& pair, WorkBudget* work) {
  const BodyTree &a = pair.a, &b = pair.b;
  const RelativePose& pose = pair.pose;
  Containment nesting;
  nesting.neither = true;
  const double turning = numeric::AddUp(numeric::MultiplyUp(pose.chord_A, a.turning_reach()),
                                        numeric::MultiplyUp(pose.chord_B, b.turning_reach()));
  const double slack = numeric::AddUp(turning, SlackOf(pair));
  if (AreRootsApart(pair, numeric::AddUp(slack, pose.translation))) return nesting;
  const auto judge = [&](Side side, const Eigen::Vector3d& x_A) {
    if (side != Side::kOutside) nesting.neither = false;
    if (side == Side::kInside) nesting.point = x_A, nesting.point_error = slack;
    return nesting.neither;
  };
  if (a.shape() && a.shape()->closed()) {
    VisitSides(
        b, *a.shape(), [&](const Eigen::Vector3d& x_B) { return pose.ToA(x_B); },
        [&](Side side, const Eigen::Vector3d& x_B) { return judge(side, pose.ToA(x_B)); }, work);
  }
  if (nesting.neither && b.shape() && b.shape()->closed()) {
    VisitSides(
        a, *b.shape(), [&](const Eigen::Vector3d& x_A) { return pose.ToB(x_A); }, judge, work);
  }
  return nesting;
}

}  // namespace collision::narrow_phase
