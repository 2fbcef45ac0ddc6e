// The agents of one simulator: their slots, what the service has been told of them, and what waits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/contract.h"
#include "client/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Which states are told, and how.
struct Telling {
  bool on_demand = false;    ///< Only the states that the service needs; false: every one.
  std::int64_t lead_ns = 0;  ///< So much before they are wanted.
  std::uint32_t chunk_size = 64;
};

/// Book-keeping only: the messages it returns are for the caller to write, in that order.
/// A slot is reused, the lowest free one first, with a new generation: ever-new keys would make the
/// network's histories grow for good.
///
/// On demand a state that is not needed stays staged until the next one takes its place, or until
/// the service wants it after all.
class Fleet {
 public:
  Fleet(std::string simulator_name, std::uint64_t simulator_id, std::uint32_t run,
        const Telling& telling);

  /// Gives a new agent its slot and stages its first state.
  AgentId Add(const AgentDescription& description, const State& state);

  /// The current description of an agent that is there, to be written after Add() and Describe().
  const v1::AgentDescription& description(const AgentId& id) const;
  void Describe(const AgentId& id, const AgentDescription& description);

  /// Staged until the clock comes to its stamp; a later call replaces what is staged, but a jump
  /// that was staged stays told. Throws std::invalid_argument if it is older than what has been told.
  void Stage(const AgentId& id, const State& state);

  v1::AgentRemoval Remove(const AgentId& id);
  bool Has(const AgentId& id) const;

  /// Would Tell() or a clock sample say anything new at this clock?
  bool HasNews(std::int64_t clock_ns) const;

  /// Everything that has been said and still holds, to say it anew.
  std::vector<v1::AgentDescription> Descriptions() const;
  std::vector<v1::AgentStates> Told() const;

  /// Takes over the staged states with stamps up to `clock_ns`: the chunks that changed, each with
  /// the latest told states of all its agents.
  std::vector<v1::AgentStates> Tell(std::int64_t clock_ns);

  /// The promise that goes with what has been told so far.
  v1::SimulatorClock Clock(std::int64_t clock_ns, bool lock_step);

  /// As of the service's time `now_ns`.
  void Hear(const v1::AgentClearance& clearance, std::int64_t now_ns);
  Clearance clearance(const AgentId& id) const;

  const Traffic& traffic() const { return traffic_; }

 private:
  struct Slot {
    bool occupied = false;
    v1::AgentDescription description;  ///< Holds the generation, also of a slot that is free.
    MotionBounds bounds;               ///< As described.
    std::optional<State> told;
    std::uint64_t told_sequence = 0;
    std::uint32_t told_revision = 0;  ///< Of the description, when `told` was.
    std::optional<State> staged;
    bool stands_in = false;      ///< `told` stands in for `staged`.
    std::uint64_t owed = 0;      ///< Sequence of the last state that had to be told, wanted or not.
    std::int64_t period_ns = 0;  ///< Between the last two stamps that were set.
    /// Sequence of the last jump until the service has acknowledged it; 0: none. Histories keep only the
    /// newest sample, so every state until then says that the motion jumped.
    std::uint64_t jump = 0;
    Clearance clearance;
    bool wanted_always = true;  ///< As far as we have heard: at every step.
    std::uint64_t acknowledged = 0;
  };

  std::uint32_t FreeSlot();
  static bool IsOwed(const Slot& slot);
  bool IsDue(const Slot& slot, std::int64_t clock_ns) const;
  void TellStaged(Slot* slot);
  v1::AgentState Message(std::uint32_t slot) const;
  v1::AgentStates Chunk(std::uint32_t chunk) const;

  std::string simulator_name_;
  std::uint64_t simulator_id_;
  std::uint32_t run_;
  Telling telling_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_;      ///< A heap, the lowest on top.
  std::vector<std::uint32_t> staged_slots_;    ///< Of agents with a staged state; some may be gone.
  std::vector<std::uint32_t> thinned_chunks_;  ///< They have lost an agent since they were told.
  std::uint32_t agents_ = 0;
  std::uint64_t states_sequence_ = 0;
  std::uint64_t descriptions_sequence_ = 0;
  Traffic traffic_;
  bool census_changed_ = false;  ///< Descriptions or agents differ from the last clock sample.
};

}  // namespace collision::client
