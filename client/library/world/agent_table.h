// The agents of one simulator: their slots, and the messages that tell the service about them.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "client/library/world/contract.h"
#include "client/library/world/publish_policy.h"
#include "client/library/world/watches.h"
#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Book-keeping only: the caller writes the messages that it returns, in that order.
///
/// A slot is reused, the lowest free one first, with a new generation: ever-new keys would let the
/// network's histories grow without bound.
class AgentTable {
 public:
  AgentTable(std::string simulator_name, std::uint64_t simulator_id, std::uint32_t run,
             std::uint32_t incarnation, const PublishPolicy& policy);

  /// All agents belong to this run from here on.
  void SetRun(std::uint32_t run);

  /// Gives a new agent its slot and stages its first state. Throws std::length_error if the table
  /// is full.
  AgentId Add(const AgentDescription& description, const State& state);

  /// The current description of an agent in the table, to be written after Add() and Describe().
  const v1::AgentDescription& description(const AgentId& id) const;
  void Describe(const AgentId& id, const AgentDescription& description);

  /// The name of the agent in this slot; empty: there is none.
  std::string NameIn(std::uint32_t slot) const;

  /// Stages a state until the clock reaches its stamp; see OutgoingStates.
  void Stage(const AgentId& id, const State& state);

  /// In real time: the sample to be written before Remove(), if there is one: the state that the
  /// agent has reached, which the service did not need while its motion went on.
  std::optional<v1::AgentStates> TakeLast(const AgentId& id);

  /// The removal is a description, too: it takes the next number of these. In lock-step the state
  /// that the agent has reached, and that it left then, is due.
  v1::AgentRemoval Remove(const AgentId& id);

  /// Somebody looks at agents: their newest states are due, too, a period after the last that was
  /// sent. As of `now`; `watches` holds until the next call, null: nobody does.
  void Heed(const Watches* watches, Watches::Time now);

  /// Whether TakeDue() or a clock sample would say anything new at this clock.
  bool HasNews(std::int64_t clock_ns) const;

  /// All messages that still hold, to repeat them; of states, the newest chunk last.
  std::vector<v1::AgentDescription> Descriptions() const;
  std::vector<v1::AgentRemoval> Removals() const;
  std::vector<v1::AgentStates> SentStates() const;

  /// No promise stands that was made before. Returns the agents that had one.
  std::vector<AgentId> ForgetPromises();

  /// The service has forgotten all states, and what it promised: each agent's next one is sent,
  /// whatever its stamp.
  void ForgetSent();

  /// Sends the staged states that are due: the chunks that changed, each with the last sent states
  /// of all its agents. Where an agent was removed, its last state stays in its chunk, and its slot
  /// unused, until the clock has moved on, in lock-step until EndRound(): the service is to see it.
  /// To be written in this order: the highest sequence comes last, so that the service has all when
  /// it has that one.
  std::vector<v1::AgentStates> TakeDue(std::int64_t clock_ns);

  /// Lock-step: the service has granted more time, so it has all that the last clock named.
  void EndRound();

  /// The clock sample that follows everything sent so far. In real time it tells no more than
  /// the stamp of a jump on its way: it might overtake the jump, if that is overwritten in one
  /// sample and comes with the next, and others would have relied on what the jump ends.
  v1::SimulatorClock Clock(std::int64_t clock_ns, std::int64_t next_ns, bool lock_step);

  /// The last clock sample was held back, and the next one need not be so far.
  bool clock_released() const { return HeldBack(clock_ns_) > told_ns_; }

  /// Agents of which a state has been sent.
  std::uint32_t stated() const { return stated_; }

  /// A clearance as of the service's time `now_ns`; those of former agents are ignored. True: it
  /// tells of a lowering that the ones before did not.
  bool SetClearance(const v1::AgentClearance& clearance, std::int64_t now_ns);

  /// Another service counts lowerings anew.
  void BeginService();
  Clearance clearance(const AgentId& id) const;

  std::uint32_t size() const { return agent_count_; }
  const Traffic& traffic() const { return traffic_; }

 private:
  struct Slot {
    bool occupied = false;
    v1::AgentDescription description;  ///< Keeps the generation, also while the slot is free.
    MotionBounds bounds;               ///< As described.
    MotionBounds bounds_to_next;       ///< Wider, if it was described anew since its last state.
    OutgoingStates states;
    std::uint32_t lowerings = 0;              ///< Of its clearance, as last heard.
    std::uint32_t acknowledged_revision = 0;  ///< Likewise.
    Watches::Time sent_at{};                  ///< When a state was sent last.
  };

  /// The staged state of the slot counts as sent.
  void Send(std::uint32_t index);
  std::int64_t HeldBack(std::int64_t clock_ns) const;
  std::uint32_t FreeSlot();
  /// Gives back the slots of removed agents; returns the chunks that they were in.
  std::vector<std::uint32_t> FreeRemoved();
  void Free(std::uint32_t slot);
  v1::AgentRemoval RemovalOf(std::uint32_t slot) const;
  bool IsDue(std::uint32_t index, std::int64_t clock_ns) const;
  bool IsWatched(std::uint32_t index) const;
  v1::AgentState Message(std::uint32_t slot, const State& state, std::uint64_t sequence) const;
  /// First slot of a chunk, and one past its last.
  std::pair<std::uint32_t, std::uint32_t> SlotsOf(std::uint32_t chunk) const;
  /// Of the states that a chunk's sample carries beside the newest ones, those above this number
  /// have room.
  std::uint64_t CarriedAfter(std::uint32_t chunk) const;
  v1::AgentStates Chunk(std::uint32_t chunk) const;

  std::string simulator_name_;
  std::uint64_t simulator_id_;
  std::uint32_t run_;
  std::uint32_t incarnation_;
  PublishPolicy policy_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_;     ///< A heap, the lowest on top.
  std::vector<std::uint32_t> staged_slots_;   ///< Of agents with a staged state.
  std::vector<std::uint32_t> removed_slots_;  ///< Their last states are still to be seen.
  std::vector<std::uint32_t> leaving_slots_;  ///< Lock-step: those were seen.
  std::vector<std::uint32_t> jumped_slots_;   ///< With a jump on its way, or so they were.
  std::int64_t clock_ns_ = std::numeric_limits<std::int64_t>::min();  ///< Of the last sample ...
  std::int64_t told_ns_ = std::numeric_limits<std::int64_t>::min();   ///< ... and what it told.
  std::int64_t taken_ns_ = std::numeric_limits<std::int64_t>::min();  ///< Clock of TakeDue().
  std::uint32_t agent_count_ = 0;
  std::uint32_t stated_ = 0;
  std::uint64_t states_sequence_ = 0;
  std::uint64_t standing_sequence_ = 0;  ///< The highest of a state that its agent still has.
  std::uint64_t descriptions_sequence_ = 0;
  const Watches* watches_ = nullptr;
  Watches::Time now_{};  ///< Of the last Heed().
  Traffic traffic_;
  bool census_changed_ = false;  ///< Descriptions or agents differ from the last clock sample.
};

}  // namespace collision::client
