// The paper's experiment: cubes under random forces, until the first two overlap.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/baselines/ball_scene.h"

namespace collision::baselines {

/// Which two overlap; lower < higher.
using CubePair = std::pair<std::uint32_t, std::uint32_t>;

/// Equal cubes, their faces along the axes always, seen once a frame. In each frame a new random
/// force acts on each; no acceleration exceeds M. A method that detects collisions sees no more
/// than the states at the present frame. Source: Hubbard, "Collision detection for interactive
/// graphics applications", IEEE TVCG 1(3), 1995, section 6.
class MovingCubes {
 public:
  struct Options {
    std::uint32_t count = 100;
    double density = 0.01;  ///< The part of the region's volume that the cubes fill at the start.
    double speed_max = 2;   ///< Along each axis, at the start [m/s].
    double acceleration_max = 2;  ///< M [m/s²]
    std::uint64_t seed = 1;
  };
  static constexpr double kSide = 1;  ///< [m]
  /// From one frame to the next: 60 Hz, in whole nanoseconds.
  static constexpr std::int64_t kFrameNs = 16'666'667;
  static constexpr double kFrame = kFrameNs * 1e-9;

  /// No two overlap at the start.
  explicit MovingCubes(const Options& options);

  void NextFrame();

  std::uint32_t count() const { return static_cast<std::uint32_t>(p_WA_.size()); }
  std::int64_t frame() const { return frame_; }
  /// The time of the present frame, after the start [s].
  double time() const { return static_cast<double>(frame_) * kFrame; }

  const Eigen::Vector3d& position(std::uint32_t cube) const { return p_WA_[cube]; }
  const Eigen::Vector3d& velocity(std::uint32_t cube) const { return v_WA_[cube]; }

  /// The ball around a cube with its motion, as of the present frame.
  BallAgent Ball(std::uint32_t cube) const;

  /// Whether two overlap in the present frame (faces that touch do).
  bool Overlap(std::uint32_t a, std::uint32_t b) const {
    return (p_WA_[a] - p_WA_[b]).cwiseAbs().maxCoeff() <= kSide;
  }

 private:
  Options options_;
  std::int64_t frame_ = 0;
  std::vector<Eigen::Vector3d> p_WA_, v_WA_;
};

}  // namespace collision::baselines
