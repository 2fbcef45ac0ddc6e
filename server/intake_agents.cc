// The life of an agent: states kept until it is complete, admission, updates, removal.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "server/intake.h"
#include "server/logging.h"

namespace collision::server {

void Intake::UpdateAgent(Simulator* simulator, std::uint32_t slot, Agent* agent,
                         std::uint64_t sequence, const motion::MotionState& state) {
  const detection::AgentId id = simulator->IdOf(slot, agent->generation);
  const detection::UpdateOutcome outcome =
      state.stamp < agent->stamp ? detection::UpdateOutcome::kOlder
                                 : detector_.Update(id, state, world_.EffectiveFrom(state.stamp));
  if (outcome == detection::UpdateOutcome::kOlder) {
    ++counters_.states_older;
    return;
  }
  ++counters_.states_accepted;
  ++simulator->states;
  agent->stamp = state.stamp;
  agent->acknowledged_sequence = sequence;
  simulator->chunks_changed.insert(slot / kSlotsPerChunk);
  if (outcome == detection::UpdateOutcome::kBreached) {
    Log(spdlog::level::warn, "bound broken",
        fmt::format(
            "simulator {:016x} \"{}\" slot {} generation {}: its state at {} ns breaks what "
            "it declared; the new state is taken as the truth",
            simulator->id, simulator->name, slot, agent->generation, state.stamp.nanoseconds()));
  }
}

void Intake::KeepWaiting(Simulator* simulator, std::uint32_t slot_index,
                         const WaitingState& waiting) {
  Slot& slot = simulator->slots[slot_index];
  const bool first = !slot.waiting || slot.waiting->generation != waiting.generation;
  if (!first && waiting.state.stamp < slot.waiting->state.stamp) {
    ++counters_.states_older;
    return;
  }
  if (first && !Simulator::Describes(slot, waiting.generation)) {
    const detection::AgentId id = simulator->IdOf(slot_index, waiting.generation);
    if (undescribed_.size() >= kUndescribedMax) {
      return Refuse(NotDescribed(id, fmt::format("not kept: {} wait already", kUndescribedMax)));
    }
    undescribed_.push_back({world_.monotonic_ns() + undescribed_after_ns_, id});
  }
  slot.waiting = waiting;
  AdmitIfComplete(simulator, slot_index);
}

void Intake::AdmitIfComplete(Simulator* simulator, std::uint32_t slot_index) {
  Slot& slot = simulator->slots[slot_index];
  if (!slot.agent || slot.agent->admitted || !slot.waiting) return;
  if (slot.waiting->generation != slot.agent->generation) return;
  if (simulator->other_time || (world_.simulated() && !simulator->clock)) return;
  Agent& agent = *slot.agent;
  const detection::AgentId id = simulator->IdOf(slot_index, agent.generation);
  if (detector_.agents() >= agents_max_) {
    if (!std::exchange(agent.told_no_room, true)) Refuse(NoRoom(id, agents_max_));
    return;
  }
  const WaitingState waiting = *std::exchange(slot.waiting, std::nullopt);
  const StampRules rules = world_.RulesForState(*simulator, false);
  if (const auto refusal = CheckStamp(id, waiting.state.stamp, rules)) return Refuse(*refusal);
  if (!detector_.Admit(id, agent.declaration, waiting.state,
                       world_.EffectiveFrom(waiting.state.stamp))) {
    return;
  }
  agent.admitted = true;
  agent.stamp = waiting.state.stamp;
  agent.acknowledged_sequence = waiting.sequence;
  ++counters_.agents_admitted;
  ++counters_.states_accepted;
  ++simulator->states;
  simulator->chunks_changed.insert(slot_index / kSlotsPerChunk);
  if (simulator->clock) detector_.Hear(id, *simulator->clock);
}

void Intake::RemoveAgent(Simulator* simulator, std::uint32_t slot_index) {
  Slot& slot = simulator->slots[slot_index];
  if (!slot.agent) return;
  if (slot.agent->admitted) {
    detector_.Remove(simulator->IdOf(slot_index, slot.agent->generation));
    ++counters_.agents_removed;
  }
  ReferTo({}, simulator, slot_index, &*slot.agent);
  slot.generations_over = std::uint64_t{slot.agent->generation} + 1;
  if (slot.waiting && slot.waiting->generation < slot.generations_over) slot.waiting.reset();
  slot.agent.reset();
  --simulator->agents;
  simulator->chunks_changed.insert(slot_index / kSlotsPerChunk);
}

void Intake::RemoveAgents(Simulator* simulator) {
  for (const auto& [slot, state] : simulator->slots) RemoveAgent(simulator, slot);
}

void Intake::ReportUndescribed() {
  while (!undescribed_.empty() && undescribed_.front().due_ns <= world_.monotonic_ns()) {
    const detection::AgentId id = undescribed_.front().agent;
    undescribed_.pop_front();
    const Simulator* simulator = world_.Find(id.simulator);
    if (simulator == nullptr || simulator->run != id.run) continue;
    const auto slot = simulator->slots.find(id.slot);
    if (slot == simulator->slots.end() || !slot->second.waiting) continue;
    if (slot->second.waiting->generation != id.generation) continue;
    if (Simulator::Describes(slot->second, id.generation)) continue;
    Refuse(NotDescribed(id, "kept; nothing has described its agent yet"));
  }
}

std::optional<std::int64_t> Intake::NextDue() const {
  std::optional<std::int64_t> next;
  for (const auto* queue : {&undescribed_, &shapes_awaited_}) {
    if (!queue->empty())
      next = std::min(next.value_or(queue->front().due_ns), queue->front().due_ns);
  }
  return next;
}

}  // namespace collision::server
