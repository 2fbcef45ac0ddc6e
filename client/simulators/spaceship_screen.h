// The pilot's screen: the world through a monitor, the keys from the terminal.
#pragma once

#include <chrono>
#include <deque>
#include <set>
#include <string>

#include "client/event_hold.h"
#include "client/monitor.h"
#include "client/simulators/ship.h"
#include "client/simulators/spaceship_helm.h"
#include "client/simulators/spaceship_panel.h"
#include "client/simulators/terminal.h"
#include "client/tools/collisionctl_view.h"
#include "client/world.h"

namespace collision::client {

/// What only the ship's own simulator knows.
struct OwnShip {
  const Ship* ship = nullptr;
  AgentId id;
  Clearance clearance;
  double thrust = 0;
  std::size_t bounces = 0;
  std::int64_t now_ns = 0;
  std::int64_t start_ns = 0;
};

/// Shows all agents of the world, whoever owns them. One thread.
class SpaceshipScreen {
 public:
  /// Throws std::runtime_error if there is no terminal or no DDS.
  SpaceshipScreen(const std::string& world, std::uint32_t domain);

  /// Takes what was typed and what arrived, without waiting, and draws now and then.
  void Update(const OwnShip& own);

  Helm& helm() { return helm_; }

 private:
  using Wall = std::chrono::steady_clock::time_point;

  void Hear(const OwnShip& own);
  SpaceshipPanel Panel(const OwnShip& own) const;
  void AddOthers(const OwnShip& own, SpaceshipPanel* panel) const;
  std::string EarliestText(const OwnShip& own) const;

  Terminal terminal_;
  Helm helm_;
  std::string typed_;
  WorldView view_;
  EventHold hold_;
  std::set<std::pair<std::uint64_t, std::uint32_t>> touching_;  // simulator, slot
  std::deque<std::string> lines_;
  Wall draw_at_;
  Monitor monitor_;  // last: its callbacks use the view
};

}  // namespace collision::client
