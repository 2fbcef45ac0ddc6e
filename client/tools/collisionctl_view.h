// Everything a monitor has heard of one world, put together.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "client/monitor.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// One agent, as far as known.
struct AgentView {
  v1::AgentDescription description;
  std::optional<v1::AgentState> state;
  std::optional<v1::AgentClearance> clearance;
};

/// One shape of one simulator, as far as its parts have come.
struct ShapeView {
  std::string hash;
  std::string simulator;
  std::uint32_t run = 0;
  std::size_t agents = 0;  ///< Of this simulator that have it.
  std::uint64_t bytes = 0;
  std::uint32_t parts = 0;
  std::set<std::uint32_t> parts_seen;
  std::optional<std::uint32_t> triangles;  ///< As its first part says.
  std::optional<std::uint32_t> solids;     ///< Convex ones; likewise.
};

/// Takes messages in any order and keeps the newest of each kind. The callbacks refer to the view:
/// it must outlive the monitor that has them, and stay where it is.
class WorldView {
 public:
  /// Names kept; beyond, those of the lowest simulator and run go first.
  static constexpr std::size_t kNamesMax = 1'000'000;

  WorldView() = default;
  WorldView(const WorldView&) = delete;
  WorldView& operator=(const WorldView&) = delete;

  Monitor::Callbacks Callbacks();

  const std::optional<v1::ServiceStatus>& status() const { return status_; }
  const std::optional<v1::EarliestIntersection>& earliest() const { return earliest_; }

  /// All described agents, by simulator and slot.
  std::vector<AgentView> Agents() const;

  /// All shapes, by simulator and hash.
  std::vector<ShapeView> Shapes() const;

  /// Does it know every agent that the service says it has?
  bool knows_all_agents() const;

  /// The agent's name, also after it or its simulator has left, as it was described first;
  /// "simulator:slot" if it never was.
  std::string Name(const v1::AgentId& id) const;
  bool IsNamed(const v1::AgentId& id) const;

  /// The events that came since the last call, in the order in which the service said them.
  std::vector<v1::CollisionEvent> TakeEvents();

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;  ///< Simulator, slot.

  void Hear(const v1::AgentDescription& description);
  void Hear(const v1::AgentRemoval& removal);
  void Hear(const v1::ShapePart& part);
  void Hear(const v1::AgentStates& states);
  void Hear(const v1::Clearance& clearance);
  std::string SimulatorName(std::uint64_t id) const;

  std::optional<v1::ServiceStatus> status_;
  std::optional<v1::EarliestIntersection> earliest_;
  std::map<Key, v1::AgentDescription> descriptions_;
  /// By simulator, run, slot and generation; also of agents that left.
  std::map<std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, std::uint32_t>, std::string>
      names_;
  std::map<Key, std::pair<std::uint32_t, v1::AgentState>> states_;          ///< With their run.
  std::map<Key, std::pair<std::uint32_t, v1::AgentClearance>> clearances_;  ///< With their run.
  std::map<std::pair<std::uint64_t, std::string>, ShapeView> shapes_;  ///< By simulator and hash.
  std::vector<v1::CollisionEvent> events_;
};

}  // namespace collision::client
