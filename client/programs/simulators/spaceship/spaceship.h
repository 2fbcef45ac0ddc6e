// A spaceship, steered by a person or by a script.
#pragma once

#include <memory>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/autopilot.h"
#include "client/programs/simulators/motion/ship.h"
#include "client/programs/simulators/motion/ship_agent.h"
#include "client/programs/simulators/spaceship/spaceship_screen.h"

namespace collision::client {

struct SpaceshipOptions {
  ShipLimits limits;
  double radius_m = 4.5;               ///< Without a shape.
  std::shared_ptr<const Shape> shape;  ///< Null: a ball.
  Vector3 box_m{40, 40, 20};           ///< The drones' box, from 0 on each axis.
  std::uint64_t seed = 1;              ///< Of the script's patrol.
  double rate_hz = 60;                 ///< Steps of the motion; at least 10.
  std::size_t state_every = 1;         ///< Steps between two states.
};

/// At rest in front of the middle of the box's face at x = 0, pointing at it.
RigidState SpaceshipStart(const Vector3& box_m);

/// Flies one ship. A confirmed contact bounces it at its next step, with a state marked as a
/// discontinuity.
class Spaceship {
 public:
  /// All arguments must outlive it. Without a screen the script flies, and lines are printed.
  Spaceship(const SpaceshipOptions& options, Pace* pace, MotionLog* log, SpaceshipScreen* screen);

  /// Flies to pace.end_ns(), then lingers; or until asked to stop by a signal or by the person.
  void Fly();

  std::size_t bounces() const { return bounces_; }

 private:
  ShipCommand Ask(std::int64_t t0_ns);
  void StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool state);
  void SetState(std::int64_t stamp_ns, bool discontinuity);
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
