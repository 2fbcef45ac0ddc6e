#include "collision_core/narrow_phase/convex_pose.h"

#include <cmath>

namespace collision {
namespace {

using Eigen::Vector3d;

/// A root of a sum of three squares is off by 2.5 · 2^-53 of itself, but for underflow.
double LengthUp(const Vector3d& v) {
  return (1 + 0x1p-50) * std::sqrt(v.squaredNorm()) + kSupportUnderflow;
}

/// A root of a sum of three products and a division, each rounded.
constexpr double kUnitError = 8 * 0x1p-53;

/// n / |n|.
PosedHalfSpace Normalised(const ConvexHalfSpace& half_space) {
  const double length = half_space.normal.stableNorm();
  return {half_space.normal / length, half_space.point, 0, kUnitError};
}

}  // namespace

// A point of the core is c + Σ s_i g_i with |s_i| <= 1 (kHull: c + G x). matrix_error holds for
// each vector posed (relative_pose.h), so that the exact pose of the point is off by at most
// offset_error + matrix_error (|c| + Σ |g_i|); of a hull Σ |g_i| |x_i| <= √3 reach < span. The
// turning moves points by chord_B of their distance from the reference point; the ball about them
// moves with them.
ConvexSet PosedB(const ConvexSet& of_B, const RelativePose& pose) {
  ConvexSet posed = of_B;
  posed.generators = pose.matrix * of_B.generators;
  posed.centre = pose.matrix * of_B.centre + pose.offset;
  // The error itself is moved along, by a matrix of norm at most 1 + 2^-20. All terms are positive,
  // so that 2^-40 covers the rounding of their sums.
  const double far = LengthUp(of_B.centre) + of_B.span;
  const double moved = (1 + 0x1p-20) * of_B.error;
  posed.error =
      (1 + 0x1p-40) * (moved + pose.offset_error + (pose.matrix_error + pose.chord_B) * far);
  posed.span = (1 + 0x1p-50) * (1 + pose.matrix_error) * of_B.span;
  return posed;
}

ConvexSet PosedA(const ConvexSet& of_A, const RelativePose& pose) {
  if (pose.chord_A == 0) return of_A;
  ConvexSet posed = of_A;
  const double far = AddUp(LengthUp(of_A.centre), of_A.span);
  posed.error = AddUp(of_A.error, MultiplyUp(pose.chord_A, far));
  return posed;
}

PosedHalfSpace PosedA(const ConvexHalfSpace& of_A, const RelativePose& pose) {
  PosedHalfSpace posed = Normalised(of_A);
  posed.normal_error = AddUp(posed.normal_error, pose.chord_A);
  posed.point_error = MultiplyUp(pose.chord_A, LengthUp(of_A.point));
  return posed;
}

PosedHalfSpace PosedB(const ConvexHalfSpace& of_B, const RelativePose& pose) {
  PosedHalfSpace posed = Normalised(of_B);
  const double share = AddUp(pose.matrix_error, pose.chord_B);
  const double length = LengthUp(of_B.point);
  posed.normal = pose.matrix * posed.normal;
  posed.point = pose.matrix * of_B.point + pose.offset;
  posed.normal_error = AddUp(posed.normal_error, MultiplyUp(1 + 0x1p-40, share));
  posed.point_error = AddUp(pose.offset_error, MultiplyUp(share, length));
  return posed;
}

}  // namespace collision
