// From an input to its effect on the world, the detector and the shapes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/codec/agent_classes.h"
#include "server/detectors/detectors.h"
#include "server/intake/agent_registry.h"
#include "server/intake/agent_shapes.h"
#include "server/intake/sender_clocks.h"
#include "server/intake/unproven_inputs.h"
#include "server/shapes/shape_store.h"
#include "server/world/rejections.h"
#include "server/world/world.h"

namespace collision::server {

/// Senders that are refused and remembered; of more, any is forgotten, and refused again with its
/// next hello.
inline constexpr std::size_t kUnfitMax = 256;

/// Messages since the start, beside the AgentCounters.
struct IntakeCounters {
  std::uint64_t removals_ignored = 0;  ///< Without a sender, and not of the owner's program.
  std::uint64_t descriptions_received = 0;
  std::uint64_t clocks_received = 0;
};

/// Takes one batch: Apply() for every input in order, TakeClocks(), EndBatch(). It decides which
/// simulator an input speaks for, has the codec validate it, and hands it on: to the AgentRegistry,
/// to the ShapeStore, or to the simulator's time. Everything refused goes to the rejections;
/// nothing else in the same message or batch is disturbed.
///
/// What was told of agents takes effect with Enact(). Between two calls only the newest state of an
/// agent counts and the order of arrival makes no difference, so that with a simulated clock the
/// same simulators always give the same events. One thread.
class Intake {
 public:
  /// Everything passed in outlives this. `instance`: of this service; what clocks acknowledge of
  /// another one's samples means nothing here.
  Intake(const v1::Config& config, std::uint64_t instance, World* world, Detectors* detectors,
         Rejections* rejections, ShapeStore* shapes);

  void Apply(const v1::Input& input);

  /// World::SucceedsLast() of this input's sender. Asked before Apply().
  bool SucceedsLast(const v1::Input& input) const;

  /// Whether this clock, which counts, says that its simulator follows this service.
  void NoteFollower(const v1::SimulatorClock& clock);

  /// Another service has ended this run: so does this one, where it does not know of it.
  void FollowEnd(const EndedRun& ended);

  /// Whether another service publishes in this world, or did lately (Clearances::Acknowledge()).
  void SetContended(bool contended) { contended_ = contended; }

  /// Brings clocks into force.
  void TakeClocks();

  /// Counts what has arrived, reports overdue descriptions and shapes, and frees what simulators
  /// that left had written.
  void EndBatch();

  /// Whether no agent of anybody will be left once what was told takes effect. O(agents).
  bool AllLeave() const;

  /// What was told of agents takes effect: admissions, states, revisions, removals.
  void Enact();

  /// Whether lock-step time waits for the shape of an agent.
  bool AwaitsShapes() const { return agent_shapes_.wait().Holds(world_.monotonic_ns()); }

  /// The shapes for which it waits, for the status.
  std::vector<std::string> AwaitedShapes() const;

  /// Removes the agents of the simulators that leave with the epoch, after their last clocks have
  /// come into force.
  void EndEpoch();

  /// Ends the run of a simulator: removes its agents and frees its shapes, as if it had done so.
  void EndRun(Simulator* simulator, EndCause cause);

  /// Ends the runs of World::Overdue() simulators. Returns their names.
  std::vector<std::string> RemoveSilent();

  /// The wall clock was set: every agent leaves the detector, to come back with its next state.
  void ExpelAgents();

  SenderClocks& sender_clocks() { return sender_clocks_; }
  const UnprovenInputs& unproven() const { return unproven_; }

  /// The simulators that are refused since their hello does not fit, each with the reason.
  std::vector<std::string> Unfit() const;

  const IntakeCounters& counters() const { return counters_; }
  const AgentCounters& agent_counters() const { return agents_.counters(); }

  /// The messages about breaches since the last call, without stamps.
  [[nodiscard]] std::vector<v1::AgentBreach> TakeBreaches() { return agents_.breaches().Take(); }

  /// The monotonic time at which the next missing name, description or shape is overdue, or the
  /// next count of breaches is due; nullopt: neither.
  std::optional<std::int64_t> NextDue() const;

 private:
  bool Names(const v1::SimulatorClock& clock) const;
  /// The simulator that the input speaks for, its former run ended where a new one begins; null:
  /// refused, or it waits for the name of its sender. `name`: as in World::ClaimFor().
  Simulator* Claimed(const v1::Input& input, Refusal where, const std::string* name);

  /// No simulator has this id, or its owner is gone, or at a standby seems to live: the input waits
  /// for a name that proves it.
  void AwaitName(const v1::Input& input, std::uint64_t simulator_id);

  /// A sender has named itself as this simulator: what it wrote before counts.
  void ApplyProved(const Simulator& simulator);
  void DropUnproven();

  /// Whether a removal is the owner's; else it is refused. `is_owners`: without a sender, what it
  /// names is the owner's.
  bool MayRemove(const Simulator& simulator, const v1::Input& input, bool is_owners,
                 const Refusal& refusal);

  /// A simulator says who it is. One that does not fit is refused, with all that it writes.
  void TakeHello(const v1::Input& input);
  /// Whether this sender's hello did not fit.
  bool IsUnfit(const v1::Input& input, const Refusal& where);
  void TakeDescription(const v1::Input& input);
  void TakeStates(const v1::Input& input);
  void TakeClock(const v1::Input& input);
  void TakeRemoval(const v1::Input& input);
  void TakeLiveliness(const v1::Input& input);
  void TakeShapePart(const v1::Input& input);
  void TakeShapeRemoval(const v1::Input& input);

  /// It has taken its agents with it before a clock of it has arrived: what it did while it was
  /// there counts, and no step of it follows.
  bool HasLeftUnheard(const Simulator& simulator) const;
  void Enact(Simulator* simulator);

  const std::uint64_t instance_;
  bool contended_ = false;
  World& world_;
  Detectors& detectors_;
  Rejections& rejections_;
  ShapeStore& shapes_;
  const AgentClasses classes_;
  AgentShapes agent_shapes_;
  AgentRegistry agents_;
  SenderClocks sender_clocks_;
  UnprovenInputs unproven_;
  const v1::ServiceHello hello_;
  struct Unfitting {
    std::string name;
    Refusal refusal;
  };
  std::map<std::uint64_t, Unfitting> unfit_;  ///< By sender.
  IntakeCounters counters_;
};

}  // namespace collision::server
