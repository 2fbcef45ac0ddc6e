#include "collision_core/detection/pairs/pair_table.h"

#include <algorithm>
#include <map>
#include <utility>

#include "collision_core/base/free_list.h"

namespace collision::detection {

void PairTable::AddAgent(AgentIndex agent, const OwnerId& owner, bool unlimited) {
  if (!of_agent_.contains(agent)) {
    of_agent_.resize(agent.value() + 1);
    idle_of_agent_.resize(agent.value() + 1);
    most_of_.resize(agent.value() + 1);
    full_.resize(agent.value() + 1);
    owner_of_.resize(agent.value() + 1);
  }
  CORE_CHECK(of_agent_[agent].empty(), "a new agent has no pairs", agent.value());
  owner_of_[agent] = owners_.Enter(owner);
  most_of_[agent] = unlimited ? pairs_max_ : pairs_per_agent_max_;
  UpdateFull(agent);
}

void PairTable::RemoveAgent(AgentIndex agent) {
  CORE_CHECK(Of(agent).empty(), "an agent that leaves has no pairs", agent.value());
  owners_.Leave(owner_of_[agent]);
  owner_of_[agent] = nullptr;
}

void PairTable::SetShare(const OwnerId& owner, const Share& share) {
  if (Owner* present = owners_.Find(owner)) owners_.SetShare(present, share);
}

template <typename Visitor>
void PairTable::ForEachOwner(const PairRecord& pair, const Visitor& visit) const {
  Owner *lower = owner_of_[pair.lower], *higher = owner_of_[pair.higher];
  visit(lower);
  if (higher != lower) visit(higher);
}

PairSlot PairTable::Add(const PairRecord& pair) {
  if (size_ == pairs_max_) return PairSlot::None();
  CORE_CHECK(pair.lower != pair.higher, "a pair has two agents", pair.lower.value());
  CORE_CHECK(RoomFor(pair.lower) > 0 && RoomFor(pair.higher) > 0, "both agents have room",
             pair.lower.value(), pair.higher.value());
  PairSlot slot;
  if (free_.size() <= kSlotsResting && pairs_.size() < pairs_max_) {
    slot = pairs_.end_index();
    pairs_.push_back(pair);
  } else {
    slot = free_.front();
    free_.pop_front();
    pairs_[slot] = pair;
  }
  ++size_;
  ForEachOwner(pair, [this](Owner* owner) { owners_.Take(owner, 1); });
  for (const AgentIndex agent : {pair.lower, pair.higher}) {
    of_agent_[agent].push_back(slot);
    UpdateFull(agent);
  }
  SetIdle(slot);
  return slot;
}

void PairTable::Remove(PairSlot slot) {
  const PairRecord& pair = (*this)[slot];
  for (const AgentIndex agent : {pair.lower, pair.higher}) {
    std::erase(of_agent_[agent], slot);
    std::erase(idle_of_agent_[agent], slot);
    UpdateFull(agent);
  }
  ForEachOwner(pair, [this](Owner* owner) { owners_.GiveBack(owner, 1); });
  pairs_[slot].reset();
  free_.push_back(slot);
  --size_;
}

void PairTable::SetIdle(PairSlot slot) {
  PairRecord& pair = (*this)[slot];
  for (const AgentIndex agent : {pair.lower, pair.higher}) {
    if (std::exchange(IsListedIdle(agent, &pair), true)) continue;
    idle_of_agent_[agent].push_back(slot);
  }
}

std::vector<PairSlot> PairTable::TakeIdle(AgentIndex agent) {
  std::vector<PairSlot> idle = std::exchange(idle_of_agent_.at(agent), {});
  for (const PairSlot slot : idle) IsListedIdle(agent, &(*this)[slot]) = false;
  return idle;
}

std::size_t PairTable::RoomFor(AgentIndex agent) const {
  const std::size_t taken = Of(agent).size();
  const std::uint32_t most = most_of_[agent];
  if (taken >= most) return 0;
  return std::min<std::size_t>(most - taken, OwnersRoom(agent));
}

void PairTable::UpdateFull(AgentIndex agent) {
  full_[agent] = of_agent_[agent].size() >= most_of_[agent];
}

void PairTable::ValidateAgent(AgentIndex agent) const {
  CORE_CHECK(Of(agent).size() <= most_of_[agent], "an agent has no more pairs than allowed",
             agent.value());
  CORE_CHECK(full_[agent] == (Of(agent).size() >= most_of_[agent]),
             "an agent that has no room is marked", agent.value());
  const std::vector<PairSlot>& idle = idle_of_agent_.at(agent);
  for (const PairSlot slot : Of(agent)) {
    PairRecord pair = (*this)[slot];
    const auto count = std::count(idle.begin(), idle.end(), slot);
    CORE_CHECK(count == IsListedIdle(agent, &pair), "an idle pair is listed once", slot.value(),
               count);
  }
  std::vector<AgentIndex> partners;
  for (const PairSlot slot : Of(agent)) partners.push_back((*this)[slot].PartnerOf(agent));
  std::sort(partners.begin(), partners.end());
  CORE_CHECK(std::adjacent_find(partners.begin(), partners.end()) == partners.end(),
             "two agents are tracked as one pair", agent.value());
}

void PairTable::Validate() const {
  std::size_t held = 0, listed = 0;
  std::map<const Owner*, std::uint64_t> of_owner;
  for (PairSlot slot; pairs_.contains(slot); slot = PairSlot(slot.value() + 1)) {
    if (!Contains(slot)) continue;
    ++held;
    const PairRecord& pair = (*this)[slot];
    ForEachOwner(pair, [&of_owner](const Owner* owner) { ++of_owner[owner]; });
    for (const AgentIndex agent : {pair.lower, pair.higher}) {
      const auto count = std::count(Of(agent).begin(), Of(agent).end(), slot);
      CORE_CHECK(count == 1, "a pair stands once with each of its agents", slot.value(), count);
    }
  }
  for (const auto& [owner, pairs] : of_owner) {
    CORE_CHECK(owner->used == pairs, "an owner's pairs are counted", owner->used, pairs);
  }
  CORE_CHECK(held == size_, "tracked pairs are counted", held, size_);
  CORE_CHECK(size_ <= pairs_max_, "there are no more pairs than allowed", size_, pairs_max_);
  ValidateFreeList(
      free_, pairs_.size(), [](PairSlot slot) { return slot.value(); },
      [this](std::size_t slot) { return Contains(PairSlot(slot)); });
  for (AgentIndex agent; of_agent_.contains(agent); agent = AgentIndex(agent.value() + 1)) {
    listed += Of(agent).size();
    ValidateAgent(agent);
  }
  CORE_CHECK(listed == 2 * held, "an agent's pairs are tracked", listed, held);
}

}  // namespace collision::detection
