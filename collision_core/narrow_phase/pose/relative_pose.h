// Two bodies at one instant, seen from the body frame of the first.
//
// Rounding is one allowance for the whole query (offset_error, matrix_error; derived in
// segment_pose.cc, where poses are made from motions). The turning of either body moves a node's
// centre c by at most 2 |c| sin(θ/2), node by node. Translation is kept apart, so that the search
// through time can let it grow.
#pragma once

#include <Eigen/Core>

#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

/// R_AB x + p_AB, entry by entry three products and three sums, of terms below 1.1 |x| and
/// |offset|: less than 8 units of |x| + |offset| on each axis, and √3 times that in length.
inline constexpr double kPosingRounding = 16 * numeric::kUnitRoundoff;

/// R_AB lengthens no vector by more: it is a rotation to within 2^-20.
inline constexpr double kPosedLengthUp = 1 + 0x1p-20;
/// Likewise of a sum of some lengths, posed ones among them: with room for its rounding.
inline constexpr double kPosedSumUp = 1 + 0x1p-18;

/// The pose that the chosen bounds predict, and how far the true one may be from it.
///
/// Rounding: for a point x of B, in B's body frame, |x_A − exact| <= offset_error + matrix_error
/// |x| with x_A = R_AB x + p_AB computed in doubles. Motion: relative to the prediction B's
/// reference point is off by at most `translation`, and each body is turned about its own, so that
/// its point x moves by at most chord |x|.
struct RelativePose {
  Eigen::Matrix3d R_AB = Eigen::Matrix3d::Identity();  ///< Turns vectors of B into A's frame.
  Eigen::Vector3d p_AB = Eigen::Vector3d::Zero();      ///< From A's reference point to B's [m].
  double offset_error = 0;                             ///< Of p_AB [m].
  double matrix_error = 0;  ///< Of R_AB, and of posing a point with both [m per m].
  double translation = 0;   ///< u_A + u_B [m].
  double chord_A = 0;       ///< 2 sin(min(π, θ) / 2) [m per m], rounded up.
  double chord_B = 0;

  /// A's body frame in the world: an answer's points and directions are given there.
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_WA = Eigen::Matrix3d::Identity();
  /// A point of A moves by this and by chord_A |x|, its rounding in the world included.
  double error_A = 0;

  Eigen::Vector3d ToA(const Eigen::Vector3d& x_B) const { return R_AB * x_B + p_AB; }
  Eigen::Vector3d ToB(const Eigen::Vector3d& x_A) const { return R_AB.transpose() * (x_A - p_AB); }
};

/// How far a matrix made of a unit quaternion may be from a rotation.
inline constexpr double kMatrixRounding = 0x1p-49;

/// B's body frame seen from A's, as given: nothing but rounding, and A's frame is the world's.
/// Unchecked: the matrix is a rotation to within kMatrixRounding, which is counted. Callers:
/// queries at a pose that is known exactly, in benchmarks and tests; the service's poses come from
/// PoseAt() (segment_pose.h).
inline RelativePose PoseOf(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB) {
  RelativePose pose;
  pose.R_AB = R_AB;
  pose.p_AB = p_AB;
  pose.matrix_error = kPosingRounding + kMatrixRounding;
  // The sum of the coordinates is no less than the length.
  pose.offset_error = kPosingRounding * numeric::kFewRoundingsUp * p_AB.cwiseAbs().sum();
  return pose;
}

}  // namespace collision::narrow_phase
