#include "collision_core/narrow_phase/separation/solid_point.h"

#include <algorithm>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

double Length(const Eigen::Vector3d& x) { return numeric::Norm(numeric::IntervalVector(x)).upper; }

// How far a point of one body, in that body's frame, may move by turning about its reference point.
double TurningOf(const BodyTree& surface, double chord, double length) {
  return surface.shape() ? numeric::MultiplyUp(chord, length) : 0;
}

// A point of A, seen from B, and how far that may be off: not by how it was found, but by taking it
// back. ToA(y) is known to within offset_error + matrix_error |y|, and what it differs from x by is
// computed.
Eigen::Vector3d SeenFromB(const Eigen::Vector3d& x_A, const RelativePose& pose, double* off) {
  const Eigen::Vector3d y_B = pose.ToB(x_A);
  const double back = Length(pose.ToA(y_B) - x_A);
  // The difference itself is rounded by less than 2^-53 of its length on each axis.
  *off = numeric::AddUp(
      numeric::MultiplyUp(numeric::kFewRoundingsUp, back),
      numeric::AddUp(pose.offset_error, numeric::MultiplyUp(pose.matrix_error, Length(y_B))));
  return y_B;
}

double SignedDistanceToSolids(const shape::Shape& shape, const Eigen::Vector3d& x,
                              WorkBudget* work) {
  double least = numeric::kInfinity;
  for (const shape::ConvexSolid& solid : shape.solids()) {
    if (work->exhausted()) break;
    work->Spend(1);
    const shape::ConvexFacts& facts = solid.facts();
    // No ball about x that is within the solid is larger, and no point of it nearer.
    if ((x - facts.ball_centre).norm() - facts.ball_radius > least) continue;
    geometry::GjkHint none;
    const geometry::ConvexSet point = geometry::BallSet(x, 0);
    least = std::min(least, SeparationOf(point, solid.set(), {}, &none, work).separation.upper);
  }
  return least;
}

}  // namespace

double SignedDistanceTo(const BodyTree& surface, const Eigen::Vector3d& x, WorkBudget* work) {
  const shape::Shape* shape = surface.shape();
  if (shape == nullptr) return numeric::AddUp(Length(x), -surface.reach());
  const double to_solids = SignedDistanceToSolids(*shape, x, work);
  if (shape->mesh().triangles.empty()) return to_solids;
  work->Spend(kPointUnits);
  const numeric::Interval distance = shape->DistanceTo(x);
  if (!shape->closed()) return std::min(to_solids, distance.upper);
  work->Spend(kWindingUnits);
  const bool outside = shape->WindingNumberAt(x).value_or(0) == 0;
  return std::min(to_solids, outside ? distance.upper : -distance.lower);
}

SolidPoint PointOfA(const BodyTree& a, const Eigen::Vector3d& x_A, WorkBudget* work) {
  return {PairMember::kA, x_A, SignedDistanceTo(a, x_A, work)};
}

SolidPoint PointOfB(const BodyTree& b, const Eigen::Vector3d& x_B, WorkBudget* work) {
  return {PairMember::kB, x_B, SignedDistanceTo(b, x_B, work)};
}

double UpperBy(const SolidPoint& point, const PosedPair& pair, WorkBudget* work) {
  const auto& [a, b, pose] = pair;
  double off = 0, length_a = 0, length_b = 0, other = 0;
  if (point.body == PairMember::kA) {
    const Eigen::Vector3d y_B = SeenFromB(point.x, pose, &off);
    length_a = Length(point.x), length_b = Length(y_B);
    other = SignedDistanceTo(b, y_B, work);
  } else {
    const Eigen::Vector3d y_A = pose.ToA(point.x);
    length_a = Length(y_A), length_b = Length(point.x);
    off = numeric::AddUp(pose.offset_error, numeric::MultiplyUp(pose.matrix_error, length_b));
    other = SignedDistanceTo(a, y_A, work);
  }
  const double turning =
      numeric::AddUp(TurningOf(a, pose.chord_A, length_a), TurningOf(b, pose.chord_B, length_b));
  return numeric::AddUp(numeric::AddUp(point.signed_distance, other), numeric::AddUp(off, turning));
}

}  // namespace collision::narrow_phase
