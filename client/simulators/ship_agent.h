// A ship as an agent of the world: what is told of it, and what is written down.
#pragma once

#include <optional>

#include "client/simulators/motion_log.h"
#include "client/simulators/pace.h"
#include "client/simulators/rigid_motion.h"
#include "client/simulators/ship_bounce.h"

namespace collision::client {

/// What the owner of a ship says of its errors. The motion is exact up to rounding, which this is
/// far beyond.
inline constexpr double kShipPositionError = 1e-9;  ///< [m] and, of the velocity, [m/s].
inline constexpr double kShipRotationError = 1e-9;  ///< [rad]

/// Which way the engine pushes; zero: any way.
struct ThrustBound {
  Vector3 direction{};
  std::int64_t until_ns = kNever;
};

class ShipAgent {
 public:
  /// `pace` and `log` outlive it. The radius is the shape's, or that of the description for a ball.
  ShipAgent(const AgentDescription& description, Pace* pace, MotionLog* log);

  /// Stages a state; the first one announces the ship.
  void Tell(const RigidState& state, std::int64_t stamp_ns, bool discontinuity,
            const ThrustBound& thrust);

  void Log(const RigidStep& step);

  void Hear(const Event& event);

  /// Bounces it off everything that it hit since the last call. True: its velocities have changed,
  /// so its next state is a discontinuity; the log knows.
  bool Answer(std::int64_t now_ns, RigidState* state);

  const AgentDescription& description() const { return description_; }

  /// Once it has been announced.
  const std::optional<Agent>& agent() const { return agent_; }

 private:
  AgentDescription description_;
  Pace* pace_;
  MotionLog* log_;
  std::optional<Agent> agent_;
  ContactsToAnswer contacts_;
};

}  // namespace collision::client
