// A ship as an agent of the world: what is published, and what is logged.
#pragma once

#include <optional>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/motion/rigid_motion.h"
#include "client/programs/simulators/motion/ship_bounce.h"

namespace collision::client {

/// Declared errors of a ship's state. The motion is exact up to rounding, which is far smaller.
inline constexpr double kShipPositionError = 1e-9;  ///< [m] and, of the velocity, [m/s].
inline constexpr double kShipRotationError = 1e-9;  ///< [rad]

/// The direction in which the engine pushes; zero: any.
struct ThrustBound {
  Vector3 direction{};
  std::int64_t until_ns = kNever;
};

class ShipAgent {
 public:
  /// `pace` and `log` must outlive it. The radius is the shape's, or for a ball the description's.
  ShipAgent(const AgentDescription& description, Pace* pace, MotionLog* log);

  /// Stages a state; the first one announces the ship.
  void SetState(const RigidState& state, std::int64_t stamp_ns, bool discontinuity,
                const ThrustBound& thrust);

  void Log(const RigidStep& step);

  void Handle(const Event& event);

  /// Bounces the ship off everything that it hit since the last call. True: its velocities have
  /// changed, so its next state is a discontinuity; the log has recorded it.
  bool Answer(std::int64_t now_ns, RigidState* state);

  const AgentDescription& description() const { return description_; }

  /// Set once the ship has been announced.
  const std::optional<Agent>& agent() const { return agent_; }

 private:
  AgentDescription description_;
  Pace* pace_;
  MotionLog* log_;
  std::optional<Agent> agent_;
  ContactsToAnswer contacts_;
};

}  // namespace collision::client
