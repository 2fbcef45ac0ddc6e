#include "collision_core/narrow_phase/solid_point.h"

#include <algorithm>

namespace collision {
namespace {

double Length(const Eigen::Vector3d& x) { return Norm(IntervalVector(x)).upper; }

// How far a point of one body, in that body's frame, may move by turning about its reference point.
double TurningOf(const Surface& surface, double chord, double length) {
  return surface.shape() ? MultiplyUp(chord, length) : 0;
}

// A point of A, seen from B, and how far that may be off: not by how it was found, but by taking it
// back. ToA(y) is known to within offset_error + matrix_error |y|, and what it differs from x by is
// computed.
Eigen::Vector3d SeenFromB(const Eigen::Vector3d& x_A, const RelativePose& pose, double* off) {
  const Eigen::Vector3d y_B = pose.ToB(x_A);
  const double back = Length(pose.ToA(y_B) - x_A);
  // The difference itself is rounded by less than 2^-53 of its length on each axis.
  *off = AddUp(MultiplyUp(1 + 0x1p-50, back),
               AddUp(pose.offset_error, MultiplyUp(pose.matrix_error, Length(y_B))));
  return y_B;
}

}  // namespace

double SignedDistanceTo(const Surface& surface, const Eigen::Vector3d& x, Work* work) {
  const Shape* shape = surface.shape();
  if (shape == nullptr) return AddUp(Length(x), -surface.reach());
  work->Spend(kPointUnits);
  const Interval distance = shape->DistanceTo(x);
  if (!shape->closed()) return distance.upper;
  work->Spend(kWindingUnits);
  return shape->WindingNumberAt(x).value_or(0) == 0 ? distance.upper : -distance.lower;
}

SolidPoint PointOfA(const Surface& a, const Eigen::Vector3d& x_A, Work* work) {
  return {true, x_A, SignedDistanceTo(a, x_A, work)};
}

SolidPoint PointOfB(const Surface& b, const Eigen::Vector3d& x_B, Work* work) {
  return {false, x_B, SignedDistanceTo(b, x_B, work)};
}

double UpperBy(const SolidPoint& point, const Surface& a, const Surface& b,
               const RelativePose& pose, Work* work) {
  double off = 0, length_A = 0, length_B = 0, other = 0;
  if (point.of_A) {
    const Eigen::Vector3d y_B = SeenFromB(point.x, pose, &off);
    length_A = Length(point.x), length_B = Length(y_B);
    other = SignedDistanceTo(b, y_B, work);
  } else {
    const Eigen::Vector3d y_A = pose.ToA(point.x);
    length_A = Length(y_A), length_B = Length(point.x);
    off = AddUp(pose.offset_error, MultiplyUp(pose.matrix_error, length_B));
    other = SignedDistanceTo(a, y_A, work);
  }
  const double turning =
      AddUp(TurningOf(a, pose.chord_A, length_A), TurningOf(b, pose.chord_B, length_B));
  return AddUp(AddUp(point.signed_distance, other), AddUp(off, turning));
}

}  // namespace collision
