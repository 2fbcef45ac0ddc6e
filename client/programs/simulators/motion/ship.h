// A ship whose engine points one way.
#pragma once

#include <cstdint>

#include "client/programs/simulators/motion/rigid_motion.h"

namespace collision::client {

struct ShipLimits {
  double acceleration_max_m_s2 = 6;  ///< M: of the engine, never exceeded.
  double speed_max_m_s = 15;         ///< The engine stops accelerating the ship there.
  TurnLimits turn;
};

/// A pilot's command for one step.
struct ShipCommand {
  double thrust = 0;          ///< Share of the engine's power in [0, 1]; there is no reverse.
  Vector3 turn_rate_rad_s{};  ///< Wanted ω, in W.
};

/// A ship whose engine pushes along the body's +x axis only, so it stops by turning round. Within a
/// step the acceleration is constant, along the heading at the begin of the step.
class Ship {
 public:
  Ship(const ShipLimits& limits, const RigidState& state) : limits_(limits), state_(state) {}

  /// A step of at most kRigidStepMax.
  RigidStep Step(const ShipCommand& command, std::int64_t t0_ns, std::int64_t t1_ns);

  const ShipLimits& limits() const { return limits_; }
  const RigidState& state() const { return state_; }

  /// Where it points: the unit vector d with acceleration·d >= 0.
  Vector3 heading() const;

  /// How long acceleration·heading() >= 0 holds from now on [ns], rounded down: until then every
  /// heading is less than a quarter turn from this one, and every acceleration is along the heading
  /// at the begin of its step.
  std::int64_t HeadingHoldsFor() const;

  /// After a bounce.
  void SetVelocities(const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s);

 private:
  double ThrustWithinSpeed(double thrust, double step) const;

  ShipLimits limits_;
  RigidState state_;
};

}  // namespace collision::client
