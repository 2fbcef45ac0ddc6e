// From an input to its effect: claims, checks, bookkeeping, the detector.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "collision_core/detection/detector.h"
#include "server/rejections.h"
#include "server/shape_store.h"
#include "server/world.h"

namespace collision::server {

/// What became of the inputs, since the start.
struct IntakeCounters {
  std::uint64_t states_received = 0;
  std::uint64_t states_accepted = 0;
  std::uint64_t states_older =
      0;  ///< Not newer than the newest of their agent, or of a former generation.
  std::uint64_t states_repeated = 0;  ///< Told again by a chunk, unchanged.
  std::uint64_t descriptions_received = 0;
  std::uint64_t clocks_received = 0;
  std::uint64_t agents_admitted = 0;
  std::uint64_t agents_removed = 0;
};

/// States that wait for a description, reported after a while; beyond, they are refused at once. As
/// many as one simulator has slots, so that no order of arrival after a restart loses any.
inline constexpr std::size_t kUndescribedMax = kSlotMax + 1;

/// Applies one batch: Apply() for every input in order, then EndBatch(). Everything refused goes to
/// the rejections; nothing else in the same message or batch is disturbed. One thread.
class Intake {
 public:
  /// Everything passed in outlives this.
  Intake(const v1::Config& config, World* world, detection::Detector* detector,
         Rejections* rejections, ShapeStore* shapes);

  void Apply(const v1::Input& input);

  /// Successors take over, clocks come into force, agents that waited for them are admitted, overdue
  /// descriptions and shapes are reported, what those who left had written is freed.
  void EndBatch();

  const IntakeCounters& counters() const { return counters_; }

  /// The monotonic time at which the next missing description or shape is reported; nullopt: none
  /// is missing.
  std::optional<std::int64_t> NextDue() const;

 private:
  struct Undescribed {
    std::int64_t due_ns;
    detection::AgentId agent;
    std::string shape = {};  ///< Its hash, where it is the shape that is missing.
  };

  /// The simulator the input speaks for, its former run ended where a new one begins; null:
  /// refused.
  Simulator* Claimed(const v1::Input& input, Refusal where, const std::string* name);

  /// What a successor that waits for the simulator's id removes waits with what it wrote before.
  /// False: its sender does not wait.
  bool HoldBehindItsLike(Simulator* simulator, const v1::Input& input);

  void TakeDescription(const v1::Input& input);
  void TakeStates(const v1::Input& input);
  void TakeState(Simulator* simulator, const v1::AgentStates& chunk, const v1::AgentState& state);
  void TakeClock(const v1::Input& input);
  void TakeRemoval(const v1::Input& input);
  void TakeLiveliness(const v1::Input& input);
  void TakeShapePart(const v1::Input& input);
  void TakeShapeRemoval(const v1::Input& input);
  void TakeShapeReady(const v1::ShapeReady& ready);

  void Describe(Simulator* simulator, const v1::AgentDescription& wire,
                const motion::AgentDeclaration& declaration);

  /// The agent refers to this shape from now on, and to no other; empty: to none.
  void ReferTo(const std::string& hash, Simulator* simulator, std::uint32_t slot, Agent* agent);

  /// Gives the agent its shape if that is visible and fits. Else it stays its ball.
  void GiveShape(Simulator* simulator, std::uint32_t slot, Agent* agent);
  void UpdateAgent(Simulator* simulator, std::uint32_t slot, Agent* agent, std::uint64_t sequence,
                   const motion::MotionState& state);
  void KeepWaiting(Simulator* simulator, std::uint32_t slot, const WaitingState& waiting);
  void AdmitIfComplete(Simulator* simulator, std::uint32_t slot);
  void RemoveAgent(Simulator* simulator, std::uint32_t slot);
  void RemoveAgents(Simulator* simulator);

  /// Whoever waits for the id of a simulator that has gone gets it.
  void HandOver(Simulator* simulator);
  void ReportUndescribed();
  void AwaitShape(const detection::AgentId& id, const std::string& hash);
  void ReportMissingShapes();
  void ReportMissingShape(const detection::AgentId& id, const std::string& hash);

  /// Frees the shapes of those who left.
  void ReleaseShapes();

  /// False: no room; a successor's parts are bounded like everybody's.
  bool Hold(Simulator* simulator, const v1::Input& input);
  void CountHeldBytes();

  void Refuse(const Refusal& refusal) {
    rejections_.Add(refusal, world_.Find(refusal.simulator_id), world_);
  }

  const std::uint32_t agents_max_;
  const std::int64_t undescribed_after_ns_;
  World& world_;
  detection::Detector& detector_;
  Rejections& rejections_;
  ShapeStore& shapes_;
  IntakeCounters counters_;
  std::deque<Undescribed> undescribed_;
  std::deque<Undescribed> shapes_awaited_;
  std::uint64_t held_shape_bytes_ = 0;  ///< Of all simulators.
};

}  // namespace collision::server
