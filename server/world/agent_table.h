// The agents of one simulator, by slot, through all generations of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collision_core/detection/detector.h"
#include "idl/messages.pb.h"
#include "server/codec/hypothetical.h"
#include "server/world/clearances.h"

namespace collision::server {

/// What was declared of an agent before, for its states up to and including this sequence.
struct FormerDeclaration {
  motion::MotionLimits limits;
  bool same_shape = false;  ///< It had the shape that it has now.
  std::uint64_t until_sequence = 0;
};

/// A described agent. It is admitted to the detector once a state and, with a simulated clock, the
/// first clock of its simulator are there.
///
/// The intake may write the public members. The others stand in clearance samples, so only the
/// AgentTable changes them, and marks the sample.
class Agent {
 public:
  Agent(std::uint32_t generation, std::uint32_t revision, const detection::AgentDeclaration& told)
      : declaration(told),
        generation_(generation),
        revision_(revision),
        acknowledged_revision_(revision) {}

  detection::AgentDeclaration declaration;  ///< With its shape once that is visible.
  std::string shape_hash = {};              ///< Of the shape that it refers to; empty: the ball.
  std::shared_ptr<const void> names = {};   ///< Keeps the numbers of the filter's names.
  /// Hash and margin of the grown shape that it uses (shapes/grown_shapes.h).
  std::optional<std::pair<std::string, double>> grown = {};
  bool room_refused = false;               ///< Its owner got REJECTED_TOO_MANY_AGENTS.
  std::uint64_t description_sequence = 0;  ///< Of the description in force.
  std::uint64_t breaches = 0;              ///< How many of its states broke what was declared.
  std::shared_ptr<const v1::AgentLabel> label = {};  ///< What it is called there; null: nothing.
  /// The declaration before, while states that were written under it may still arrive.
  std::optional<FormerDeclaration> former = {};

  /// A state of this sequence has arrived.
  void EndFormer(std::uint64_t sequence) {
    if (former && sequence > former->until_sequence) former.reset();
  }

  bool hypothetical() const { return IsHypothetical(declaration); }
  std::uint32_t generation() const { return generation_; }
  std::uint32_t revision() const { return revision_; }
  /// The revision that counts for everybody, and since when, if it does not since the admission.
  std::uint32_t acknowledged_revision() const { return acknowledged_revision_; }
  Instant acknowledged_from() const { return acknowledged_from_; }
  bool admitted() const { return admitted_; }
  Instant stamp() const { return stamp_; }  ///< Of the newest state in force; else Always().
  std::uint64_t acknowledged_sequence() const { return acknowledged_sequence_; }  ///< Likewise.

 private:
  friend class AgentTable;

  std::uint32_t generation_;
  std::uint32_t revision_;
  std::uint32_t acknowledged_revision_;
  Instant acknowledged_from_ = Instant::Always();
  bool admitted_ = false;
  Instant stamp_ = Instant::Always();
  std::uint64_t acknowledged_sequence_ = 0;
};

/// A state that has not taken effect: the newest of its slot, or one before that counts as well: an
/// agent's first, a jump, or an end of a motion that was not declared.
struct WaitingState {
  std::uint32_t generation = 0;
  std::uint64_t sequence = 0;
  motion::MotionState state;
};

/// States of one agent that wait with its newest one; beyond, the oldest is dropped. What the agent
/// did up to the next one is not known then: that is no jump any more, so that it breaks what was
/// declared unless it could follow, and what was met in between is a doubt.
inline constexpr std::size_t kWaitingBeforeMax = 64;

/// What a state that arrives is, beside those before it.
enum class StateOrder {
  kNew,       ///< Newer than all of its slot.
  kRepeated,  ///< Seen before: a chunk repeats what has not changed.
  kEnded,     ///< Of a generation that has been removed or replaced.
};

/// The slots of one simulator in one run, and the Clearances of the agents in them.
///
/// A slot is reused with a higher generation; states and descriptions of ended generations may
/// still arrive and are recognised. Everything that a clearance sample says of an agent changes
/// here and marks its chunk. Lookups cost O(log slots). One thread.
class AgentTable {
 public:
  /// The described agent in `slot`; null: there is none.
  Agent* Find(std::uint32_t slot);
  const Agent* Find(std::uint32_t slot) const;

  /// The agent in `slot` if it has exactly this generation; else null.
  Agent* Find(std::uint32_t slot, std::uint32_t generation);
  const Agent* Find(std::uint32_t slot, std::uint32_t generation) const;

  /// What waits in `slot`, the newest last.
  std::span<const WaitingState> AllWaiting(std::uint32_t slot) const;

  /// The newest state that waits in `slot`; null: there is none.
  const WaitingState* Waiting(std::uint32_t slot) const;

  /// Whether `generation` of `slot` has been removed or replaced.
  bool HasEnded(std::uint32_t slot, std::uint32_t generation) const;

  /// Records that a state has arrived, accepted or not.
  StateOrder RecordState(std::uint32_t slot, std::uint32_t generation, std::uint64_t sequence);

  /// Adds an agent in `slot`; generations below its own have ended. Requires that the slot has no
  /// agent and that the generation has not ended.
  Agent* Add(std::uint32_t slot, const Agent& agent);

  /// A newer revision of the description of the agent in `slot` is in force. Of an agent that is
  /// admitted it counts with AcknowledgeRevision(). Requires an agent.
  void Revise(std::uint32_t slot, std::uint32_t revision,
              const detection::AgentDeclaration& declaration);

  /// This revision, if the agent in `slot` still has the generation, counts from `from` on.
  void AcknowledgeRevision(std::uint32_t slot, std::uint32_t generation, std::uint32_t revision,
                           Instant from);

  /// What becomes of the newest state that waits when a newer one comes.
  enum class Former { kReplaced, kWaitsOn };

  /// `waiting` is the newest state in `slot`. The one before waits on only of the same generation.
  void SetWaiting(std::uint32_t slot, const WaitingState& waiting, Former former);

  /// Hands out what waits in `slot`, the newest last, which then waits no more. Requires one.
  [[nodiscard]] std::vector<WaitingState> TakeWaiting(std::uint32_t slot);

  /// Drops what waits in `slot`.
  void DropWaiting(std::uint32_t slot);

  /// The agent in `slot` is in the detector from now on, with this state. Requires an agent.
  void Admit(std::uint32_t slot, Instant stamp, std::uint64_t sequence);

  /// The agent in `slot` is not in the detector any more: it waits for its next state, as after its
  /// description. A state that waits is dropped. Does nothing without an agent.
  void Expel(std::uint32_t slot);

  /// This state of the agent in `slot` is in force. Requires an agent.
  void Acknowledge(std::uint32_t slot, Instant stamp, std::uint64_t sequence);

  /// The detector gives an admitted agent a new clearance. One for an agent that is not there under
  /// this generation is ignored.
  void SetClearance(const detection::AgentClearance& clearance);
  void SetClearanceOfLevel(std::size_t level, const detection::AgentClearance& clearance);

  /// Removes the agent in `slot`, its clearance, and a state of the same generation that waits.
  /// Requires an agent.
  void Remove(std::uint32_t slot);

  /// A slot without an agent is given up: the state that waits in it, and its generation, have
  /// ended. Without one it does nothing.
  void RemoveWaiting(std::uint32_t slot);

  /// Empties all slots for a new run, and marks their chunks. Requires size() == 0.
  void Clear();

  /// Calls `visit(slot)` for each slot that was ever used in this run, in ascending order. `visit`
  /// may change agents, but no slot becomes used meanwhile.
  template <typename Visitor>
  void ForEachSlot(const Visitor& visit) const {
    for (const auto& [slot, content] : slots_) visit(slot);
  }

  std::size_t size() const { return agents_; }                  ///< Described agents.
  std::size_t real() const { return agents_ - hypothetical_; }  ///< Of them, those that are real.
  std::size_t stated() const { return stated_; }  ///< Of them, those of which a state has arrived.
  Clearances& clearances() { return clearances_; }
  const Clearances& clearances() const { return clearances_; }

  /// Walks everything and checks what must hold, with CORE_CHECK. For tests and debug builds.
  void Validate() const;

 private:
  struct Slot {
    std::optional<Agent> agent;
    std::vector<WaitingState> waiting;  ///< Those that count, and the newest.
    std::uint64_t ended = 0;            ///< Generations below have been removed or replaced.
    /// Generation and sequence of the newest state looked at, accepted or not.
    std::optional<std::pair<std::uint32_t, std::uint64_t>> handled;

    bool stated() const { return agent && handled && handled->first == agent->generation_; }
  };

  Agent& AgentIn(std::uint32_t slot);

  std::map<std::uint32_t, Slot> slots_;
  std::size_t agents_ = 0;
  std::size_t hypothetical_ = 0;
  std::size_t stated_ = 0;
  Clearances clearances_;
};

}  // namespace collision::server
