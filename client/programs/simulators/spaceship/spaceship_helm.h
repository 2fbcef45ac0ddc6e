// Steering a ship by keys.
#pragma once

#include <string>
#include <vector>

#include "client/programs/simulators/motion/ship.h"

namespace collision::client {

enum class HelmKey {
  kThrust,
  kYawLeft,
  kYawRight,
  kPitchUp,
  kPitchDown,
  kRollLeft,
  kRollRight,
  kSteady,   ///< Engine off, stop turning.
  kBrake,    ///< Turn against the velocity and push until the ship stops.
  kCloser,   ///< Shorter radar range.
  kFarther,  ///< Longer radar range.
  kHelp,
  kQuit
};

/// Removes the keys from what a terminal sent and returns them. The begin of an escape sequence
/// stays until the rest has arrived; other input is skipped.
std::vector<HelmKey> TakeKeys(std::string* typed);

/// One line for each group of keys.
std::vector<std::string> HelmHelp();

/// A terminal reports keys pressed and repeated, but not released: a key counts as held for kHold
/// after it was last reported, which bridges the pause before a keyboard repeats. A turn becomes
/// faster while its key is held.
class Helm {
 public:
  static constexpr double kHold = 0.4;  ///< [s]

  void Press(HelmKey key, double now_s);

  ShipCommand Command(const Ship& ship, double now_s);

  bool quit() const { return quit_; }
  bool help() const { return help_; }
  bool braking() const { return braking_; }
  int zoom() const { return zoom_; }  ///< Steps farther (> 0) or closer.

 private:
  struct Turn {
    double rate = 0;  // signed share of the greatest turn rate
    double until_s = -1;
  };

  void PressTurn(std::size_t axis, int sign, double now_s);

  double thrust_until_s_ = -1;
  std::vector<Turn> turns_ = std::vector<Turn>(3);  // about the body's axes: roll, pitch, yaw
  bool braking_ = false;
  bool quit_ = false;
  bool help_ = false;
  int zoom_ = 0;
};

}  // namespace collision::client
