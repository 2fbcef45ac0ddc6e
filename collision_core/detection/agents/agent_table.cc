#include "collision_core/detection/agents/agent_table.h"

#include <algorithm>

#include "collision_core/base/free_list.h"
#include "collision_core/shape/fixed_half_space.h"

namespace collision::detection {

// The bits of an id are its owner's choice. They are mixed (SplitMix64's finalizer), so that no
// scene fills one bucket by chance.
std::size_t AgentTable::IdHash::operator()(const AgentId& id) const {
  std::uint64_t hash = id.simulator + (std::uint64_t{id.slot} << 32 | id.run);
  for (const std::uint64_t more : {std::uint64_t{id.slot}, std::uint64_t{id.generation}}) {
    hash += more + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
    hash ^= hash >> 31;
  }
  return hash;
}

AgentIndex AgentTable::Admit(const AgentId& id, const AgentDeclaration& declaration,
                             Instant stamp) {
  CORE_CHECK(!declaration.shape || !declaration.shape_awaited, "an awaited shape is null");
  if (index_.size() >= limits_.agents_max || index_.contains(id)) return AgentIndex::None();
  const bool endless = declaration.half_space != nullptr;
  if (endless && half_spaces_ == kHalfSpacesMax) return AgentIndex::None();
  half_spaces_ += endless;
  AgentIndex agent(agents_.size());
  if (free_.empty()) {
    agents_.emplace_back();
  } else {
    agent = free_.back();
    free_.pop_back();
  }
  agents_[agent.value()] = std::make_unique<AgentRecord>();
  AgentRecord& record = (*this)[agent];
  record.id = id;
  record.Declare(declaration, endless ? declaration.half_space->WithBlocks() : nullptr);
  record.reported_until = stamp;
  record.admitted_from = stamp;
  Owner& owner = owners_[OwnerOf(id)];
  ++owner.agents;
  record.owner = &owner;
  index_[id] = agent;
  profile_.Add(record.features);
  return agent;
}

AgentIndex AgentTable::Find(const AgentId& id) const {
  const auto found = index_.find(id);
  return found == index_.end() ? AgentIndex::None() : found->second;
}

void AgentTable::Store(AgentIndex agent, const motion::MotionState& state, Link link) {
  AgentRecord& record = (*this)[agent];
  const AgentDeclaration& declared = record.declaration;
  record.history.Push({.bound = {state, declared.limits, limits_.skew},
                       .filter = declared.filter,
                       .shape = declared.shape,
                       .shape_awaited = declared.shape_awaited,
                       .link = link,
                       .half_space = declared.half_space},
                      limits_.history_max);
  record.shape_redeclared = false;
  record.reported_until = std::max(record.reported_until, state.stamp);
  MarkChanged(agent);
}

void AgentTable::RecordBound(AgentIndex agent) {
  AgentRecord& record = (*this)[agent];
  const motion::SpaceTimeBound& bound = record.bound();
  extremes_.Include(bound);
  if (bound.state.expiry.is_never()) {
    expiries_.Remove(agent);
  } else {
    expiries_.Set(agent, bound.state.expiry);
  }
  const SceneProfile::Features features = SceneProfile::Of(record.history.newest());
  if (features == record.features || record.removal != 0) return;
  profile_.Remove(record.features);
  profile_.Add(features);
  record.features = features;
}

void AgentTable::SetHeardUntil(const OwnerId& owner, Instant until, Instant still_until) {
  const auto found = owners_.find(owner);
  if (found == owners_.end()) return;
  found->second.heard_until = std::max(found->second.heard_until, until);
  found->second.still_until = std::max(found->second.still_until, still_until);
}

// The owner reports nothing more about the agent: what is known now is all there is.
void AgentTable::LeaveOwner(AgentRecord* record) {
  record->reported_until = record->heard_until();
  record->owner = nullptr;
  const auto owner = owners_.find(OwnerOf(record->id));
  if (--owner->second.agents == 0) owners_.erase(owner);
}

void AgentTable::Remove(AgentIndex agent) {
  AgentRecord& record = (*this)[agent];
  CORE_CHECK(record.removal == 0, "an agent is removed once", agent.value());
  LeaveOwner(&record);
  Instant& expiry = record.history.newest().bound.state.expiry;
  record.left_by = expiry;
  if (expiry.is_never()) expiry = record.reported_until;
  record.reported_until = std::max(record.reported_until, expiry);
  expiries_.Set(agent, expiry);
  record.removal = ++removals_;
  profile_.Remove(record.features);
  index_.erase(record.id);
}

void AgentTable::ExpireAtItsStamp(AgentIndex agent) {
  motion::MotionState& state = (*this)[agent].history.newest().bound.state;
  state.expiry = std::min(state.expiry, state.stamp);
  RecordBound(agent);
}

std::vector<AgentIndex> AgentTable::TakeExpired(Instant now) {
  std::vector<AgentIndex> expired;
  while (!expiries_.empty() && expiries_.top_key() <= now) {
    expired.push_back(expiries_.top());
    expiries_.Remove(expired.back());
  }
  std::sort(expired.begin(), expired.end(), [this](AgentIndex a, AgentIndex b) {
    const AgentRecord &record_a = (*this)[a], &record_b = (*this)[b];
    // 0, not removed, wraps to the greatest number.
    if (record_a.removal != record_b.removal) return record_a.removal - 1 < record_b.removal - 1;
    return record_a.id < record_b.id;
  });
  return expired;
}

void AgentTable::Release(AgentIndex agent) {
  CORE_CHECK((*this)[agent].removal != 0, "only a removed agent is released", agent.value());
  expiries_.Remove(agent);
  half_spaces_ -= (*this)[agent].is_half_space();
  agents_[agent.value()].reset();
  free_.push_back(agent);
}

void AgentTable::UpdateExtremes() {
  extremes_.ExamineNext(changed_.size(), agents_.size(), [this](std::size_t agent) {
    const AgentRecord* record = agents_[agent].get();
    const bool counts = record != nullptr && !record->expired && record->removal == 0;
    return counts ? &record->bound() : nullptr;
  });
}

void AgentTable::Validate() const {
  expiries_.Validate();
  changed_.Validate();
  std::size_t named = 0;
  std::size_t half_spaces = 0;
  std::map<OwnerId, std::uint32_t> counts;
  SceneProfile profile;
  for (std::size_t k = 0; k < agents_.size(); ++k) {
    const AgentIndex agent(k);
    if (!Contains(agent)) {
      CORE_CHECK(!expiries_.Contains(agent), "a free index does not expire", k);
      continue;
    }
    const AgentRecord& record = (*this)[agent];
    CORE_CHECK(!record.history.empty(), "an agent has a state", k);
    half_spaces += record.is_half_space();
    CORE_CHECK(record.stamp() <= record.heard_until(),
               "no state is newer than what its owner has reported", k);
    if (record.removal != 0) {
      CORE_CHECK(record.owner == nullptr && Find(record.id) != agent,
                 "a removed agent has no name and no owner", k);
      continue;
    }
    ++named;
    ++counts[OwnerOf(record.id)];
    profile.Add(record.features);
    CORE_CHECK(record.expired || record.features == SceneProfile::Of(record.history.newest()),
               "an agent's features are those of its newest state", k, record.features);
    CORE_CHECK(record.expired || extremes_.bounds().Holds(record.bound()),
               "the scene's extremes hold each newest bound", k);
    CORE_CHECK(Find(record.id) == agent, "an agent is found by its name", k);
    CORE_CHECK(record.owner != nullptr, "an agent has an owner", k);
  }
  CORE_CHECK(half_spaces == half_spaces_, "half-spaces are counted", half_spaces, half_spaces_);
  CORE_CHECK(named == index_.size(), "each name is of one agent", named, index_.size());
  ValidateFreeList(
      free_, agents_.size(), [](AgentIndex agent) { return agent.value(); },
      [this](std::size_t agent) { return Contains(AgentIndex(agent)); });
  CORE_CHECK(profile == profile_, "the features of all agents are counted", named);
  CORE_CHECK(counts.size() == owners_.size(), "an owner has agents", counts.size());
  for (const auto& [id, owner] : owners_) {
    CORE_CHECK(owner.agents == counts[id], "an owner's agents are counted", owner.agents);
  }
}

}  // namespace collision::detection
