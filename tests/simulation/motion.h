// Motions of the simulated agents: what really happens, of which the service sees single states.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "tests/support/random.h"
#include "tests/support/truth/piecewise_motion.h"

namespace collision::server {

using Piece = MotionPiece;
using Motion = PiecewiseMotion;

/// One straight piece without acceleration, from 0 to `end_ns`.
Motion Straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v, std::int64_t end_ns);

struct WanderOptions {
  double half_side = 50;        ///< Of the cube around the origin it keeps turning back to [m].
  double speed = 10;            ///< Above, it brakes [m/s].
  double acceleration_max = 5;  ///< Honoured with a margin of 2 % [m/s²].
  double jumps_per_piece = 0;   ///< Probability.
  std::int64_t piece_min_ns = 500'000'000;
  std::int64_t piece_max_ns = 1'500'000'000;
};

/// A random motion until `end_ns`.
Motion Wander(const WanderOptions& options, std::int64_t end_ns, Random* random);

}  // namespace collision::server
