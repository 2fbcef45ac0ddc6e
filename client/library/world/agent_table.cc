#include "client/library/world/agent_table.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "client/library/network/conversion.h"
#include "client/library/validation.h"

namespace collision::client {
namespace {

/// Bytes on the wire, as idl/PROTOCOL.md has them.
constexpr std::uint64_t kSampleBytes = 20, kStateBytes = 200;

}  // namespace

AgentTable::AgentTable(std::string simulator_name, std::uint64_t simulator_id, std::uint32_t run,
                       std::uint32_t incarnation, const PublishPolicy& policy)
    : simulator_name_(std::move(simulator_name)),
      simulator_id_(simulator_id),
      run_(run),
      incarnation_(incarnation),
      policy_(policy) {}

void AgentTable::SetRun(std::uint32_t run) {
  run_ = run;
  for (Slot& slot : slots_) slot.description.set_run(run);
}

AgentId AgentTable::Add(const AgentDescription& description, const State& state) {
  const std::uint32_t index = FreeSlot();
  Slot& slot = slots_[index];
  const std::uint32_t generation = slot.description.generation() + 1;
  slot = Slot();
  slot.occupied = true;
  ++agent_count_;
  const AgentId id{simulator_id_, run_, index, generation};
  Describe(id, description);
  Stage(id, state);
  return id;
}

const v1::AgentDescription& AgentTable::description(const AgentId& id) const {
  return slots_.at(id.slot).description;
}

void AgentTable::Describe(const AgentId& id, const AgentDescription& description) {
  Slot& slot = slots_.at(id.slot);
  const MotionBounds bounds = BoundsOf(description);
  // The next state was reached as was declared before.
  const bool is_first = slot.description.revision() == 0;
  slot.bounds_to_next = is_first ? bounds : Wider(slot.bounds_to_next, bounds);
  slot.bounds = bounds;
  v1::AgentDescription& current = slot.description;
  const std::uint32_t revision = current.revision() + 1;
  current = ToMessage(description);
  current.set_simulator_id(simulator_id_);
  current.set_slot(id.slot);
  current.set_incarnation(incarnation_);
  current.set_run(run_);
  current.set_generation(id.generation);
  current.set_revision(revision);
  current.set_sequence(++descriptions_sequence_);
  current.set_states_sequence(states_sequence_);
  current.set_simulator_name(simulator_name_);
  census_changed_ = true;
}

std::string AgentTable::NameIn(std::uint32_t slot) const {
  const bool is_there = slot < slots_.size() && slots_[slot].occupied;
  return is_there ? slots_[slot].description.agent_name() : "";
}

void AgentTable::Stage(const AgentId& id, const State& state) {
  Slot& slot = slots_.at(id.slot);
  const bool was_staged = slot.states.staged().has_value();
  slot.states.Stage(state, std::exchange(slot.bounds_to_next, slot.bounds), policy_);
  if (!was_staged && slot.states.staged()) staged_slots_.push_back(id.slot);
  ++traffic_.states_set;
}

std::optional<v1::AgentStates> AgentTable::TakeLast(const AgentId& id) {
  const std::optional<State>& staged = slots_.at(id.slot).states.staged();
  const bool is_known = slots_.at(id.slot).states.sent().has_value();
  if (!policy_.wall_clock || !is_known || !staged || staged->stamp_ns > taken_ns_) {
    return std::nullopt;
  }
  Send(id.slot);
  std::erase(staged_slots_, id.slot);
  return Chunk(id.slot / policy_.chunk_size);
}

v1::AgentRemoval AgentTable::Remove(const AgentId& id) {
  Slot& slot = slots_.at(id.slot);
  slot.occupied = false;
  slot.description.set_sequence(++descriptions_sequence_);
  std::erase(staged_slots_, id.slot);
  if (slot.states.sent()) {
    --stated_;
    removed_slots_.push_back(id.slot);
    if (!policy_.wall_clock) {
      slot.states.StageLast(taken_ns_);
      staged_slots_.push_back(id.slot);
    }
  } else {
    Free(id.slot);
  }
  --agent_count_;
  census_changed_ = true;
  v1::AgentRemoval removal = RemovalOf(id.slot);
  const bool is_known = slot.acknowledged_revision == slot.description.revision();
  if (!is_known) *removal.mutable_description() = slot.description;
  return removal;
}

v1::AgentRemoval AgentTable::RemovalOf(std::uint32_t slot) const {
  v1::AgentRemoval removal;
  removal.set_simulator_id(simulator_id_);
  removal.set_slot(slot);
  removal.set_incarnation(incarnation_);
  removal.set_sequence(slots_[slot].description.sequence());
  return removal;
}

std::vector<std::uint32_t> AgentTable::FreeRemoved() {
  std::vector<std::uint32_t> thinned;  // Chunks.
  for (const std::uint32_t index : std::exchange(leaving_slots_, {})) {
    thinned.push_back(index / policy_.chunk_size);
    Free(index);
  }
  return thinned;
}

void AgentTable::EndRound() {
  const auto unsent =
      std::partition(removed_slots_.begin(), removed_slots_.end(),
                     [&](std::uint32_t slot) { return !slots_[slot].states.staged(); });
  leaving_slots_.insert(leaving_slots_.end(), removed_slots_.begin(), unsent);
  removed_slots_.erase(removed_slots_.begin(), unsent);
}

void AgentTable::Free(std::uint32_t slot) {
  const std::uint64_t sequence = slots_[slot].states.sent_sequence();
  slots_[slot].states = OutgoingStates();
  free_slots_.push_back(slot);
  std::push_heap(free_slots_.begin(), free_slots_.end(), std::greater<>());
  if (sequence == 0 || sequence != standing_sequence_) return;
  // No clock may name a state that is in no sample any more: a service that joins would wait for
  // it.
  standing_sequence_ = 0;
  for (const Slot& other : slots_) {
    standing_sequence_ = std::max(standing_sequence_, other.states.sent_sequence());
  }
}

std::vector<v1::AgentRemoval> AgentTable::Removals() const {
  std::vector<v1::AgentRemoval> removals;
  for (const auto* slots : {&free_slots_, &removed_slots_, &leaving_slots_}) {
    for (const std::uint32_t slot : *slots) removals.push_back(RemovalOf(slot));
  }
  return removals;
}

void AgentTable::Heed(const Watches* watches, Watches::Time now) {
  watches_ = watches;
  now_ = now;
}

bool AgentTable::IsDue(std::uint32_t index, std::int64_t clock_ns) const {
  const Slot& slot = slots_[index];
  if (slot.states.IsDue(clock_ns, slot.description.revision(), policy_)) return true;
  return slot.states.staged()->stamp_ns <= clock_ns && IsWatched(index);
}

bool AgentTable::IsWatched(std::uint32_t index) const {
  if (watches_ == nullptr) return false;
  const auto period =
      watches_->PeriodOf({simulator_id_, run_, index, slots_[index].description.generation()});
  return period && now_ - slots_[index].sent_at >= *period;
}

bool AgentTable::HasNews(std::int64_t clock_ns) const {
  const auto due = [&](std::uint32_t slot) { return IsDue(slot, clock_ns); };
  return census_changed_ || std::any_of(staged_slots_.begin(), staged_slots_.end(), due);
}

std::vector<v1::AgentDescription> AgentTable::Descriptions() const {
  std::vector<v1::AgentDescription> descriptions;
  for (const Slot& slot : slots_) {
    if (slot.occupied) descriptions.push_back(slot.description);
  }
  return descriptions;
}

std::vector<v1::AgentStates> AgentTable::SentStates() const {
  const auto newest = [](const v1::AgentStates& chunk) {
    std::uint64_t sequence = 0;
    for (const v1::AgentState& state : chunk.states())
      sequence = std::max<std::uint64_t>(sequence, state.sequence());
    return sequence;
  };
  std::vector<v1::AgentStates> chunks;
  for (std::uint32_t chunk = 0; chunk * policy_.chunk_size < slots_.size(); ++chunk) {
    v1::AgentStates states = Chunk(chunk);
    if (states.states_size() > 0) chunks.push_back(std::move(states));
  }
  std::sort(chunks.begin(), chunks.end(),
            [&](const auto& a, const auto& b) { return newest(a) < newest(b); });
  return chunks;
}

std::vector<AgentId> AgentTable::ForgetPromises() {
  std::vector<AgentId> voided;
  for (std::uint32_t index = 0; index < slots_.size(); ++index) {
    Slot& slot = slots_[index];
    const bool promised = slot.states.clearance().clear_until_ns != Clearance().clear_until_ns;
    if (slot.occupied && promised) {
      voided.push_back({simulator_id_, run_, index, slot.description.generation()});
    }
    slot.states.SetClearance({}, 0, std::numeric_limits<std::int64_t>::max());
  }
  return voided;
}

void AgentTable::ForgetSent() {
  for (const std::uint32_t slot : removed_slots_) {
    slots_[slot].states = OutgoingStates();
    std::erase(staged_slots_, slot);
  }
  for (Slot& slot : slots_) slot.states.ForgetSent();
  stated_ = 0;
  standing_sequence_ = 0;
  taken_ns_ = clock_ns_ = told_ns_ = std::numeric_limits<std::int64_t>::min();
}

void AgentTable::Send(std::uint32_t index) {
  Slot& slot = slots_[index];
  const std::uint64_t before = states_sequence_;
  slot.sent_at = now_;
  stated_ += !slot.states.sent().has_value();
  if (slot.states.sent() && slot.states.StagedJumps()) jumped_slots_.push_back(index);
  slot.states.MarkSent(&states_sequence_, slot.description.revision());
  standing_sequence_ = states_sequence_;
  traffic_.states_sent += states_sequence_ - before;
}

std::vector<v1::AgentStates> AgentTable::TakeDue(std::int64_t clock_ns) {
  std::vector<std::uint32_t> chunks;
  if (policy_.wall_clock && clock_ns > taken_ns_) EndRound();
  chunks = FreeRemoved();
  taken_ns_ = clock_ns;
  // In the order of the chunks, so that the last one that is written has the highest sequence: it
  // arrives last, and a clock that names it counts when all have come.
  std::sort(staged_slots_.begin(), staged_slots_.end());
  std::size_t waiting = 0;
  for (const std::uint32_t index : staged_slots_) {
    if (IsDue(index, clock_ns)) {
      Send(index);
      chunks.push_back(index / policy_.chunk_size);
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

std::int64_t AgentTable::HeldBack(std::int64_t clock_ns) const {
  if (!policy_.wall_clock) return clock_ns;
  std::int64_t held_ns = clock_ns;
  for (const std::uint32_t slot : jumped_slots_) {
    const auto jump_ns = slots_[slot].states.JumpOnItsWay(clock_ns);
    if (jump_ns) held_ns = std::min(held_ns, std::max(*jump_ns, told_ns_));
  }
  return held_ns;
}

v1::SimulatorClock AgentTable::Clock(std::int64_t clock_ns, std::int64_t next_ns, bool lock_step) {
  census_changed_ = false;
  std::erase_if(jumped_slots_,
                [&](std::uint32_t slot) { return !slots_[slot].states.JumpOnItsWay(clock_ns); });
  clock_ns_ = clock_ns;
  told_ns_ = HeldBack(clock_ns);
  v1::SimulatorClock clock;
  clock.set_simulator_id(simulator_id_);
  clock.set_incarnation(incarnation_);
  clock.set_run(run_);
  clock.set_simulator_name(simulator_name_);
  clock.set_clock_ns(told_ns_);
  clock.set_next_ns(next_ns);
  clock.set_states_sequence(standing_sequence_);
  clock.set_descriptions_sequence(descriptions_sequence_);
  clock.set_agents(agent_count_);
  clock.set_lock_step(lock_step);
  return clock;
}

bool AgentTable::SetClearance(const v1::AgentClearance& clearance, std::int64_t now_ns) {
  if (clearance.slot() >= slots_.size()) return false;
  Slot& slot = slots_[clearance.slot()];
  if (!slot.occupied || slot.description.generation() != clearance.generation()) return false;
  slot.states.SetClearance(FromMessage(clearance), clearance.acknowledged_sequence(), now_ns);
  slot.acknowledged_revision = clearance.acknowledged_revision();
  const bool lowered = clearance.lowerings() > std::exchange(slot.lowerings, clearance.lowerings());
  return lowered && clearance.cause() != v1::CAUSE_NONE;
}

void AgentTable::BeginService() {
  for (Slot& slot : slots_) {
    slot.lowerings = 0;
    slot.states.BeginService();
  }
}

Clearance AgentTable::clearance(const AgentId& id) const {
  const Slot& slot = slots_.at(id.slot);
  Clearance clearance = slot.states.clearance();
  clearance.description_counts = slot.acknowledged_revision == slot.description.revision();
  return clearance;
}

std::uint32_t AgentTable::FreeSlot() {
  if (free_slots_.empty()) {
    if (slots_.size() == kAgentsMax)
      throw std::length_error("agents: " + std::to_string(kAgentsMax) +
                              " are there, no more allowed");
    slots_.emplace_back();
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  std::pop_heap(free_slots_.begin(), free_slots_.end(), std::greater<>());
  const std::uint32_t slot = free_slots_.back();
  free_slots_.pop_back();
  return slot;
}

v1::AgentState AgentTable::Message(std::uint32_t slot, const State& state,
                                   std::uint64_t sequence) const {
  v1::AgentState message = ToMessage(state);
  message.set_slot(slot);
  message.set_generation(slots_[slot].description.generation());
  message.set_sequence(sequence);
  return message;
}

std::pair<std::uint32_t, std::uint32_t> AgentTable::SlotsOf(std::uint32_t chunk) const {
  const std::uint32_t first = chunk * policy_.chunk_size;
  return {first, std::min(first + policy_.chunk_size, static_cast<std::uint32_t>(slots_.size()))};
}

// Of those that do not fit, the oldest are left out.
std::uint64_t AgentTable::CarriedAfter(std::uint32_t chunk) const {
  std::vector<std::uint64_t> sequences;
  const auto [first, end] = SlotsOf(chunk);
  for (std::uint32_t slot = first; slot < end; ++slot) {
    for (const OutgoingStates::Carried& one : slots_[slot].states.carried()) {
      sequences.push_back(one.sequence);
    }
  }
  const std::size_t room = wire::kStatesPerSampleMax - policy_.chunk_size;
  if (sequences.size() <= room) return 0;
  const auto last = sequences.begin() + static_cast<std::ptrdiff_t>(sequences.size() - room - 1);
  std::nth_element(sequences.begin(), last, sequences.end());
  return *last;
}

v1::AgentStates AgentTable::Chunk(std::uint32_t chunk) const {
  v1::AgentStates states;
  states.set_simulator_id(simulator_id_);
  states.set_chunk(chunk);
  states.set_incarnation(incarnation_);
  states.set_run(run_);
  const std::uint64_t carried_after = CarriedAfter(chunk);
  const auto [first, end] = SlotsOf(chunk);
  for (std::uint32_t slot = first; slot < end; ++slot) {
    const OutgoingStates& outgoing = slots_[slot].states;
    if (!outgoing.sent()) continue;
    for (const OutgoingStates::Carried& one : outgoing.carried()) {
      if (one.sequence <= carried_after) continue;
      *states.add_states() = Message(slot, one.state, one.sequence);
    }
    *states.add_states() = Message(slot, *outgoing.sent(), outgoing.sent_sequence());
  }
  return states;
}

}  // namespace collision::client
