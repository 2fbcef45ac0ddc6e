// Flying a ship whose engine points one way: the moves that pilots share, and a pilot by script.
#pragma once

#include <cstdint>

#include "client/simulators/ship.h"

namespace collision::client {

/// The turn rate that brings the heading to a unit `direction` soon, and lets the ship stop turning
/// there with half of α.
Vector3 TurnRateTowards(const Ship& ship, const Vector3& direction);

/// Comes to `velocity_m_s`: turns to what is lacking, and pushes once it points there. What is
/// lacking by less than `tolerance_m_s` is let be.
ShipCommand FlyAt(const Ship& ship, const Vector3& velocity_m_s, double tolerance_m_s);

/// Patrols between places of a box, in an order drawn from a seed. The same commands for the same
/// states and times.
class Autopilot {
 public:
  Autopilot(const Vector3& box_m, std::uint64_t seed);

  /// For a step from `t0_ns` on.
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
