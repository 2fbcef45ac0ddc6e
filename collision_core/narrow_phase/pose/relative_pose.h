// Two bodies at one instant, seen from the body frame of the first.
//
// Of the bounds that hold (forward, backward) the least uncertain one is taken at each instant. B
// is posed in A's body frame, positions subtracted first. Rounding is one allowance for the whole
// query (offset_error, matrix_error; derived in relative_pose.cc). The turning of either body moves
// a node's centre c by at most 2 |c| sin(θ/2), node by node. Translation is kept apart, so that the
// search through time can let it grow.
#pragma once

#include <cstddef>

#include "collision_core/narrow_phase/pose/body_segment.h"

namespace collision::narrow_phase {

/// matrix x + offset, entry by entry three products and three sums, of terms below 1.1 |x| and
/// |offset|: less than 8 units of |x| + |offset| on each axis, and √3 times that in length.
inline constexpr double kPosingRounding = 16 * 0x1p-53;

/// The pose that the chosen bounds predict, and how far the true one may be from it.
///
/// Rounding: for a point x of B, in B's body frame, |x_A − exact| <= offset_error + matrix_error
/// |x| with x_A = matrix x + offset computed in doubles. Motion: relative to the prediction B's
/// reference point is off by at most `translation`, and each body is turned about its own, so that
/// its point x moves by at most chord |x|.
struct RelativePose {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();  ///< R_AB
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();      ///< From A's reference point to B's.
  double offset_error = 0;
  double matrix_error = 0;
  double translation = 0;  ///< u_A + u_B [m].
  double chord_A = 0;      ///< 2 sin(min(π, θ) / 2) [m per m], rounded up.
  double chord_B = 0;

  /// To express points in the world.
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix_WA = Eigen::Matrix3d::Identity();
  /// A point of A moves by this and by chord_A |x|, its rounding in the world included.
  double error_A = 0;

  Eigen::Vector3d ToA(const Eigen::Vector3d& x_B) const { return matrix * x_B + offset; }
  Eigen::Vector3d ToB(const Eigen::Vector3d& x_A) const {
    return matrix.transpose() * (x_A - offset);
  }
};

/// The bounds of A and of B that leave the least uncertainty at an instant; `certain` is false
/// where nothing is known of one of them.
struct BoundChoice {
  std::size_t of_A = 0;
  std::size_t of_B = 0;
  bool certain = false;
};
BoundChoice BestBounds(const BodySegment& a, const BodySegment& b, double delta);

/// How far a matrix made of a unit quaternion may be from a rotation.
inline constexpr double kMatrixRounding = 0x1p-49;

/// B's body frame seen from A's, as given: nothing but rounding, and A's frame is the world's.
/// Requires a matrix that is a rotation to within kMatrixRounding, which is counted.
inline RelativePose PoseOf(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& offset) {
  RelativePose pose;
  pose.matrix = matrix;
  pose.offset = offset;
  pose.matrix_error = kPosingRounding + kMatrixRounding;
  // The sum of the coordinates is no less than the length; 2^-50 for its own rounding.
  pose.offset_error = kPosingRounding * (1 + 0x1p-50) * offset.cwiseAbs().sum();
  return pose;
}

/// At δ after the segments' base.
RelativePose PoseAt(const BodySegment& a, const BodySegment& b, BoundChoice choice, double delta);

/// How far any point of the body may be from the reference point [m]; 0 for a ball, which looks
/// the same however it turns.
inline double ReachOf(const BodySegment& body) {
  return body.shape ? body.shape->facts().radius : 0;
}

}  // namespace collision::narrow_phase
