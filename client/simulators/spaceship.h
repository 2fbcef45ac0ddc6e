// A spaceship in a world, steered by a person or by a script.
#pragma once

#include <memory>

#include "client/simulators/autopilot.h"
#include "client/simulators/pace.h"
#include "client/simulators/ship.h"
#include "client/simulators/ship_agent.h"
#include "client/simulators/spaceship_screen.h"

namespace collision::client {

struct SpaceshipOptions {
  ShipLimits limits;
  double radius_m = 4.5;               ///< Where there is no shape.
  std::shared_ptr<const Shape> shape;  ///< Null: a ball.
  Vector3 box_m{40, 40, 20};           ///< Where the drones are, from 0 on each axis.
  std::uint64_t seed = 1;              ///< Of the script's patrol.
  double rate_hz = 60;                 ///< Steps of the motion; at least 10.
  std::size_t state_every = 1;         ///< Steps between two states.
};

/// At rest before the box's face at x = 0, at half of its height and width, pointing at it.
RigidState SpaceshipStart(const Vector3& box_m);

/// Flies one ship. A confirmed contact bounces it at its next step, with a state marked as a
/// discontinuity.
class Spaceship {
 public:
  /// Everything outlives it. Without a screen the script flies, and lines are printed.
  Spaceship(const SpaceshipOptions& options, Pace* pace, MotionLog* log, SpaceshipScreen* screen);

  /// To pace.end_ns(), then lingers; or until asked to stop, by a signal or by the person.
  void Fly();

  std::size_t bounces() const { return bounces_; }

 private:
  ShipCommand Ask(std::int64_t t0_ns);
  void StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool state);
  void Tell(std::int64_t stamp_ns, bool discontinuity);
  void PrintBounce(std::int64_t stamp_ns) const;
  bool Quit() const { return screen_ != nullptr && screen_->helm().quit(); }

  SpaceshipOptions options_;
  Pace* pace_;
  SpaceshipScreen* screen_;
  Ship ship_;
  ShipAgent agent_;
  Autopilot autopilot_;
  double thrust_ = 0;  // last commanded
  std::size_t bounces_ = 0;
};

}  // namespace collision::client
