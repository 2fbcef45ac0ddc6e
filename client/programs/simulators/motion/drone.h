// A drone under random forces.
#pragma once

#include <cstdint>
#include <vector>

#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/motion/random.h"

namespace collision::client {

struct DroneLimits {
  Vector3 box_m{200, 200,
                50};  ///< It steers to stay in [0, box] on each axis; a bounce may carry it out.
  double radius_m = 0.5;
  double speed_max_m_s = 15;         ///< Never exceeded by its own forces.
  std::uint64_t places = 5;          ///< Targets of all drones, between which they fly and meet.
  double acceleration_max_m_s2 = 5;  ///< M: never exceeded, |Δv| <= M h also in exact arithmetic.
};

/// Moves in steps with a constant acceleration in each, in closed form: p += v h + ½ a h², v += a
/// h.
class Drone {
 public:
  Drone(const DroneLimits& limits, const Vector3& position_m, std::uint64_t seed);

  /// The motion from `t0_ns` to `t1_ns`, a step of at most 0.1 s.
  MotionPiece Step(std::int64_t t0_ns, std::int64_t t1_ns);

  /// Reflects the velocity at a wall with this normal if the drone moves towards the wall: along
  /// the normal (`side` +1) or against it (-1). Otherwise, or if the normal is zero, returns false
  /// and changes nothing.
  bool Bounce(const Vector3& normal, int side);

  /// Continues from here, after its last step was cut short.
  void SetPosition(const Vector3& position_m) { position_m_ = position_m; }

  /// Likewise, after another kind of bounce.
  void SetVelocity(const Vector3& velocity_m_s) { velocity_m_s_ = velocity_m_s; }

  const Vector3& position_m() const { return position_m_; }
  const Vector3& velocity_m_s() const { return velocity_m_s_; }

 private:
  Vector3 Force(double step);

  DroneLimits limits_;
  SeededRandom random_;
  Vector3 position_m_;
  Vector3 velocity_m_s_{};
  Vector3 target_m_{};
  Vector3 gust_{};
  int steps_left_ = 0;  // until it chooses a new gust and target
};

/// Start positions of `count` drones inside the box, no two nearer than twice their diameter. The
/// first n are the same for every count >= n, so processes that share a seed can take slices.
/// Throws std::runtime_error if the box is too small for them.
std::vector<Vector3> StartPositions(const DroneLimits& limits, std::size_t count,
                                    std::uint64_t seed);

}  // namespace collision::client
