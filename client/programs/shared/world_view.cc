#include "client/programs/shared/world_view.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "client/library/network/conversion.h"
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

}  // namespace

MessageMonitor::Callbacks WorldView::Callbacks() {
  MessageMonitor::Callbacks callbacks;
  callbacks.status = [this](const v1::ServiceStatus& status) { status_ = status; };
  callbacks.earliest = [this](const v1::EarliestIntersection& earliest) { earliest_ = earliest; };
  callbacks.event = [this](const v1::CollisionEvent& event) {
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

std::vector<AgentView> WorldView::Agents() const {
  std::vector<AgentView> agents;
  for (const auto& entry : descriptions_) {
    const auto& description = entry.second;
    AgentView& agent = agents.emplace_back();
    agent.description = description;
    // A sample of an earlier run, or of an earlier agent in this slot, belongs to another agent.
    const auto take = [&](const auto& samples, auto* to) {
      const auto found = samples.find(entry.first);
      if (found == samples.end() || found->second.first != description.run()) return;
      if (found->second.second.generation() == description.generation()) *to = found->second.second;
    };
    take(states_, &agent.state);
    take(clearances_, &agent.clearance);
    const v1::SimulatorStatus* status = StatusOf(entry.first.first);
    agent.gone = status != nullptr && !status->alive() && status->run() == description.run();
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
  AgentView agent{.gone = true, .description = {}, .state = {}, .clearance = clearance};
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

bool WorldView::knows_all_agents() const { return status_ && Agents().size() >= status_->agents(); }

std::string WorldView::Name(const AgentId& id) const {
  const auto found = names_.find(id);
  if (found != names_.end()) return found->second;
  return SimulatorName(id.simulator) + ":" + std::to_string(id.slot);
}

bool WorldView::IsNamed(const AgentId& id) const { return names_.contains(id); }

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
  std::set<std::tuple<AgentId, AgentId, std::uint32_t>> seen;
  std::vector<v1::CollisionEvent> newest;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    const AgentId lower = FromMessage(event->lower()), higher = FromMessage(event->higher());
    if (seen.emplace(lower, higher, event->contact()).second) newest.push_back(std::move(*event));
  }
  std::reverse(newest.begin(), newest.end());
  return newest;
}

void WorldView::Handle(const v1::AgentDescription& description) {
  names_.try_emplace(
      {description.simulator_id(), description.run(), description.slot(), description.generation()},
      description.agent_name());
  if (names_.size() > kNamesMax) names_.erase(names_.begin());
  const Key first{description.simulator_id(), 0};
  // A simulator that restarts leaves its former agents behind.
  for (auto agent = descriptions_.lower_bound(first);
       agent != descriptions_.end() && agent->first.first == first.first;) {
    agent = agent->second.run() < description.run() ? descriptions_.erase(agent) : std::next(agent);
  }
  std::erase_if(shapes_, [&](const auto& shape) {
    return shape.first.first == description.simulator_id() && shape.second.run < description.run();
  });
  descriptions_[{description.simulator_id(), description.slot()}] = description;
}

void WorldView::Handle(const v1::AgentRemoval& removal) {
  const auto agent = descriptions_.find({removal.simulator_id(), removal.slot()});
  if (agent == descriptions_.end()) return;
  if (agent->second.incarnation() == removal.incarnation()) descriptions_.erase(agent);
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
    states_[{states.simulator_id(), state.slot()}] = {states.run(), state};
  }
}

void WorldView::Handle(const v1::Clearance& clearance) {
  if (clearance.chunk() > wire::kSlotMax / kSlotsPerChunk) return;  // of no service
  // A chunk tells all of its agents: those that it does not name are not there.
  const std::uint32_t first = clearance.chunk() * kSlotsPerChunk;
  clearances_.erase(clearances_.lower_bound({clearance.simulator_id(), first}),
                    clearances_.lower_bound({clearance.simulator_id(), first + kSlotsPerChunk}));
  clearance_stamps_[{clearance.simulator_id(), clearance.chunk()}] = clearance.stamp();
  for (const v1::AgentClearance& agent : clearance.agents()) {
    clearances_[{clearance.simulator_id(), agent.slot()}] = {clearance.run(), agent};
  }
}

std::string WorldView::SimulatorName(std::uint64_t id) const {
  if (status_) {
    for (const v1::SimulatorStatus& simulator : status_->simulators()) {
      if (simulator.simulator_id() == id && !simulator.name().empty()) return simulator.name();
    }
  }
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(id));
  return text;
}

}  // namespace collision::client
