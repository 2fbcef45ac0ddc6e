#include "collision_core/narrow_phase/pose/convex_pose.h"

#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

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

}  // namespace collision::narrow_phase
