// The life of agents: description, first state, admission, updates, removal.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "server/detectors/detectors.h"
#include "server/intake/agent_breaches.h"
#include "server/intake/agent_shapes.h"
#include "server/intake/overdue_queue.h"
#include "server/intake/partner_names.h"
#include "server/world/rejections.h"
#include "server/world/world.h"

namespace collision::server {

/// Counts of states and agents by outcome, since the start.
struct AgentCounters {
  std::uint64_t states_received = 0;
  std::uint64_t states_accepted = 0;
  /// Not newer than the newest of their agent, or of an ended generation.
  std::uint64_t states_older = 0;
  std::uint64_t states_repeated = 0;  ///< A chunk repeats what has not changed.
  std::uint64_t admitted = 0;         ///< Agents.
  std::uint64_t removed = 0;          ///< Agents.
};

/// Keeps the agents of the world's simulators and those of the detector the same.
///
/// What is told of an agent is checked when it arrives and takes effect with Enact(): the newest
/// state with the jumps before it, the newest description, a removal. An agent enters the detector
/// when its description and a state are there and, with a simulated clock, the first clock of its
/// simulator is in force. A state without a description is kept and reported to its sender after
/// `undescribed_after_s`. If the world, or the quota of the simulator, has no room for another
/// agent, its owner gets one rejection; the agent is admitted with its next state once there is
/// room. A new generation ends the agent of its slot; late states of ended ones count as older. A
/// change that may lower promises counts from World::EffectiveFrom().
///
/// With a wall clock the states of one batch take effect one by one, since each narrows what could
/// have happened between its neighbours. One thread.
class AgentRegistry {
 public:
  /// Everything passed in outlives this.
  AgentRegistry(const v1::Config& config, World* world, Detectors* detectors,
                Rejections* rejections, AgentShapes* shapes);

  /// Takes a description from the owner of its simulator; `declaration`: as decoded, without the
  /// numbers of names.
  void Describe(Simulator* simulator, const v1::AgentDescription& wire,
                const detection::AgentDeclaration& declaration);

  /// Takes one state of a chunk from the owner of its simulator.
  void TakeState(Simulator* simulator, const v1::AgentStates& chunk, const v1::AgentState& wire);

  /// The owner gives up the agent in `slot`, or the generation of the state that waits there.
  /// `sequence` is that of its descriptions; if the slot was described later, a copy came late, and
  /// nothing happens. 0: it does not say.
  void Remove(Simulator* simulator, std::uint32_t slot, std::uint64_t sequence);

  /// Whether each agent of a simulator will be gone once what was told takes effect. O(agents).
  bool AllLeave(const Simulator& simulator) const;

  /// What was told of the agents of a simulator takes effect.
  void Enact(Simulator* simulator);

  /// Removes all agents of a simulator; states that wait for a description stay.
  void RemoveAll(Simulator* simulator);

  /// The detector forgets all agents of a simulator: each comes back with its next state, under the
  /// description that it has. States that wait are dropped.
  void ExpelAll(Simulator* simulator);

  /// No state of a simulator is believed any more: its agents expire, each to come back with its
  /// next state, and promises are void from `from` on. States that wait are dropped.
  void VoidAll(Simulator* simulator, Instant from);

  /// Reports states whose description has not arrived in time, to their senders.
  void ReportUndescribed();

  /// When ReportUndescribed() may next have something to report.
  std::optional<std::int64_t> NextDue() const { return undescribed_.next_ns(); }

  /// When a count of breaches is due.
  std::optional<std::int64_t> NextBreachDue() const { return breaches_.NextDue(); }

  /// What agents broke of what they declared.
  AgentBreaches& breaches() { return breaches_; }

  const AgentCounters& counters() const { return counters_; }

 private:
  /// What was told of a slot and has not taken effect, beside the state that waits in it.
  struct Told {
    /// The newest of an agent in the detector; others are in the table at once.
    std::optional<v1::AgentDescription> description = {};
    detection::AgentDeclaration declaration = {};  ///< As the description says.
    bool removed = false;                          ///< After the description.
  };

  /// A description of a known agent that would make it hypothetical, or real.
  std::optional<Refusal> CheckKind(const Simulator& simulator,
                                   const v1::AgentDescription& wire) const;
  void Introduce(Simulator* simulator, const v1::AgentDescription& wire,
                 detection::AgentDeclaration declaration);
  void Revise(Simulator* simulator, const v1::AgentDescription& wire,
              detection::AgentDeclaration declaration);
  /// Before the description becomes `agent`'s: what it replaces holds for states on their way.
  static void KeepFormer(const v1::AgentDescription& wire, Agent* agent);
  /// The description of this slot that has not taken effect; null: there is none.
  const v1::AgentDescription* ToldOf(const Simulator& simulator, std::uint32_t slot) const;
  bool IsDescribed(const Simulator& simulator, std::uint32_t slot, std::uint32_t generation) const;
  /// Of the newest description of the agent in the slot, in force or not; 0: there is none.
  std::uint64_t DescriptionSequence(const Simulator& simulator, std::uint32_t slot) const;
  void RemoveNow(Simulator* simulator, std::uint32_t slot);
  void EnactState(Simulator* simulator, std::uint32_t slot);
  void Update(Simulator* simulator, std::uint32_t slot, std::uint64_t sequence,
              const motion::MotionState& state);
  /// The declaration for a state that was written before the newest description.
  static detection::AgentDeclaration FormerOf(const Agent& agent);
  detection::UpdateOutcome UpdateFormer(const detection::AgentId& id, const Agent& agent,
                                        const motion::MotionState& state);
  /// Whether the newest state that waits counts beside `next`, which follows it: it is the first of
  /// an agent that is not admitted (unless `next` corrects it, being of the same time), a jump, or
  /// either end of a motion that the agent's declaration excludes. All others say nothing that the
  /// states before and after do not, and whether they arrive depends on the network.
  bool CountsBefore(const Simulator& simulator, std::uint32_t slot, const WaitingState& next) const;
  void SetWaiting(Simulator* simulator, std::uint32_t slot, const WaitingState& waiting);
  /// From its first state on that is late enough; what it has done since is known as well.
  void AdmitIfComplete(Simulator* simulator, std::uint32_t slot);
  /// Returns false if it is not admitted, which its owner is told.
  bool Admit(Simulator* simulator, std::uint32_t slot, const WaitingState& waiting);
  void RemoveAgent(Simulator* simulator, std::uint32_t slot, Agent* agent);
  /// The agent leaves the detector, if it is in it.
  void Withdraw(const Simulator& simulator, std::uint32_t slot, const Agent& agent);
  std::optional<std::string> RoomRefusal(const Simulator& simulator, const Agent& agent) const;
  void CountAccepted(Simulator* simulator);

  const std::uint32_t agents_max_;
  World& world_;
  Detectors& detectors_;
  Rejections& rejections_;
  AgentShapes& shapes_;
  /// By simulator and slot: each slot of which anything has been told since it last took effect.
  std::map<std::uint64_t, std::map<std::uint32_t, Told>> told_;
  PartnerNames names_;
  OverdueQueue<detection::AgentId> undescribed_;
  AgentBreaches breaches_;
  AgentCounters counters_;
};

}  // namespace collision::server
