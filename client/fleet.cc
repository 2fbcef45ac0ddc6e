#include "client/fleet.h"

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <utility>

#include "client/conversion.h"
#include "client/validation.h"

namespace collision::client {

Fleet::Fleet(std::string simulator_name, std::uint64_t simulator_id, std::uint32_t run,
             std::uint32_t chunk_size)
    : simulator_name_(std::move(simulator_name)),
      simulator_id_(simulator_id),
      run_(run),
      chunk_size_(chunk_size) {}

AgentId Fleet::Add(const AgentDescription& description, const State& state) {
  const std::uint32_t index = FreeSlot();
  Slot& slot = slots_[index];
  const std::uint32_t generation = slot.description.generation() + 1;
  slot = Slot();
  slot.occupied = true;
  ++agents_;
  const AgentId id{simulator_id_, run_, index, generation};
  Describe(id, description);
  Stage(id, state);
  return id;
}

const v1::AgentDescription& Fleet::description(const AgentId& id) const {
  return slots_.at(id.slot).description;
}

void Fleet::Describe(const AgentId& id, const AgentDescription& description) {
  v1::AgentDescription& current = slots_.at(id.slot).description;
  const std::uint32_t revision = current.revision() + 1;
  current = ToMessage(description);
  current.set_simulator_id(simulator_id_);
  current.set_slot(id.slot);
  current.set_run(run_);
  current.set_generation(id.generation);
  current.set_revision(revision);
  current.set_sequence(++descriptions_sequence_);
  current.set_simulator_name(simulator_name_);
  census_changed_ = true;
}

void Fleet::Stage(const AgentId& id, const State& state) {
  Slot& slot = slots_.at(id.slot);
  if (slot.told && state.stamp_ns < slot.told->stamp_ns()) {
    throw std::invalid_argument("stamp_ns: " + std::to_string(state.stamp_ns) +
                                ", allowed: >= " + std::to_string(slot.told->stamp_ns()) +
                                ", the stamp of the agent's last state");
  }
  if (!slot.staged) staged_slots_.push_back(id.slot);
  const bool jumps = state.discontinuity || (slot.staged && slot.staged->discontinuity());
  slot.staged = ToMessage(state);
  slot.staged->set_discontinuity(jumps);
  slot.staged->set_slot(id.slot);
  slot.staged->set_generation(id.generation);
}

v1::AgentRemoval Fleet::Remove(const AgentId& id) {
  Slot& slot = slots_.at(id.slot);
  if (slot.told) thinned_chunks_.push_back(id.slot / chunk_size_);
  slot.occupied = false;
  slot.told.reset();
  slot.staged.reset();
  std::erase(staged_slots_, id.slot);
  free_slots_.push_back(id.slot);
  std::push_heap(free_slots_.begin(), free_slots_.end(), std::greater<>());
  --agents_;
  census_changed_ = true;
  v1::AgentRemoval removal;
  removal.set_simulator_id(simulator_id_);
  removal.set_slot(id.slot);
  return removal;
}

bool Fleet::Has(const AgentId& id) const {
  return id.simulator == simulator_id_ && id.run == run_ && id.slot < slots_.size() &&
         slots_[id.slot].occupied && slots_[id.slot].description.generation() == id.generation;
}

bool Fleet::HasNews(std::int64_t clock_ns) const {
  const auto due = [&](std::uint32_t slot) { return slots_[slot].staged->stamp_ns() <= clock_ns; };
  return census_changed_ || std::any_of(staged_slots_.begin(), staged_slots_.end(), due);
}

std::vector<v1::AgentDescription> Fleet::Descriptions() const {
  std::vector<v1::AgentDescription> descriptions;
  for (const Slot& slot : slots_) {
    if (slot.occupied) descriptions.push_back(slot.description);
  }
  return descriptions;
}

std::vector<v1::AgentStates> Fleet::Told() const {
  std::vector<v1::AgentStates> chunks;
  for (std::uint32_t chunk = 0; chunk * chunk_size_ < slots_.size(); ++chunk) {
    chunks.push_back(Chunk(chunk));
  }
  return chunks;
}

std::vector<v1::AgentStates> Fleet::Tell(std::int64_t clock_ns) {
  std::set<std::uint32_t> chunks(thinned_chunks_.begin(), thinned_chunks_.end());
  thinned_chunks_.clear();
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t index : staged_slots_) {
    Slot& slot = slots_[index];
    if (slot.staged->stamp_ns() > clock_ns) {
      waiting.push_back(index);
      continue;
    }
    slot.told = std::exchange(slot.staged, std::nullopt);
    slot.told->set_sequence(++states_sequence_);
    if (slot.told->discontinuity()) slot.jump = states_sequence_;
    slot.told->set_discontinuity(slot.jump != 0);
    chunks.insert(index / chunk_size_);
  }
  staged_slots_ = std::move(waiting);
  std::vector<v1::AgentStates> result;
  for (const std::uint32_t chunk : chunks) result.push_back(Chunk(chunk));
  return result;
}

v1::SimulatorClock Fleet::Clock(std::int64_t clock_ns, bool lock_step) {
  census_changed_ = false;
  v1::SimulatorClock clock;
  clock.set_simulator_id(simulator_id_);
  clock.set_run(run_);
  clock.set_simulator_name(simulator_name_);
  clock.set_clock_ns(clock_ns);
  clock.set_states_sequence(states_sequence_);
  clock.set_descriptions_sequence(descriptions_sequence_);
  clock.set_agents(agents_);
  clock.set_lock_step(lock_step);
  return clock;
}

void Fleet::Hear(const v1::AgentClearance& clearance) {
  if (clearance.slot() >= slots_.size()) return;
  Slot& slot = slots_[clearance.slot()];
  if (!slot.occupied || slot.description.generation() != clearance.generation()) return;
  slot.clearance = FromMessage(clearance);
  if (clearance.acknowledged_sequence() >= slot.jump) slot.jump = 0;
}

Clearance Fleet::clearance(const AgentId& id) const { return slots_.at(id.slot).clearance; }

std::uint32_t Fleet::FreeSlot() {
  if (free_slots_.empty()) {
    if (slots_.size() == kAgentsMax)
      throw std::length_error("agents: 65536 are there, no more allowed");
    slots_.emplace_back();
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  std::pop_heap(free_slots_.begin(), free_slots_.end(), std::greater<>());
  const std::uint32_t slot = free_slots_.back();
  free_slots_.pop_back();
  return slot;
}

v1::AgentStates Fleet::Chunk(std::uint32_t chunk) const {
  v1::AgentStates states;
  states.set_simulator_id(simulator_id_);
  states.set_chunk(chunk);
  states.set_run(run_);
  const std::size_t first = std::size_t{chunk} * chunk_size_;
  const std::size_t last = std::min(first + chunk_size_, slots_.size());
  for (std::size_t slot = first; slot < last; ++slot) {
    if (slots_[slot].told) *states.add_states() = *slots_[slot].told;
  }
  return states;
}

}  // namespace collision::client
