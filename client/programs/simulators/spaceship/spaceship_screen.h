// The pilot's screen: shows the world through a monitor, reads keys from the terminal.
#pragma once

#include <chrono>
#include <deque>
#include <set>
#include <string>

#include "client/library/network/message_monitor.h"
#include "client/programs/shared/terminal.h"
#include "client/programs/shared/world_view.h"
#include "client/programs/simulators/motion/ship.h"
#include "client/programs/simulators/spaceship/spaceship_helm.h"
#include "client/programs/simulators/spaceship/spaceship_panel.h"
#include "collision/pending_names.h"
#include "collision/world.h"

namespace collision::client {

/// Data about the ship that only its own simulator has.
struct OwnShip {
  const Ship* ship = nullptr;
  AgentId id;
  Clearance clearance;
  double thrust = 0;
  std::size_t bounces = 0;
  std::int64_t now_ns = 0;
  std::int64_t start_ns = 0;
};

/// Shows all agents of the world, of any owner. One thread.
class SpaceshipScreen {
 public:
  /// Throws std::runtime_error if there is no terminal or no DDS.
  SpaceshipScreen(const std::string& world, std::uint32_t domain);

  /// Takes in what was typed and what has arrived, without waiting; draws every 80 ms.
  void Update(const OwnShip& own);

  Helm& helm() { return helm_; }

 private:
  using Wall = std::chrono::steady_clock::time_point;

  void TakeEvents(const OwnShip& own);
  SpaceshipPanel Panel(const OwnShip& own) const;
  void AddOthers(const OwnShip& own, SpaceshipPanel* panel) const;
  std::string EarliestText(const OwnShip& own) const;

  Terminal terminal_;
  Helm helm_;
  std::string typed_;
  WorldView view_;
  PendingNames pending_names_;
  std::set<std::pair<std::uint64_t, std::uint32_t>> touching_;  // simulator, slot
  std::deque<std::string> lines_;
  Wall draw_at_;
  MessageMonitor monitor_;  // last: its callbacks use the view
};

}  // namespace collision::client
