// From an input to its effect on the world, the detector and the shapes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "collision_core/detection/detector.h"
#include "server/intake/agent_registry.h"
#include "server/intake/agent_shapes.h"
#include "server/intake/sender_clocks.h"
#include "server/shapes/shape_store.h"
#include "server/world/rejections.h"
#include "server/world/world.h"

namespace collision::server {

/// Messages since the start, beside the AgentCounters.
struct IntakeCounters {
  std::uint64_t descriptions_received = 0;
  std::uint64_t clocks_received = 0;
};

/// Applies one batch: Apply() for every input in order, then EndBatch(). It decides which simulator
/// an input speaks for, has the codec validate it, and hands it on: to the AgentRegistry, to the
/// ShapeStore, or to the simulator's time. Everything refused goes to the rejections; nothing else
/// in the same message or batch is disturbed. One thread.
class Intake {
 public:
  /// Everything passed in outlives this.
  Intake(const v1::Config& config, World* world, detection::Detector* detector,
         Rejections* rejections, ShapeStore* shapes);

  void Apply(const v1::Input& input);

  /// Lets successors take over, brings clocks into force, admits the agents that waited for them,
  /// reports overdue descriptions and shapes, and frees what simulators that left had written.
  void EndBatch();

  /// Removes the agents of the simulators that leave with the epoch, after their last clocks have
  /// come into force.
  void EndEpoch();

  /// The wall clock was set: every agent leaves the detector, to come back with its next state.
  void ExpelAgents();

  SenderClocks& sender_clocks() { return sender_clocks_; }

  const IntakeCounters& counters() const { return counters_; }
  const AgentCounters& agent_counters() const { return agents_.counters(); }

  /// The monotonic time at which the next missing description or shape is reported; nullopt: none
  /// is missing.
  std::optional<std::int64_t> NextDue() const;

 private:
  /// The simulator that the input speaks for, its former run ended where a new one begins; null:
  /// refused, and held if the sender may succeed the owner. `name`: as in World::ClaimFor().
  Simulator* Claimed(const v1::Input& input, Refusal where, const std::string* name);

  /// Whether the sender of a removal is the owner. A removal by a successor that waits for the id
  /// is held with what it wrote before; any other one is refused.
  bool MayRemove(const Simulator& simulator, const v1::Input& input, const Refusal& refusal);

  void TakeDescription(const v1::Input& input);
  void TakeStates(const v1::Input& input);
  void TakeClock(const v1::Input& input);
  void TakeRemoval(const v1::Input& input);
  void TakeLiveliness(const v1::Input& input);
  void TakeShapePart(const v1::Input& input);
  void TakeShapeRemoval(const v1::Input& input);

  void Hold(const Simulator& simulator, const v1::Input& input);

  /// If the simulator is gone, applies what is held for its id.
  void HandOver(Simulator* simulator);

  /// Brings the clocks of a simulator into force, for its agents too.
  void TakeClocks(Simulator* simulator);

  /// Parts of shapes that are held for successors take room in the store.
  void CountHeldBytes() { shapes_.SetHeldBytes(world_.succession().shape_bytes()); }

  World& world_;
  detection::Detector& detector_;
  Rejections& rejections_;
  ShapeStore& shapes_;
  AgentShapes agent_shapes_;
  AgentRegistry agents_;
  SenderClocks sender_clocks_;
  IntakeCounters counters_;
};

}  // namespace collision::server
