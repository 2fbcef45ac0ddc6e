// What an event tells beside its brackets, from the histories of its two agents.
#pragma once

#include "collision_core/detection/agents/agent_record.h"
#include "collision_core/detection/events/announcer.h"

namespace collision::detection {

/// Within what an event's facts are looked for.
struct FactLimits {
  Instant now;                        ///< What is expected counts from here.
  double ahead = 0;                   ///< How far ahead [s].
  std::uint64_t proximity_units = 0;  ///< For the proximity at one instant.
  std::uint64_t expected_units = 0;   ///< For what is expected.
};

/// Answers from the kept states, and counts the work: that of the proximity as work_units, which a
/// step's budget limits, that of what is expected as encounter_units. What it refers to outlives
/// it.
class EventFacts final : public EncounterSource {
 public:
  EventFacts(const AgentRecord& lower, const AgentRecord& higher, const FactLimits& limits,
             DetectorCounters* counters)
      : lower_(lower), higher_(higher), limits_(limits), counters_(counters) {}

  EncounterAnswer At(Instant at) override;
  ExpectationAnswer Expected() override;

 private:
  const AgentRecord& lower_;
  const AgentRecord& higher_;
  const FactLimits limits_;
  DetectorCounters* counters_;
};

/// How fast the higher agent moves against the lower one at `at`, at a place known to within
/// `point_error`: by the states in force there, with what is not known of them. A ball counts as
/// not turning. None where a state is not kept any more, or a shape's turning is not declared.
///
/// Derivation. The state's velocity is off by at most ε_v; σ = |t − stamp| + κ later the
/// acceleration has added what is told to within |a| (κ + h) and what is not by D (σ + h) + ½ J (σ
/// + h)²: an integrator of step h is at most one step ahead. Of the turning, ω changes by at most α
/// (σ + h), at an arm known to the point's error and the centre's u.
std::optional<RelativeVelocity> RelativeVelocityAt(const History& lower, const History& higher,
                                                   Instant at, const Eigen::Vector3d& point,
                                                   double point_error);

}  // namespace collision::detection
