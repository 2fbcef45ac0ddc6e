// The state of a world as a monitor has received it.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/library/network/message_monitor.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Whether the service holds an agent, as its newest status says, and why not, or why nothing more
/// is told of it: the bounds of an agent whose simulator is not heard only grow.
enum class AgentPresence {
  kHeld,
  kSilent,         ///< Held; its simulator is not heard.
  kWaitedFor,      ///< Likewise, and the world's time waits for its simulator.
  kNotHeld,        ///< Described, but the service knows no such run of its simulator.
  kEvicted,        ///< Not held: an operator removed its simulator.
  kRemovedSilent,  ///< Not held: its simulator was silent for too long.
};

/// Agents that the service holds of a simulator that is not heard, of which nothing has come.
struct UnknownAgents {
  std::string simulator;
  std::size_t agents = 0;
};

/// One agent, as far as it is known.
struct AgentView {
  AgentPresence presence = AgentPresence::kHeld;
  /// Of one that was never described to this monitor: no more than its identity.
  v1::AgentDescription description;
  std::optional<v1::AgentState> state;
  std::optional<v1::AgentClearance> clearance;
  std::optional<v1::AgentBreach> breach;  ///< The newest; nullopt: none was told.
};

AgentId IdOf(const AgentView& agent);

/// Whether the service holds it, so that it counts for others.
bool IsHeld(const AgentView& agent);

/// One shape of one simulator, as far as its parts have arrived.
struct ShapeView {
  std::string hash;
  std::string simulator;
  std::uint32_t number = 0;  ///< Its simulator's number of it.
  std::uint32_t run = 0;
  std::size_t agents = 0;  ///< Agents of this simulator that have it.
  std::uint64_t bytes = 0;
  std::uint32_t parts = 0;
  std::set<std::uint32_t> parts_seen;
  std::optional<std::uint32_t> triangles;  ///< From its first part.
  std::optional<std::uint32_t> solids;     ///< Convex solids, likewise.
};

/// Whether it is the description of an agent: every body has a radius, or is a half-space.
inline bool IsDescribed(const v1::AgentDescription& description) {
  return description.radius_m() > 0 || description.has_half_space();
}

/// Takes messages in any order and keeps the newest of each kind. The callbacks refer to the view,
/// which must outlive the monitor that holds them and must not move.
class WorldView {
 public:
  /// Maximum number of names; beyond it those of the lowest simulator and run are dropped.
  static constexpr std::size_t kNamesMax = 1'000'000;
  /// Maximum number of names of simulators; beyond it no further one is kept.
  static constexpr std::size_t kSimulatorNamesMax = 65536;

  /// The longest period of a status, and a little.
  static constexpr std::chrono::seconds kStandbySilence{11};
  static constexpr std::size_t kHellosMax = 64;       ///< Beyond it all former ones are dropped.
  static constexpr std::size_t kBreachesMax = 65536;  ///< Beyond it no further agent's is kept.
  static constexpr std::size_t kStandbysMax = 16;     ///< Beyond it no further one is kept.

  WorldView() = default;
  WorldView(const WorldView&) = delete;
  WorldView& operator=(const WorldView&) = delete;

  MessageMonitor::Callbacks Callbacks();

  const std::optional<v1::ServiceStatus>& status() const { return status_; }
  const std::optional<v1::EarliestIntersection>& earliest() const { return earliest_; }

  /// κ, the bound on the offset of any clock, as the hello of the service in force says [ns]; 0 if
  /// that has not come.
  std::int64_t skew_max_ns() const;

  /// The extension of the hello of the service in force; nullopt: it has none of this key.
  std::optional<std::string> HelloExtension(const std::string& key) const;

  /// The newest status of each service that stands by and was heard within kStandbySilence.
  std::vector<v1::ServiceStatus> Standbys() const;

  /// What the service in force has of each living simulator of which it refuses something now.
  std::vector<v1::SimulatorReport> Refused() const;

  /// All described agents, and those that the service holds without a living writer, by simulator
  /// and slot.
  std::vector<AgentView> Agents() const;

  /// The agent, if it is one of these.
  std::optional<AgentView> Agent(const AgentId& id) const;

  /// The agent in this slot of this simulator as it was described last; nullopt: it has left, or
  /// was never described.
  std::optional<AgentView> Newest(std::uint64_t simulator, std::uint32_t slot) const;

  /// How many more the service holds of each simulator that is not heard: a simulator that was
  /// granted nothing has no clearances, and so its agents have no identity.
  std::vector<UnknownAgents> Unknown() const;

  /// All shapes, by simulator and hash.
  std::vector<ShapeView> Shapes() const;

  /// Whether it knows as many agents as the service says it has.
  bool knows_all_agents() const;

  /// The agent's name as an event or its first description says, also after it or its simulator has
  /// left; "simulator:slot" if it was never described. A simulator keeps its name likewise.
  std::string Name(const AgentId& id) const;
  bool IsNamed(const AgentId& id) const;

  /// The name with that of its simulator, "ada (people)"; "simulator:slot" if it was never
  /// described.
  std::string FullName(const AgentId& id) const;

  /// The simulator's name, also after it has left; its id in hexadecimal if it was never heard.
  std::string SimulatorName(std::uint64_t id) const;

  /// The events since the last call, in the order in which the service published them.
  std::vector<v1::CollisionEvent> TakeEvents();

  /// Likewise, of each event only the newest revision.
  std::vector<v1::CollisionEvent> TakeNewestRevisions();

  /// Contacts (confirmed, ended, undecided) that have come.
  std::uint64_t contacts() const { return contacts_; }

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;  ///< Simulator, slot.

  void Handle(const v1::SimulatorReport& report);
  void Handle(const v1::AgentBreach& breach);
  void Handle(const v1::AgentDescription& description);
  void Handle(const v1::AgentRemoval& removal);
  void Handle(const v1::ShapePart& part);
  void Handle(const v1::AgentStates& states);
  void Handle(const v1::Clearance& clearance);
  void ForgetFormerRuns(std::uint64_t simulator, std::uint32_t run);
  void KeepLabel(const v1::AgentId& id, const v1::AgentLabel& label);
  void KeepSimulatorName(std::uint64_t id, const std::string& name);
  AgentPresence PresenceOf(const v1::AgentDescription& description) const;
  AgentPresence SilentPresence(const std::string& simulator) const;
  const v1::SimulatorStatus* StatusOf(std::uint64_t simulator) const;
  bool IsHeldOnly(std::uint64_t simulator, std::uint32_t slot, std::uint32_t run) const;
  AgentView Described(const Key& key, const v1::AgentDescription& description) const;
  AgentView HeldOnly(std::uint64_t simulator, std::uint32_t run,
                     const v1::AgentClearance& clearance) const;

  struct Standby {
    v1::ServiceStatus status;
    std::chrono::steady_clock::time_point heard;
  };

  std::optional<v1::ServiceStatus> status_;
  std::map<std::uint64_t, v1::ServiceHello> hellos_;      ///< By service.
  std::map<std::uint64_t, Standby> standbys_;             ///< By service.
  std::map<std::uint64_t, v1::SimulatorReport> refused_;  ///< By simulator.
  std::optional<v1::EarliestIntersection> earliest_;
  std::map<Key, v1::AgentDescription> descriptions_;
  std::map<std::uint64_t, std::uint32_t> newest_runs_;    ///< By simulator, of its descriptions.
  std::map<AgentId, std::string> names_;                  ///< Also of agents that left.
  std::map<std::uint64_t, std::string> simulator_names_;  ///< Likewise, by id.
  std::map<Key, std::pair<std::uint32_t, v1::AgentState>> states_;          ///< With their run.
  std::map<Key, std::pair<std::uint32_t, v1::AgentClearance>> clearances_;  ///< With their run.
  std::map<Key, v1::AgentBreach> breaches_;                            ///< The newest of each slot.
  std::map<Key, v1::ServiceStamp> clearance_stamps_;                   ///< By simulator and chunk.
  std::map<std::pair<std::uint64_t, std::string>, ShapeView> shapes_;  ///< By simulator and hash.
  std::vector<v1::CollisionEvent> events_;
  std::uint64_t contacts_ = 0;
};

}  // namespace collision::client
