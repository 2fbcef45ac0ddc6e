// The pairs that may meet soon, or touch.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/base/shared_limit.h"
#include "collision_core/detection/events/announcer.h"
#include "collision_core/detection/pairs/contact_tracker.h"

namespace collision::detection {

/// PairRecord::spent of a pair that wants all the work it can get: more than any evaluation may
/// spend.
inline constexpr std::uint64_t kAllWanted = ~std::uint64_t{0};

/// One tracked pair. `lower` and `higher` are in the order of the agents' ids.
struct PairRecord {
  AgentIndex lower;
  AgentIndex higher;
  /// The settled past. While the pair is free throughout it also covers promised freedom, which
  /// RetractFree() takes back.
  ContactTracker tracker;
  Instant clear_until;  ///< No contact begins before this; not later than now while undecided.
  /// Freedom beyond this was taken back since the last step; Never(): none.
  Instant retracted_from = Instant::Never();
  /// The canonical earliest intersection from `now` on, as of step `canonical_step`.
  Instant canonical = Instant::Never();
  std::uint64_t canonical_step = 0;
  std::uint64_t evaluated_step = 0;  ///< The step in which it was last evaluated.
  /// The last time at which the narrow phase computed how long the shapes stay apart.
  Instant looked_ahead = Instant::Always();
  /// When the evaluator stops waiting for a state that could narrow the end of a contact.
  Instant settles = Instant::Never();
  /// The end of the last contact, or doubt, that has ended but is not settled; Always(): none.
  Instant unsettled_until = Instant::Always();
  bool in_contact = false;  ///< Contact is certified and has not ended.
  Instant rests_until =
      Instant::Always();  ///< In contact: it certainly lasts until then without a new state.
  /// A contact, or a doubt, that is known but lies after `now`: [from, until].
  Instant ahead_from = Instant::Never();
  Instant ahead_until = Instant::Never();
  /// Work units of the last evaluation; kAllWanted: the budget was not enough.
  std::uint64_t spent = kAllWanted;
  PublishedEvent published{};
  bool idle_with_lower = false, idle_with_higher = false;  ///< For PairTable::TakeIdle().

  AgentIndex PartnerOf(AgentIndex agent) const { return agent == lower ? higher : lower; }
};

/// Holds tracked pairs by slot, each agent's slots, and which of these are idle: they wait for no
/// evaluation. An agent that changes need not look at the others.
///
/// Slots are reused in the order in which they were freed, and only after others have been freed
/// since, so that a slot's last sample on the wire stays readable for a while. Add() and Remove()
/// are O(pairs of the two agents).
class PairTable {
 public:
  /// Freed slots that rest before one of them is reused.
  static constexpr std::size_t kSlotsResting = 1024;

  PairTable(std::uint32_t pairs_max, std::uint32_t pairs_per_agent_max)
      : pairs_max_(pairs_max), pairs_per_agent_max_(pairs_per_agent_max) {}

  /// The agent of this index has no pairs yet. `unlimited`: it may have more than
  /// pairs_per_agent_max, as a floor on which all others stand.
  void AddAgent(AgentIndex agent, const OwnerId& owner = {}, bool unlimited = false);
  /// Requires AddAgent(agent), and that it has no pairs.
  void RemoveAgent(AgentIndex agent);

  /// How many pairs the owner's agents may have. No effect while it has none.
  void SetShare(const OwnerId& owner, const Share& share);

  /// Adds a pair and returns its slot; None() if `pairs_max` pairs are tracked. Otherwise requires
  /// RoomFor() > 0 of both agents. Unchecked: the two share no pair yet; Validate() finds it.
  PairSlot Add(const PairRecord& pair);
  /// Requires Contains(slot).
  void Remove(PairSlot slot);

  bool Contains(PairSlot slot) const {
    return slot.value() < pairs_.size() && pairs_[slot].has_value();
  }
  /// Requires Contains(slot).
  PairRecord& operator[](PairSlot slot) {
    CORE_CHECK(Contains(slot), "a pair that is tracked has this slot", slot.value());
    return *pairs_[slot];
  }
  const PairRecord& operator[](PairSlot slot) const {
    CORE_CHECK(Contains(slot), "a pair that is tracked has this slot", slot.value());
    return *pairs_[slot];
  }
  std::size_t size() const { return size_; }

  /// The agent's tracked pairs. Requires AddAgent(agent).
  const std::vector<PairSlot>& Of(AgentIndex agent) const { return of_agent_.at(agent); }

  /// The pair is idle, as each new one is. Requires Contains(slot). O(1).
  void SetIdle(PairSlot slot);
  /// Of the agent's pairs all that are idle: those set so since the last call for this agent. Some
  /// may have been taken with their other agent meanwhile. Requires AddAgent(agent).
  std::vector<PairSlot> TakeIdle(AgentIndex agent);

  /// Pairs that can still be added: in all, and with this agent. Requires AddAgent(agent).
  std::size_t room() const { return pairs_max_ - size_; }
  std::size_t RoomFor(AgentIndex agent) const;
  bool IsFull(AgentIndex agent) const { return full_.at(agent) != 0 || OwnersRoom(agent) == 0; }

  /// Walks the whole table: each pair stands with both its agents, which share no other; each other
  /// slot is free, and listed as free once.
  void Validate() const;

 private:
  using Owner = SharedLimit<OwnerId>::Account;

  void UpdateFull(AgentIndex agent);
  /// Pairs that the agent's owner may still have. The exhaustive broad phase also asks about
  /// indices that no agent has.
  std::size_t OwnersRoom(AgentIndex agent) const {
    const Owner* owner = owner_of_[agent];
    return owner == nullptr ? room() : owners_.RoomFor(*owner, room());
  }
  template <typename Visitor>
  void ForEachOwner(const PairRecord& pair, const Visitor& visit) const;
  static bool& IsListedIdle(AgentIndex agent, PairRecord* pair) {
    return agent == pair->lower ? pair->idle_with_lower : pair->idle_with_higher;
  }
  void ValidateAgent(AgentIndex agent) const;

  const std::uint32_t pairs_max_;
  const std::uint32_t pairs_per_agent_max_;
  IndexedVector<PairSlot, std::optional<PairRecord>> pairs_;
  std::size_t size_ = 0;
  std::deque<PairSlot> free_;
  IndexedVector<AgentIndex, std::vector<PairSlot>> of_agent_;
  IndexedVector<AgentIndex, std::vector<PairSlot>> idle_of_agent_;
  IndexedVector<AgentIndex, std::uint32_t> most_of_;  // how many pairs the agent may have
  IndexedVector<AgentIndex, std::uint8_t> full_;      // as many pairs as the agent may have
  SharedLimit<OwnerId> owners_;                       // present as often as an owner has agents
  IndexedVector<AgentIndex, Owner*> owner_of_;
};

}  // namespace collision::detection
