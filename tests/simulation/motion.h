// Exact motion of the simulated agents: what really happens, which the service never sees whole.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tests/support/random.h"

namespace collision::server {

/// p + v τ + ½ a τ² on [start, end), τ in seconds since start.
struct Piece {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();

  /// The same motion from a later instant on.
  Piece From(std::int64_t t_ns) const;
};

/// Pieces that follow each other; where a piece starts elsewhere than the last one ended, the
/// motion jumps.
struct Motion {
  std::vector<Piece> pieces;
  std::vector<std::int64_t> jumps_ns;

  const Piece& At(std::int64_t t_ns) const;
};

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

/// When the centres are nearer than `reach`, over [from, to], seconds since `from`; worked out with
/// polynomials in plain doubles: good to about 1e-9 s where the contact is not grazing.
struct Meeting {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  double depth = 0;              ///< Greatest overlap [m].
  bool begins_in_motion = true;  ///< Not at `from_ns` and not by a jump.
  bool ends_in_motion = true;    ///< Not at `to_ns` and not by a jump.
};
std::vector<Meeting> Meetings(const Motion& a, const Motion& b, double reach, std::int64_t from_ns,
                              std::int64_t to_ns);

}  // namespace collision::server
