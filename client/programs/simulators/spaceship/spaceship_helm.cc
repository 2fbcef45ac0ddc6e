#include "client/programs/simulators/spaceship/spaceship_helm.h"

#include <algorithm>
#include <utility>

#include "client/programs/simulators/motion/autopilot.h"

namespace collision::client {
namespace {

constexpr double kFirstTurn = 0.3;  // shares of the greatest turn rate
constexpr double kTurnGrowth = 0.1;
constexpr double kStopped = 0.3;  // [m/s] slower counts as stopped
constexpr int kZoomMax = 6;

const std::vector<std::pair<std::string, HelmKey>>& Keys() {
  static const std::vector<std::pair<std::string, HelmKey>> keys = {
      {"\033[A", HelmKey::kThrust},  {"\033OA", HelmKey::kThrust},   {"\033[B", HelmKey::kSteady},
      {"\033OB", HelmKey::kSteady},  {"\033[C", HelmKey::kYawRight}, {"\033OC", HelmKey::kYawRight},
      {"\033[D", HelmKey::kYawLeft}, {"\033OD", HelmKey::kYawLeft},  {"w", HelmKey::kThrust},
      {"a", HelmKey::kYawLeft},      {"d", HelmKey::kYawRight},      {"r", HelmKey::kPitchUp},
      {"i", HelmKey::kPitchUp},      {"f", HelmKey::kPitchDown},     {"k", HelmKey::kPitchDown},
      {"j", HelmKey::kRollLeft},     {"l", HelmKey::kRollRight},     {"s", HelmKey::kSteady},
      {" ", HelmKey::kSteady},       {"b", HelmKey::kBrake},         {"+", HelmKey::kCloser},
      {"-", HelmKey::kFarther},      {"h", HelmKey::kHelp},          {"?", HelmKey::kHelp},
      {"q", HelmKey::kQuit},         {"Q", HelmKey::kQuit}};
  return keys;
}

// ESC [ parameters letter, or ESC O letter. 0: incomplete.
std::size_t EscapeLength(const std::string& typed) {
  if (typed.size() < 2) return 0;
  if (typed[1] == 'O') return typed.size() < 3 ? 0 : 3;
  if (typed[1] != '[') return 1;
  std::size_t at = 2;
  while (at < typed.size() && static_cast<unsigned char>(typed[at]) < 0x40) ++at;
  return at < typed.size() ? at + 1 : 0;
}

}  // namespace

std::vector<HelmKey> TakeKeys(std::string* typed) {
  std::vector<HelmKey> pressed;
  while (!typed->empty()) {
    const std::size_t length = typed->front() == '\033' ? EscapeLength(*typed) : 1;
    if (length == 0) break;
    const std::string key = typed->substr(0, length);
    const auto found = std::find_if(Keys().begin(), Keys().end(),
                                    [&](const auto& known) { return known.first == key; });
    if (found != Keys().end()) pressed.push_back(found->second);
    typed->erase(0, length);
  }
  return pressed;
}

std::vector<std::string> HelmHelp() {
  return {
      "w ↑ thrust ahead (there is no reverse)   a d ← → yaw   r f, i k pitch up, down   j l roll",
      "s ↓ space: engine off, stop turning      b brake: turn round and thrust until it stops",
      "+ - radar range                          h this help   q end"};
}

void Helm::PressTurn(std::size_t axis, int sign, double now_s) {
  Turn& turn = turns_[axis];
  const bool held = now_s <= turn.until_s && turn.rate * sign > 0;
  turn.rate = sign * (held ? std::min(1.0, std::abs(turn.rate) + kTurnGrowth) : kFirstTurn);
  turn.until_s = now_s + kHold;
}

void Helm::Press(HelmKey key, double now_s) {
  const bool steers = key <= HelmKey::kSteady;
  if (steers) braking_ = false;
  switch (key) {
    case HelmKey::kThrust:
      thrust_until_s_ = now_s + kHold;
      break;
    case HelmKey::kYawLeft:
      PressTurn(2, 1, now_s);
      break;
    case HelmKey::kYawRight:
      PressTurn(2, -1, now_s);
      break;
    // Anticlockwise about +y, the left wing, lowers the nose.
    case HelmKey::kPitchUp:
      PressTurn(1, -1, now_s);
      break;
    case HelmKey::kPitchDown:
      PressTurn(1, 1, now_s);
      break;
    case HelmKey::kRollLeft:
      PressTurn(0, -1, now_s);
      break;
    case HelmKey::kRollRight:
      PressTurn(0, 1, now_s);
      break;
    case HelmKey::kBrake:
    case HelmKey::kSteady:
      thrust_until_s_ = -1;
      for (Turn& turn : turns_) turn = {};
      braking_ = key == HelmKey::kBrake;
      break;
    case HelmKey::kCloser:
      zoom_ = std::max(zoom_ - 1, -kZoomMax);
      break;
    case HelmKey::kFarther:
      zoom_ = std::min(zoom_ + 1, kZoomMax);
      break;
    case HelmKey::kHelp:
      help_ = !help_;
      break;
    case HelmKey::kQuit:
      quit_ = true;
      break;
  }
}

ShipCommand Helm::Command(const Ship& ship, double now_s) {
  if (braking_) {
    if (Norm(ship.state().velocity_m_s) > kStopped) return FlyAt(ship, {}, kStopped);
    braking_ = false;
  }
  ShipCommand command;
  command.thrust = now_s < thrust_until_s_ ? 1 : 0;
  Vector3 rate_B{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (now_s < turns_[axis].until_s) rate_B[axis] = turns_[axis].rate;
  }
  command.turn_rate_rad_s =
      Scaled(Rotated(ship.state().orientation, rate_B), ship.limits().turn.angular_speed_max_rad_s);
  return command;
}

}  // namespace collision::client
