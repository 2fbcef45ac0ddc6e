// Satellites in low orbit whose paths cross.
#pragma once

#include <cstddef>
#include <cstdint>

#include "client/programs/simulators/motion/motion_log.h"

namespace collision::client {

struct ConstellationOptions {
  std::uint64_t seed = 1;
  /// Crossings: satellite i takes part in number i modulo this.
  std::size_t crossings = 10;
  double altitude_m = 780'000;  ///< Of the crossings.
  double spread_m = 40'000;     ///< Radius of the ball in which the satellites of one are at once.
  double seconds = 600;         ///< Of the run; all crossings are within it.
  double step_s = 10;           ///< Of the integrator, at most.
};

/// When the satellites of a crossing are in its ball [s], and where its middle is [m]: anywhere
/// above the Earth, not before a minute and a half of the run nor in its last 20 s.
struct Crossing {
  double seconds = 0;
  Vector3 middle_m{};
};
Crossing CrossingOf(const ConstellationOptions& options, std::size_t number);

/// Where satellite `number` is at the run's start. It flies through its crossing, at a place that
/// is evenly distributed in the ball, horizontally in any direction, and there within 0.1 % as
/// fast as on a circle. So of two satellites of a crossing the one passes the other in any
/// distance, evenly distributed over the area: as many pairs pass within 2 km as uniform traffic
/// would have, and nine times as many within 6 km. The same for every slice of the constellation.
PositionAndVelocity SatelliteAtStart(const ConstellationOptions& options, std::size_t number);

}  // namespace collision::client
