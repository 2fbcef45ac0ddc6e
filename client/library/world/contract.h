// Whether a state need not be sent: the client's side of the contract that the service checks.
#pragma once

#include <optional>

#include "collision/types.h"

namespace collision::client {

/// What an agent's description declares about its motion.
struct MotionBounds {
  double acceleration_max_m_s2 = 0;
  double jerk_max_m_s3 = 0;
  std::optional<double> angular_acceleration_max_rad_s2 = {};
  std::optional<double> speed_max_m_s = {};
  double time_step_s = 0;  ///< 0: the motion is continuous.
  bool turns = false;      ///< It has a shape, so its orientation counts.
};

MotionBounds BoundsOf(const AgentDescription& description);

/// What either allows.
MotionBounds Wider(const MotionBounds& a, const MotionBounds& b);

/// Whether an agent that honours its bounds may come from the one state to the other: false where
/// the service would find a breach. With s the seconds between the two, a the known acceleration, D
/// and J what may be wrong about it and h the time step:
///   |p' − p − v s − ½ a s²| <= ½ D s (s + h) + ⅙ J s³ + errors,
///   |v' − v − a s| <= D s + ½ J s² + errors  and  |a' − a| <= 2 D + J s,
/// the balls of the two states intersect at every instant between them, as the service checks it;
/// likewise orientation and angular velocity of an agent that has a shape; no acceleration against
/// a declared direction, no speed above a declared cap.
///
/// The service allows for an honest sender's rounding; this allows half as much, so an agent that
/// only drifts stays silent, and whatever passes here is no breach at the service
/// (collision_core/motion/contract.h).
bool MayFollow(const MotionBounds& bounds, const State& before, const State& next);

/// Whether `sent`, the last state sent, stands in for `next`: `next` lies within everything that
/// `sent` promises, so a service that knows `sent` alone is not misled. It may follow, and declares
/// nothing new: no error is greater, direction and expiry are the same, and it is no jump.
bool StandsIn(const MotionBounds& bounds, const State& sent, const State& next);

}  // namespace collision::client
