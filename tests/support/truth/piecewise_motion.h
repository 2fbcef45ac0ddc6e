// Motions of balls made of pieces of constant acceleration: what really happens in a scenario.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "tests/support/truth/true_motion.h"

namespace collision {

/// p + v τ + ½ a τ² on [start, end), τ in seconds since start.
struct MotionPiece {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();

  /// Where it is in truth.
  TruePose TrueAt(std::int64_t t_ns) const {
    const TrueMotion motion{{p.cast<Real>(), v.cast<Real>()},
                            {{INFINITY, a.cast<Real>(), Vector::Zero()}}};
    return motion.At(static_cast<Real>(t_ns - start_ns) * 1e-9L);
  }

  /// The same motion from a later instant on, rounded: what a scenario goes on with.
  MotionPiece From(std::int64_t t_ns) const {
    const double tau = static_cast<double>(t_ns - start_ns) * 1e-9;
    return {.start_ns = t_ns,
            .end_ns = end_ns,
            .p = p + v * tau + a * (0.5 * tau * tau),
            .v = v + a * tau,
            .a = a};
  }
};

/// Pieces that follow each other; where a piece starts elsewhere than the last one ended, the
/// motion jumps.
struct PiecewiseMotion {
  std::vector<MotionPiece> pieces;
  std::vector<std::int64_t> jumps_ns;

  const MotionPiece& At(std::int64_t t_ns) const {
    const auto after = std::upper_bound(
        pieces.begin(), pieces.end(), t_ns,
        [](std::int64_t t, const MotionPiece& piece) { return t < piece.start_ns; });
    return after == pieces.begin() ? pieces.front() : *std::prev(after);
  }
};

}  // namespace collision
