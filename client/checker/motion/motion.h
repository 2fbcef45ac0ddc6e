// Positions and speeds of bodies at any instant of their exact motion.
#pragma once

#include "client/checker/motion/contact_spans.h"
#include "client/checker/motion/motion_truth.h"
#include "client/checker/shape/vector.h"

namespace collision::checker {

/// w, x, y, z; body to world.
using Quaternion = std::array<long double, 4>;

/// The orientation `seconds` after the turn's begin: solves q' = ½ ω q with ω = w + b t by its
/// power series (n+1) q_{n+1} = ½ (w q_n + b q_{n−1}), in steps of at most one radian.
Quaternion OrientationAt(const Turn& turn, long double seconds);

/// The piece's cubic in seconds since `start_ns`, instead of since the piece's begin.
Cubic3 Shifted(const Piece& piece, std::int64_t start_ns);

/// One piece of each of two motions, over the time they share.
class PairMotion {
 public:
  /// Time counts in seconds since `from_ns`.
  PairMotion(const Piece& a, const Piece& b, std::int64_t from_ns);

  /// From A to B, in the world's axes.
  const Cubic3& difference() const { return difference_; }

  Pose At(long double seconds) const;

  /// An upper bound of the relative speed of any two points during [s0, s1] [m/s], for bodies that
  /// reach `reach_a` and `reach_b` about their reference points.
  long double SpeedMax(long double s0, long double s1, double reach_a, double reach_b) const;

 private:
  const Piece& a_;
  const Piece& b_;
  long double since_a_;
  long double since_b_;
  Cubic3 difference_;
};

}  // namespace collision::checker
