#include "collision_core/narrow_phase/pose/convex_pose.h"

#include <cmath>

#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// Relative error of a root of a sum of three products and of a division.
constexpr double kUnitError = 8 * numeric::kUnitRoundoff;

/// n / |n|.
PosedHalfSpace Normalised(const shape::ConvexHalfSpace& half_space) {
  const double length = half_space.normal.stableNorm();
  return {half_space.normal / length, half_space.point, 0, kUnitError};
}

}  // namespace

// A point of the core is c + Σ s_i g_i with |s_i| <= 1 (kHull: c + G x). matrix_error holds for
// each vector posed (relative_pose.h), so that the exact pose of the point is off by at most
// offset_error + matrix_error (|c| + Σ |g_i|); of a hull Σ |g_i| |x_i| <= √3 reach < span. The
// turning moves points by chord_B of their distance from the reference point; the ball about them
// moves with them.
geometry::ConvexSet PosedB(const geometry::ConvexSet& of_b, const RelativePose& pose) {
  geometry::ConvexSet posed = of_b;
  posed.generators = pose.R_AB * of_b.generators;
  posed.centre = pose.R_AB * of_b.centre + pose.p_AB;
  // The error itself is moved along, by the matrix. All terms are positive.
  const double far = geometry::LengthUp(of_b.centre) + of_b.span;
  const double moved = kPosedLengthUp * of_b.error;
  posed.error = numeric::kManyRoundingsUp *
                (moved + pose.offset_error + (pose.matrix_error + pose.chord_B) * far);
  posed.span = numeric::kFewRoundingsUp * (1 + pose.matrix_error) * of_b.span;
  return posed;
}

geometry::ConvexSet PosedA(const geometry::ConvexSet& of_a, const RelativePose& pose) {
  if (pose.chord_A == 0) return of_a;
  geometry::ConvexSet posed = of_a;
  const double far = numeric::AddUp(geometry::LengthUp(of_a.centre), of_a.span);
  posed.error = numeric::AddUp(of_a.error, numeric::MultiplyUp(pose.chord_A, far));
  return posed;
}

PosedHalfSpace PosedA(const shape::ConvexHalfSpace& of_a, const RelativePose& pose) {
  PosedHalfSpace posed = Normalised(of_a);
  posed.normal_error = numeric::AddUp(posed.normal_error, pose.chord_A);
  posed.point_error = numeric::MultiplyUp(pose.chord_A, geometry::LengthUp(of_a.point));
  return posed;
}

PosedHalfSpace PosedB(const shape::ConvexHalfSpace& of_b, const RelativePose& pose) {
  PosedHalfSpace posed = Normalised(of_b);
  const double share = numeric::AddUp(pose.matrix_error, pose.chord_B);
  const double length = geometry::LengthUp(of_b.point);
  posed.normal = pose.R_AB * posed.normal;
  posed.point = pose.R_AB * of_b.point + pose.p_AB;
  posed.normal_error =
      numeric::AddUp(posed.normal_error, numeric::MultiplyUp(numeric::kManyRoundingsUp, share));
  posed.point_error = numeric::AddUp(pose.offset_error, numeric::MultiplyUp(share, length));
  return posed;
}

}  // namespace collision::narrow_phase
