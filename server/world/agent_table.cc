#include "server/world/agent_table.h"

#include "collision_core/base/check.h"

namespace collision::server {

const Agent* AgentTable::Find(std::uint32_t slot) const {
  const auto found = slots_.find(slot);
  return found == slots_.end() || !found->second.agent ? nullptr : &*found->second.agent;
}

Agent* AgentTable::Find(std::uint32_t slot) {
  return const_cast<Agent*>(std::as_const(*this).Find(slot));
}

const Agent* AgentTable::Find(std::uint32_t slot, std::uint32_t generation) const {
  const Agent* agent = Find(slot);
  return agent != nullptr && agent->generation_ == generation ? agent : nullptr;
}

Agent* AgentTable::Find(std::uint32_t slot, std::uint32_t generation) {
  return const_cast<Agent*>(std::as_const(*this).Find(slot, generation));
}

std::span<const WaitingState> AgentTable::AllWaiting(std::uint32_t slot) const {
  const auto found = slots_.find(slot);
  if (found == slots_.end()) return {};
  return found->second.waiting;
}

const WaitingState* AgentTable::Waiting(std::uint32_t slot) const {
  const std::span<const WaitingState> all = AllWaiting(slot);
  return all.empty() ? nullptr : &all.back();
}

bool AgentTable::HasEnded(std::uint32_t slot, std::uint32_t generation) const {
  const auto found = slots_.find(slot);
  return found != slots_.end() && generation < found->second.ended;
}

StateOrder AgentTable::RecordState(std::uint32_t slot_index, std::uint32_t generation,
                                   std::uint64_t sequence) {
  Slot& slot = slots_[slot_index];
  if (generation < slot.ended) return StateOrder::kEnded;
  const std::pair<std::uint32_t, std::uint64_t> order(generation, sequence);
  if (slot.handled && order <= *slot.handled) return StateOrder::kRepeated;
  stated_ -= slot.stated();
  slot.handled = order;
  stated_ += slot.stated();
  return StateOrder::kNew;
}

Agent* AgentTable::Add(std::uint32_t slot_index, const Agent& agent) {
  Slot& slot = slots_[slot_index];
  CORE_CHECK(!slot.agent, "an agent is added to a free slot", slot_index);
  CORE_CHECK(agent.generation_ >= slot.ended, "a generation that has ended stays so", slot_index,
             agent.generation_, slot.ended);
  slot.ended = agent.generation_;
  slot.agent = agent;
  ++agents_;
  hypothetical_ += agent.hypothetical();
  stated_ += slot.stated();
  return &*slot.agent;
}

void AgentTable::Revise(std::uint32_t slot, std::uint32_t revision,
                        const detection::AgentDeclaration& declaration) {
  Agent& agent = AgentIn(slot);
  agent.revision_ = revision;
  agent.declaration = declaration;
  if (!agent.admitted_) agent.acknowledged_revision_ = revision;
  clearances_.MarkChanged(slot);
}

void AgentTable::AcknowledgeRevision(std::uint32_t slot, std::uint32_t generation,
                                     std::uint32_t revision, Instant from) {
  Agent* agent = Find(slot, generation);
  if (agent == nullptr || revision <= agent->acknowledged_revision_) return;
  agent->acknowledged_revision_ = revision;
  agent->acknowledged_from_ = from;
  clearances_.MarkChanged(slot);
}

void AgentTable::SetWaiting(std::uint32_t slot, const WaitingState& waiting, Former former) {
  std::vector<WaitingState>& all = slots_[slot].waiting;
  if (!all.empty() && all.back().generation != waiting.generation) all.clear();
  if (!all.empty() && former == Former::kReplaced) all.pop_back();
  all.push_back(waiting);
  if (all.size() <= kWaitingBeforeMax + 1) return;
  // Of an agent that is not admitted the first state is where it begins.
  const Agent* agent = Find(slot, waiting.generation);
  const auto oldest = all.begin() + (agent != nullptr && agent->admitted_ ? 0 : 1);
  all.erase(oldest)->state.discontinuity = false;
}

std::vector<WaitingState> AgentTable::TakeWaiting(std::uint32_t slot) {
  const auto found = slots_.find(slot);
  CORE_CHECK(found != slots_.end() && !found->second.waiting.empty(), "a state waits in the slot",
             slot);
  return std::exchange(found->second.waiting, {});
}

void AgentTable::DropWaiting(std::uint32_t slot) {
  const auto found = slots_.find(slot);
  if (found != slots_.end()) found->second.waiting.clear();
}

void AgentTable::Admit(std::uint32_t slot, Instant stamp, std::uint64_t sequence) {
  Agent& agent = AgentIn(slot);
  agent.admitted_ = true;
  agent.acknowledged_revision_ = agent.revision_;
  agent.acknowledged_from_ = Instant::Always();
  Acknowledge(slot, stamp, sequence);
}

void AgentTable::Expel(std::uint32_t slot_index) {
  Slot& slot = slots_[slot_index];
  slot.waiting.clear();
  if (!slot.agent) return;
  slot.agent->admitted_ = false;
  slot.agent->stamp_ = Instant::Always();
  slot.agent->acknowledged_sequence_ = 0;
  clearances_.Forget(slot_index);
}

void AgentTable::Acknowledge(std::uint32_t slot, Instant stamp, std::uint64_t sequence) {
  Agent& agent = AgentIn(slot);
  agent.stamp_ = stamp;
  agent.acknowledged_sequence_ = sequence;
  clearances_.MarkChanged(slot);
}

void AgentTable::SetClearance(const detection::AgentClearance& clearance) {
  const Agent* agent = Find(clearance.agent.slot, clearance.agent.generation);
  if (agent == nullptr) return;
  clearances_.Set(clearance.agent.slot, clearance, agent->hypothetical());
}

void AgentTable::SetClearanceOfLevel(std::size_t level,
                                     const detection::AgentClearance& clearance) {
  if (Find(clearance.agent.slot, clearance.agent.generation) == nullptr) return;
  clearances_.SetOfLevel(clearance.agent.slot, level, clearance);
}

void AgentTable::Remove(std::uint32_t slot_index) {
  Slot& slot = slots_[slot_index];
  CORE_CHECK(slot.agent.has_value(), "an agent is in the slot", slot_index);
  slot.ended = std::uint64_t{slot.agent->generation_} + 1;
  if (!slot.waiting.empty() && slot.waiting.back().generation < slot.ended) slot.waiting.clear();
  stated_ -= slot.stated();
  hypothetical_ -= slot.agent->hypothetical();
  slot.agent.reset();
  --agents_;
  clearances_.Forget(slot_index);
}

void AgentTable::RemoveWaiting(std::uint32_t slot_index) {
  const auto found = slots_.find(slot_index);
  if (found == slots_.end() || found->second.waiting.empty()) return;
  found->second.ended = std::uint64_t{found->second.waiting.back().generation} + 1;
  found->second.waiting.clear();
}

void AgentTable::Clear() {
  CORE_CHECK(agents_ == 0, "all agents are removed before a new run", agents_);
  for (const auto& [slot, content] : slots_) clearances_.MarkChanged(slot);
  slots_.clear();
  clearances_.ForgetLowerings();
}

Agent& AgentTable::AgentIn(std::uint32_t slot) {
  Agent* agent = Find(slot);
  CORE_CHECK(agent != nullptr, "an agent is in the slot", slot);
  return *agent;
}

void AgentTable::Validate() const {
  std::size_t agents = 0, hypothetical = 0, stated = 0;
  for (const auto& [index, slot] : slots_) {
    if (slot.agent) {
      ++agents;
      hypothetical += slot.agent->hypothetical();
      stated += slot.stated();
      CORE_CHECK(slot.agent->generation_ >= slot.ended, "the agent has not ended", index);
    }
  }
  CORE_CHECK(agents == agents_, "described agents are counted", agents, agents_);
  CORE_CHECK(hypothetical == hypothetical_, "hypothetical agents are counted", hypothetical,
             hypothetical_);
  CORE_CHECK(stated == stated_, "agents with a state are counted", stated, stated_);
  clearances_.Validate();
  for (const auto& [index, clearance] : clearances_.all()) {
    const Agent* agent = Find(index, clearance.agent.generation);
    CORE_CHECK(agent != nullptr && agent->admitted_, "a clearance belongs to an admitted agent",
               index);
  }
}

}  // namespace collision::server
