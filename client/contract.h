// May a state stay untold? The client's side of the contract that the service checks.
#pragma once

#include "client/types.h"

namespace collision::client {

/// What an agent's description says of its motion.
struct MotionBounds {
  double acceleration_max_m_s2 = 0;
  double angular_acceleration_max_rad_s2 = -1;  ///< < 0: not declared.
  double speed_max_m_s = 0;                     ///< 0: not declared.
  double time_step_s = 0;
  bool turns = false;  ///< It has a shape: its orientation counts.
};

MotionBounds BoundsOf(const AgentDescription& description);

/// Whether `next`, told to nobody, lies within everything that `told` promises, so that whoever
/// knows `told` alone is not misled. With s the seconds between the two:
///   |p' − p − v s| <= ½ M s (s + h) + errors  and  |v' − v| <= M s + errors,
/// the two states' balls meet at every instant between them, as the service checks it,
/// likewise the orientation and the angular velocity of an agent that has a shape, no acceleration
/// against a declared direction, no speed above a declared cap; and nothing declared with `next`
/// is other than it was: no error is greater, direction and expiry are the same, nothing jumped.
/// Half of what the service allows an honest sender's rounding is allowed, so that an agent that
/// only drifts stays silent; so whatever passes is no breach at the service
/// (collision_core/motion/contract.h).
bool StandsIn(const MotionBounds& bounds, const State& told, const State& next);

}  // namespace collision::client
