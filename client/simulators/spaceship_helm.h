// What a person's keys do to a ship.
#pragma once

#include <string>
#include <vector>

#include "client/simulators/ship.h"

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
  kBrake,    ///< Turn against the velocity and push until the ship stands.
  kCloser,   ///< The radar shows less, or
  kFarther,  ///< more.
  kHelp,
  kQuit
};

/// The keys in what a terminal sent, and removes them from it; the beginning of an escape sequence
/// stays until the rest has come. What is no key of ours is skipped.
std::vector<HelmKey> TakeKeys(std::string* typed);

/// One line for each group of keys.
std::vector<std::string> HelmHelp();

/// A terminal tells of keys pressed and repeated, not of keys released: a key holds for kHold after
/// it was last heard, which bridges the pause before a keyboard repeats. A turn grows faster while
/// its key is held.
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
