// Manoeuvres of a ship whose engine points one way, and a scripted pilot.
#pragma once

#include <cstdint>

#include "client/programs/simulators/motion/ship.h"

namespace collision::client {

/// The turn rate that brings the heading to a unit `direction` quickly, while half of α suffices to
/// stop turning there.
Vector3 TurnRateTowards(const Ship& ship, const Vector3& direction);

/// Steers towards `velocity_m_s`: turns to the missing velocity, and pushes once the ship points
/// there. Does nothing if less than `tolerance_m_s` is missing.
ShipCommand FlyAt(const Ship& ship, const Vector3& velocity_m_s, double tolerance_m_s);

/// Patrols between places of a box, in an order drawn from a seed. Gives the same commands for the
/// same states and times.
class Autopilot {
 public:
  Autopilot(const Vector3& box_m, std::uint64_t seed);

  /// The command for a step from `t0_ns` on.
  ShipCommand Command(const Ship& ship, std::int64_t t0_ns);

  const Vector3& target_m() const { return target_m_; }

 private:
  void ChooseTarget(std::int64_t t0_ns);

  Vector3 box_m_;
  SeededRandom random_;
  Vector3 target_m_{};
  std::int64_t target_until_ns_ = 0;
};

}  // namespace collision::client
