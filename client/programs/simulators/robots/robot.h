// A robot: a serial chain of links whose joints turn while its base moves.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "client/programs/simulators/motion/drone.h"
#include "client/programs/simulators/motion/rigid_motion.h"

namespace collision::client {

struct RobotLimits {
  DroneLimits base;            ///< Of the first joint, which flies as a drone does.
  TurnLimits turn{2, 1};       ///< Of each link about its joint.
  std::size_t links = 7;       ///< 1 to 100.
  double link_length_m = 0.5;  ///< From joint to joint.
  double link_thickness_m = 0.12;

  /// From the first joint to the far end of the last link.
  double reach_m() const { return static_cast<double>(links) * link_length_m + link_thickness_m; }
};

/// The shape of a link about its middle, along its x axis: a box where `link` is even, else a
/// capsule. It reaches over both joints by half its thickness, so that neighbours overlap.
std::shared_ptr<const Shape> LinkShape(const RobotLimits& limits, std::size_t link);

/// The greatest acceleration of the middle of a link. A joint adds at most L √(α² + ω⁴) to what
/// lies beyond it.
double LinkAccelerationMax(const RobotLimits& limits, std::size_t link);

/// Links turn in one plane, which has any orientation and keeps it, each with a constant angular
/// acceleration in a step. The middle of a link moves on the cubic that agrees with the chain in
/// position and velocity at both ends of the step.
class Robot {
 public:
  Robot(const RobotLimits& limits, const Vector3& position_m, std::uint64_t seed);

  /// A step of at most 0.05 s: one motion for each link.
  std::vector<RigidStep> Step(std::int64_t t0_ns, std::int64_t t1_ns);

  /// Of each link, at the end of the last step.
  const std::vector<RigidState>& states() const { return states_; }

 private:
  struct Joint {
    double angle = 0;  ///< Of its link, in the plane [rad].
    double speed = 0;
    double speed_wanted = 0;
    int steps_left = 0;  ///< Until it chooses another speed.
  };

  double TurnOf(Joint* joint, double step);
  std::vector<RigidState> Chain() const;

  RobotLimits limits_;
  SeededRandom random_;
  Drone base_;
  Quaternion plane_;
  std::vector<Joint> joints_;
  std::vector<RigidState> states_;
};

}  // namespace collision::client
