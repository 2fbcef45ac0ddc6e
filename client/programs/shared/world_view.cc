#include "client/programs/shared/world_view.h"

#include <algorithm>
#include <bitset>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "client/library/network/conversion.h"
#include "idl/identity.h"
#include "idl/limits.h"
#include "idl/shape_bytes.h"

namespace collision::client {
namespace {

/// Slots of one clearance sample.
constexpr std::uint32_t kSlotsPerChunk = wire::kStatesPerChunkMax;

/// A little-endian u32 in a shape's bytes.
std::uint32_t NumberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (int i = 3; i >= 0; --i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Whether a list of names in the status, separated by a comma and a blank, has this one.
bool Names(const v1::ServiceStatus& status, const std::string& key, const std::string& name) {
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() != key) continue;
    if ((", " + extension.value() + ",").find(", " + name + ",") != std::string::npos) return true;
  }
  return false;
}

}  // namespace

AgentId IdOf(const AgentView& agent) {
  const v1::AgentDescription& description = agent.description;
  return {description.simulator_id(), description.run(), description.slot(),
          description.generation()};
}

bool IsHeld(const AgentView& agent) {
  return agent.presence == AgentPresence::kHeld || agent.presence == AgentPresence::kSilent ||
         agent.presence == AgentPresence::kWaitedFor;
}

MessageMonitor::Callbacks WorldView::Callbacks() {
  MessageMonitor::Callbacks callbacks;
  callbacks.hello = [this](const v1::ServiceHello& hello) {
    if (hellos_.size() >= kHellosMax) hellos_.clear();
    hellos_[hello.service_id()] = hello;
  };
  callbacks.status = [this](const v1::ServiceStatus& status) {
    status_ = status;
    standbys_.erase(status.service_id());
    for (const v1::SimulatorStatus& simulator : status.simulators()) {
      KeepSimulatorName(simulator.simulator_id(), simulator.name());
    }
  };
  callbacks.standby = [this](const v1::ServiceStatus& status) {
    const auto now = std::chrono::steady_clock::now();
    std::erase_if(standbys_,
                  [now](const auto& one) { return now - one.second.heard > kStandbySilence; });
    if (standbys_.size() >= kStandbysMax && !standbys_.contains(status.service_id())) return;
    standbys_[status.service_id()] = {status, now};
  };
  callbacks.report = [this](const v1::SimulatorReport& report) { Handle(report); };
  callbacks.breach = [this](const v1::AgentBreach& breach) { Handle(breach); };
  callbacks.earliest = [this](const v1::EarliestIntersection& earliest) { earliest_ = earliest; };
  callbacks.event = [this](const v1::CollisionEvent& event) {
    KeepLabel(event.lower(), event.lower_label());
    KeepLabel(event.higher(), event.higher_label());
    events_.push_back(event);
    if (event.contacts_sequence() > 0) ++contacts_;
  };
  callbacks.description = [this](const v1::AgentDescription& message) { Handle(message); };
  callbacks.removal = [this](const v1::AgentRemoval& message) { Handle(message); };
  callbacks.shape_part = [this](const v1::ShapePart& message) { Handle(message); };
  callbacks.shape_removal = [this](const v1::ShapeRemoval& message) {
    std::erase_if(shapes_, [&](const auto& shape) {
      return shape.first.first == message.simulator_id() && shape.second.number == message.shape();
    });
  };
  callbacks.states = [this](const v1::AgentStates& message) { Handle(message); };
  callbacks.clearance = [this](const v1::Clearance& message) { Handle(message); };
  return callbacks;
}

std::int64_t WorldView::skew_max_ns() const {
  if (!status_) return 0;
  const auto found = hellos_.find(status_->service_id());
  return found == hellos_.end() ? 0 : found->second.skew_max_ns();
}

std::optional<std::string> WorldView::HelloExtension(const std::string& key) const {
  if (!status_) return std::nullopt;
  const auto found = hellos_.find(status_->service_id());
  if (found == hellos_.end()) return std::nullopt;
  for (const v1::KeyValue& extension : found->second.extensions()) {
    if (extension.key() == key) return extension.value();
  }
  return std::nullopt;
}

std::vector<v1::ServiceStatus> WorldView::Standbys() const {
  std::vector<v1::ServiceStatus> standbys;
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [id, standby] : standbys_) {
    if (now - standby.heard <= kStandbySilence) standbys.push_back(standby.status);
  }
  return standbys;
}

std::vector<v1::SimulatorReport> WorldView::Refused() const {
  std::vector<v1::SimulatorReport> refused;
  for (const auto& [id, report] : refused_) {
    // Another service judges for itself.
    if (status_ && report.stamp().service_id() == status_->service_id()) refused.push_back(report);
  }
  return refused;
}

std::vector<AgentView> WorldView::Agents() const {
  std::vector<AgentView> agents;
  for (const auto& [key, description] : descriptions_) {
    agents.push_back(Described(key, description));
  }
  for (const auto& [key, clearance] : clearances_) {
    if (!IsHeldOnly(key.first, key.second, clearance.first)) continue;
    agents.push_back(HeldOnly(key.first, clearance.first, clearance.second));
  }
  std::stable_sort(agents.begin(), agents.end(), [](const AgentView& a, const AgentView& b) {
    return Key(a.description.simulator_id(), a.description.slot()) <
           Key(b.description.simulator_id(), b.description.slot());
  });
  return agents;
}

std::optional<AgentView> WorldView::Agent(const AgentId& id) const {
  const Key key{id.simulator, id.slot};
  const auto described = descriptions_.find(key);
  if (described != descriptions_.end() && described->second.run() == id.run) {
    if (described->second.generation() != id.generation) return std::nullopt;
    return Described(key, described->second);
  }
  const auto cleared = clearances_.find(key);
  if (cleared == clearances_.end() || !IsHeldOnly(id.simulator, id.slot, id.run)) {
    return std::nullopt;
  }
  if (cleared->second.second.generation() != id.generation) return std::nullopt;
  return HeldOnly(id.simulator, id.run, cleared->second.second);
}

std::optional<AgentView> WorldView::Newest(std::uint64_t simulator, std::uint32_t slot) const {
  const Key key{simulator, slot};
  const auto described = descriptions_.find(key);
  if (described == descriptions_.end()) return std::nullopt;
  return Described(key, described->second);
}

AgentView WorldView::Described(const Key& key, const v1::AgentDescription& description) const {
  AgentView agent;
  agent.description = description;
  // A sample of an earlier run, or of an earlier agent in this slot, belongs to another agent.
  const auto take = [&](const auto& samples, auto* to) {
    const auto found = samples.find(key);
    if (found == samples.end() || found->second.first != description.run()) return;
    if (found->second.second.generation() == description.generation()) *to = found->second.second;
  };
  take(states_, &agent.state);
  take(clearances_, &agent.clearance);
  const auto breach = breaches_.find(key);
  if (breach != breaches_.end() && breach->second.run() == description.run() &&
      breach->second.generation() == description.generation()) {
    agent.breach = breach->second;
  }
  agent.presence = PresenceOf(description);
  return agent;
}

std::vector<UnknownAgents> WorldView::Unknown() const {
  std::vector<UnknownAgents> unknown;
  if (!status_) return unknown;
  std::map<std::uint64_t, std::size_t> known;
  for (const AgentView& agent : Agents()) {
    if (IsHeld(agent)) ++known[agent.description.simulator_id()];
  }
  for (const v1::SimulatorStatus& simulator : status_->simulators()) {
    const std::size_t listed = known[simulator.simulator_id()];
    if (simulator.alive() || simulator.agents() <= listed) continue;
    unknown.push_back({simulator.name(), simulator.agents() - listed});
  }
  return unknown;
}

AgentPresence WorldView::PresenceOf(const v1::AgentDescription& description) const {
  if (!status_) return AgentPresence::kHeld;
  const v1::SimulatorStatus* status = StatusOf(description.simulator_id());
  if (status != nullptr) {
    if (status->run() > description.run()) return AgentPresence::kNotHeld;
    // A higher run than the service knows is on its way to it.
    const bool silent = !status->alive() && status->run() == description.run();
    return silent ? SilentPresence(status->name()) : AgentPresence::kHeld;
  }
  const std::string& name = description.simulator_name();
  if (Names(*status_, "evicted", name)) return AgentPresence::kEvicted;
  if (Names(*status_, "removed_silent", name)) return AgentPresence::kRemovedSilent;
  // A status names only so many simulators.
  for (const v1::Counter& counter : status_->counters()) {
    const bool is_unlisted = counter.name() == "simulators_unlisted" && counter.value() > 0;
    if (is_unlisted) return AgentPresence::kHeld;
  }
  return AgentPresence::kNotHeld;
}

AgentPresence WorldView::SilentPresence(const std::string& simulator) const {
  const bool waited_for = Names(*status_, "waiting_for", simulator);
  return waited_for ? AgentPresence::kWaitedFor : AgentPresence::kSilent;
}

const v1::SimulatorStatus* WorldView::StatusOf(std::uint64_t simulator) const {
  if (!status_) return nullptr;
  for (const v1::SimulatorStatus& status : status_->simulators()) {
    if (status.simulator_id() == simulator) return &status;
  }
  return nullptr;
}

/// Whether the service holds an agent in the slot in this run, and nobody describes it.
bool WorldView::IsHeldOnly(std::uint64_t simulator, std::uint32_t slot, std::uint32_t run) const {
  const auto described = descriptions_.find({simulator, slot});
  if (described != descriptions_.end() && described->second.run() == run) return false;
  const v1::SimulatorStatus* status = StatusOf(simulator);
  if (status == nullptr || status->alive() || status->run() != run) return false;
  // A sample that an earlier service or epoch left behind tells nothing of now.
  const auto found = clearance_stamps_.find({simulator, slot / kSlotsPerChunk});
  if (found == clearance_stamps_.end()) return false;
  const v1::ServiceStamp& stamp = found->second;
  return stamp.service_id() == status_->service_id() && stamp.term() == status_->stamp().term() &&
         stamp.epoch() == status_->stamp().epoch();
}

AgentView WorldView::HeldOnly(std::uint64_t simulator, std::uint32_t run,
                              const v1::AgentClearance& clearance) const {
  AgentView agent{.presence = SilentPresence(SimulatorName(simulator)),
                  .description = {},
                  .state = {},
                  .clearance = clearance,
                  .breach = {}};
  agent.description.set_simulator_id(simulator);
  agent.description.set_simulator_name(SimulatorName(simulator));
  agent.description.set_run(run);
  agent.description.set_slot(clearance.slot());
  agent.description.set_generation(clearance.generation());
  const AgentId id{simulator, run, clearance.slot(), clearance.generation()};
  if (IsNamed(id)) agent.description.set_agent_name(Name(id));
  return agent;
}

std::vector<ShapeView> WorldView::Shapes() const {
  std::vector<ShapeView> shapes;
  for (const auto& [key, view] : shapes_) {
    ShapeView& shape = shapes.emplace_back(view);
    shape.hash = key.second;
    shape.simulator = SimulatorName(key.first);
    for (const auto& [agent, description] : descriptions_) {
      shape.agents += agent.first == key.first && description.shape_hash() == key.second;
    }
  }
  return shapes;
}

bool WorldView::knows_all_agents() const {
  if (!status_) return false;
  const std::vector<AgentView> agents = Agents();
  const auto held = std::count_if(agents.begin(), agents.end(), IsHeld);
  return static_cast<std::size_t>(held) >= status_->agents();
}

std::string WorldView::Name(const AgentId& id) const {
  const auto found = names_.find(id);
  if (found != names_.end()) return found->second;
  return SimulatorName(id.simulator) + ":" + std::to_string(id.slot);
}

bool WorldView::IsNamed(const AgentId& id) const { return names_.contains(id); }

std::string WorldView::FullName(const AgentId& id) const {
  return IsNamed(id) ? Name(id) + " (" + SimulatorName(id.simulator) + ")" : Name(id);
}

std::vector<v1::CollisionEvent> WorldView::TakeEvents() {
  const auto order = [](const v1::CollisionEvent& event) {
    const v1::ServiceStamp& stamp = event.stamp();
    return std::tuple(stamp.term(), stamp.sequence(), event.now_ns());
  };
  std::stable_sort(events_.begin(), events_.end(),
                   [&](const auto& a, const auto& b) { return order(a) < order(b); });
  return std::exchange(events_, {});
}

std::vector<v1::CollisionEvent> WorldView::TakeNewestRevisions() {
  std::vector<v1::CollisionEvent> events = TakeEvents();
  std::set<std::tuple<AgentId, AgentId, std::string, std::uint32_t>> seen;
  std::vector<v1::CollisionEvent> newest;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    const AgentId lower = FromMessage(event->lower()), higher = FromMessage(event->higher());
    if (seen.emplace(lower, higher, event->level(), event->contact()).second) {
      newest.push_back(std::move(*event));
    }
  }
  std::reverse(newest.begin(), newest.end());
  return newest;
}

void WorldView::KeepSimulatorName(std::uint64_t id, const std::string& name) {
  if (!name.empty() && simulator_names_.size() < kSimulatorNamesMax) {
    simulator_names_.try_emplace(id, name);
  }
}

/// An event may come before the descriptions, or of agents that had left before this monitor came.
void WorldView::KeepLabel(const v1::AgentId& id, const v1::AgentLabel& label) {
  if (label.simulator_name().empty()) return;
  KeepSimulatorName(id.simulator_id(), label.simulator_name());
  names_.try_emplace(FromMessage(id), label.agent_name());
  if (names_.size() > kNamesMax) names_.erase(names_.begin());
}

/// A report outlives its simulator: it names what has left before this monitor came.
void WorldView::Handle(const v1::SimulatorReport& report) {
  KeepSimulatorName(report.simulator_id(), report.name());
  const bool is_refused =
      report.alive() && report.ended() == v1::RUN_GOES_ON && report.refusals_size() > 0;
  if (!is_refused) {
    refused_.erase(report.simulator_id());
  } else if (refused_.size() < kSimulatorNamesMax) {
    refused_.insert_or_assign(report.simulator_id(), report);
  }
}

void WorldView::Handle(const v1::AgentBreach& breach) {
  const Key key{breach.simulator_id(), breach.slot()};
  if (breaches_.size() < kBreachesMax || breaches_.contains(key)) breaches_[key] = breach;
}

void WorldView::Handle(const v1::AgentDescription& description) {
  KeepSimulatorName(description.simulator_id(), description.simulator_name());
  names_.try_emplace(
      {description.simulator_id(), description.run(), description.slot(), description.generation()},
      description.agent_name());
  if (names_.size() > kNamesMax) names_.erase(names_.begin());
  if (description.slot() > wire::kSlotMax) return;  // the service refuses it
  if (newest_runs_.size() >= kSimulatorNamesMax) newest_runs_.clear();
  std::uint32_t& newest = newest_runs_[description.simulator_id()];
  if (description.run() > newest) {
    newest = description.run();
    ForgetFormerRuns(description.simulator_id(), newest);
  }
  descriptions_[{description.simulator_id(), description.slot()}] = description;
}

/// A simulator that restarts leaves its former agents behind.
void WorldView::ForgetFormerRuns(std::uint64_t simulator, std::uint32_t run) {
  auto agent = descriptions_.lower_bound(Key{simulator, 0});
  while (agent != descriptions_.end() && agent->first.first == simulator) {
    agent = agent->second.run() < run ? descriptions_.erase(agent) : std::next(agent);
  }
  std::erase_if(shapes_, [&](const auto& shape) {
    return shape.first.first == simulator && shape.second.run < run;
  });
}

void WorldView::Handle(const v1::AgentRemoval& removal) {
  const auto agent = descriptions_.find({removal.simulator_id(), removal.slot()});
  if (agent == descriptions_.end()) return;
  if (agent->second.incarnation() != removal.incarnation()) return;
  breaches_.erase(agent->first);
  descriptions_.erase(agent);
}

void WorldView::Handle(const v1::ShapePart& part) {
  ShapeView& shape = shapes_[{part.simulator_id(), part.content_hash()}];
  shape.run = std::max(shape.run, part.run());
  shape.number = part.shape();
  shape.bytes = part.total_bytes();
  shape.parts = part.parts();
  shape.parts_seen.insert(part.part());
  if (part.part() != 0 || part.bytes().size() < kShapeHeaderBytes) return;
  // idl/shape_bytes.h: the format, whose last byte is the version; vertices, triangles, solids.
  constexpr std::size_t kVersionAt = 7, kTrianglesAt = 12, kSolidsAt = 16;
  const bool has_solids = part.bytes()[kVersionAt] >= 2;
  if (has_solids && part.bytes().size() < kShapeHeaderBytes + kSolidHeaderBytes) return;
  shape.triangles = NumberAt(part.bytes(), kTrianglesAt);
  shape.solids = has_solids ? NumberAt(part.bytes(), kSolidsAt) : 0;
}

void WorldView::Handle(const v1::AgentStates& states) {
  for (const v1::AgentState& state : states.states()) {
    if (state.slot() > wire::kSlotMax) continue;
    auto& [run, kept] = states_[{states.simulator_id(), state.slot()}];
    run = states.run();
    kept = state;
  }
}

void WorldView::Handle(const v1::Clearance& clearance) {
  if (clearance.chunk() > wire::kSlotMax / kSlotsPerChunk) return;  // of no service
  // A chunk tells all of its agents: those that it does not name are not there.
  const std::uint32_t first = clearance.chunk() * kSlotsPerChunk;
  std::bitset<kSlotsPerChunk> named;
  for (const v1::AgentClearance& agent : clearance.agents()) {
    if (agent.slot() < first || agent.slot() - first >= kSlotsPerChunk) continue;
    named.set(agent.slot() - first);
    // In place: many come, and nearly all are of agents that are known.
    auto& [run, kept] = clearances_[{clearance.simulator_id(), agent.slot()}];
    run = clearance.run();
    kept = agent;
  }
  auto next = clearances_.lower_bound({clearance.simulator_id(), first});
  const auto end = clearances_.lower_bound({clearance.simulator_id(), first + kSlotsPerChunk});
  while (next != end) {
    const bool is_named = named.test(next->first.second - first);
    next = is_named ? std::next(next) : clearances_.erase(next);
  }
  clearance_stamps_[{clearance.simulator_id(), clearance.chunk()}] = clearance.stamp();
}

std::string WorldView::SimulatorName(std::uint64_t id) const {
  const v1::SimulatorStatus* status = StatusOf(id);
  if (status != nullptr && !status->name().empty()) return status->name();
  const auto kept = simulator_names_.find(id);
  if (kept != simulator_names_.end()) return kept->second;
  return IdText(id);
}

}  // namespace collision::client
