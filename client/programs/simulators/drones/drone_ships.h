// Drone ships: bodies under random forces and torques that bounce off what they hit.
#pragma once

#include <memory>
#include <vector>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/drone.h"
#include "client/programs/simulators/motion/ship_agent.h"

namespace collision::client {

struct DroneShipOptions {
  DroneLimits limits;                  ///< The radius counts without a shape.
  TurnLimits turn;                     ///< α and the greatest turn rate.
  std::shared_ptr<const Shape> shape;  ///< Null: balls.
  std::size_t drones = 20;
  std::size_t first = 0;  ///< Number of the first: slices of one swarm in several processes.
  std::uint64_t seed = 1;
  double rate_hz = 60;          ///< Steps of the motion; at least 10.
  std::size_t state_every = 1;  ///< Steps between two states of a drone.
};

/// A box in which this many drones of 2 m meet now and then: 8000 m³ each, half as high as wide.
Vector3 BoxFor(std::size_t drones);

/// The number of places where they meet in that box, so that any number of drones is as crowded.
std::uint64_t PlacesFor(std::size_t drones);

/// A ship with thrusters all round: any acceleration up to M, any angular acceleration up to α.
class DroneShip {
 public:
  DroneShip(const DroneLimits& limits, const TurnLimits& turn, const Vector3& position_m,
            std::uint64_t seed);

  /// A step of at most kRigidStepMax under random forces and torques.
  RigidStep Step(std::int64_t t0_ns, std::int64_t t1_ns);

  const RigidState& state() const { return state_; }

  /// After a bounce.
  void SetVelocities(const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s);

 private:
  Drone drone_;  // the motion of its centre
  TurnLimits turn_;
  SeededRandom random_;
  RigidState state_;
  Vector3 turn_wanted_{};
  int steps_left_ = 0;  // until it chooses another turn rate
};

/// Flies the drones of one process.
class DroneShips {
 public:
  /// `pace` and `log` must outlive it. Throws std::runtime_error if the drones do not fit into the
  /// box.
  DroneShips(const DroneShipOptions& options, Pace* pace, MotionLog* log);

  /// Flies to pace.end_ns(), or until asked to stop; then lingers.
  void Fly();

  std::size_t bounces() const { return bounces_; }

 private:
  struct Member {
    DroneShip ship;
    ShipAgent agent;
  };

  void StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states);

  DroneShipOptions options_;
  Pace* pace_;
  std::vector<Member> members_;
  std::size_t bounces_ = 0;
};

}  // namespace collision::client
