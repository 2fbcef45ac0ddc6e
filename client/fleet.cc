#include "client/fleet.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "client/conversion.h"
#include "client/validation.h"

namespace collision::client {
namespace {

/// Who sets states more rarely has every state told that is wanted within this time [ns]: an hour.
constexpr std::uint64_t kPeriodMax = 3'600'000'000'000;

/// On the wire, as idl/README.md has it.
constexpr std::uint64_t kSampleBytes = 20, kStateBytes = 200;

}  // namespace

Fleet::Fleet(std::string simulator_name, std::uint64_t simulator_id, std::uint32_t run,
             const Telling& telling)
    : simulator_name_(std::move(simulator_name)),
      simulator_id_(simulator_id),
      run_(run),
      telling_(telling) {}

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
  slots_.at(id.slot).bounds = BoundsOf(description);
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
  if (slot.told && state.stamp_ns < slot.told->stamp_ns) {
    throw std::invalid_argument("stamp_ns: " + std::to_string(state.stamp_ns) +
                                ", allowed: >= " + std::to_string(slot.told->stamp_ns) +
                                ", the stamp of the agent's last state");
  }
  ++traffic_.states_set;
  if (!slot.staged) staged_slots_.push_back(id.slot);
  const std::optional<State>& before = slot.staged ? slot.staged : slot.told;
  if (before && state.stamp_ns > before->stamp_ns) {
    // Of two stamps the difference fits only in an unsigned number.
    slot.period_ns = static_cast<std::int64_t>(std::min(
        kPeriodMax,
        static_cast<std::uint64_t>(state.stamp_ns) - static_cast<std::uint64_t>(before->stamp_ns)));
  }
  const bool jumps = state.discontinuity || (slot.staged && slot.staged->discontinuity);
  slot.staged = state;
  slot.staged->discontinuity = jumps;
  slot.stands_in =
      telling_.on_demand && slot.told && StandsIn(slot.bounds, *slot.told, *slot.staged);
}

v1::AgentRemoval Fleet::Remove(const AgentId& id) {
  Slot& slot = slots_.at(id.slot);
  if (slot.told) thinned_chunks_.push_back(id.slot / telling_.chunk_size);
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

/// The last chance to tell it in time: its next state comes a period later, or nobody knows when.
bool Fleet::IsDue(const Slot& slot, std::int64_t clock_ns) const {
  const std::int64_t stamp_ns = slot.staged->stamp_ns;
  if (stamp_ns > clock_ns) return false;
  // What had to be told must also have been taken: a refused jump or breach would mislead everybody.
  if (IsOwed(slot) || slot.owed > slot.acknowledged || slot.wanted_always) return true;
  const std::int64_t next_ns = std::max(clock_ns, stamp_ns + slot.period_ns);
  std::int64_t wanted_ns = slot.clearance.state_wanted_ns;
  // What was wanted is on its way, and the answer to it says when the next one is. Whoever runs ahead
  // of the answer does as the service would: the clearance is no earlier than it was.
  if (slot.acknowledged < slot.told_sequence) {
    wanted_ns = std::midpoint(slot.told->stamp_ns, slot.clearance.clear_until_ns);
  }
  return wanted_ns - telling_.lead_ns < next_ns;
}

bool Fleet::HasNews(std::int64_t clock_ns) const {
  const auto due = [&](std::uint32_t slot) { return IsDue(slots_[slot], clock_ns); };
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
  for (std::uint32_t chunk = 0; chunk * telling_.chunk_size < slots_.size(); ++chunk) {
    v1::AgentStates states = Chunk(chunk);
    if (states.states_size() > 0) chunks.push_back(std::move(states));
  }
  return chunks;
}

bool Fleet::IsOwed(const Slot& slot) {
  return !slot.stands_in || slot.told_revision != slot.description.revision();
}

void Fleet::TellStaged(Slot* slot) {
  if (IsOwed(*slot)) slot->owed = states_sequence_ + 1;
  slot->told = std::exchange(slot->staged, std::nullopt);
  slot->told_sequence = ++states_sequence_;
  slot->told_revision = slot->description.revision();
  if (slot->told->discontinuity) slot->jump = states_sequence_;
  slot->told->discontinuity = slot->jump != 0;
}

std::vector<v1::AgentStates> Fleet::Tell(std::int64_t clock_ns) {
  std::vector<std::uint32_t> chunks = std::exchange(thinned_chunks_, {});
  std::size_t waiting = 0;
  for (const std::uint32_t index : staged_slots_) {
    if (IsDue(slots_[index], clock_ns)) {
      TellStaged(&slots_[index]);
      ++traffic_.states_sent;
      chunks.push_back(index / telling_.chunk_size);
    } else {
      staged_slots_[waiting++] = index;
    }
  }
  staged_slots_.resize(waiting);
  std::sort(chunks.begin(), chunks.end());
  chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
  traffic_.samples_sent += chunks.size();
  std::vector<v1::AgentStates> result;
  result.reserve(chunks.size());
  for (const std::uint32_t chunk : chunks) {
    result.push_back(Chunk(chunk));
    traffic_.bytes_sent +=
        kSampleBytes + kStateBytes * static_cast<std::uint64_t>(result.back().states_size());
  }
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

void Fleet::Hear(const v1::AgentClearance& clearance, std::int64_t now_ns) {
  if (clearance.slot() >= slots_.size()) return;
  Slot& slot = slots_[clearance.slot()];
  if (!slot.occupied || slot.description.generation() != clearance.generation()) return;
  slot.clearance = FromMessage(clearance);
  slot.wanted_always = clearance.state_wanted_ns() <= now_ns;
  slot.acknowledged = clearance.acknowledged_sequence();
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

v1::AgentState Fleet::Message(std::uint32_t slot) const {
  v1::AgentState message = ToMessage(*slots_[slot].told);
  message.set_slot(slot);
  message.set_generation(slots_[slot].description.generation());
  message.set_sequence(slots_[slot].told_sequence);
  return message;
}

v1::AgentStates Fleet::Chunk(std::uint32_t chunk) const {
  v1::AgentStates states;
  states.set_simulator_id(simulator_id_);
  states.set_chunk(chunk);
  states.set_run(run_);
  const std::size_t first = std::size_t{chunk} * telling_.chunk_size;
  const std::size_t last = std::min(first + telling_.chunk_size, slots_.size());
  for (std::size_t slot = first; slot < last; ++slot) {
    if (slots_[slot].told) *states.add_states() = Message(static_cast<std::uint32_t>(slot));
  }
  return states;
}

}  // namespace collision::client
