// Agents, tables and a broad phase, by hand: all that a query about clearances reads.
#pragma once

#include <gtest/gtest.h>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/detection/clearance/keys/reported_clearances.h"
#include "collision_core/detection/clearance/search/pre_jump_motions.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {

/// Agents stand in the order of their indices and ids, with a margin of 0 in their wide bounds, so
/// that times are those of the agents' states. announce_within is 2 s, and now is 0 s.
struct ClearanceScene {
  explicit ClearanceScene(
      std::uint32_t pairs_per_agent_max = 256,
      broad_phase::BroadPhaseMethod method = broad_phase::BroadPhaseMethod::kAllPairs)
      : pairs({.pairs_per_agent_max = pairs_per_agent_max}, context), index(method) {}

  /// A settled agent that nothing limits: it has been queried, and its keys are never.
  AgentIndex Add(const Vector3d& p, const Vector3d& v, const motion::MotionLimits& limits = {1}) {
    const auto slot = static_cast<std::uint32_t>(agents.index_end());
    const AgentIndex agent = agents.Admit(Id(slot), {.limits = limits}, At(0));
    agents.Store(agent, State(0, p, v), Link::kJumped);
    agents.RecordBound(agent);
    pairs.AddAgent(agent);
    coverage.AddAgent(agent);
    reported.AddAgent(agent);
    index.Set(slot, agents[agent].wide_bound());
    coverage.Renew(agent, At(0), ClearanceCause::kAdmission);
    coverage.renewed()->Erase(agent);
    SetKey(agent, Instant::Never());
    return agent;
  }

  /// The next state of the agent.
  void Store(AgentIndex agent, double t, const Vector3d& p, const Vector3d& v,
             Link link = Link::kFollows) {
    agents.Store(agent, State(t, p, v), link);
    agents.RecordBound(agent);
    index.Set(agent.value(), agents[agent].wide_bound());
  }

  /// As a query leaves the agent: settled, with one key for all bands.
  void SetKey(AgentIndex agent, Instant key) {
    coverage[agent].renewed_from.reset();
    coverage[agent].renewed_cause = ClearanceCause::kNone;
    coverage[agent].keys.SetAll(key);
    coverage.KeysChanged(agent);
    coverage.MarkLowerable(agent);
  }

  /// A query about all partners that the agent is not tracked with, from now on.
  ClearanceQuery QueryOf(AgentIndex agent) {
    marks.Start(agent, pairs.table(), agents.index_end());
    marks.Add(agent);
    return {.agent = agent, .from = clock.now, .covered = clock.now, .tracked = &marks};
  }

  StepClock clock{.now = At(0), .step = 1, .announce_within = 2};
  AgentTable agents{{.agents_max = 10000}};
  DetectorCounters counters;
  IndexSet<AgentIndex> dirty;
  const DetectorContext context{clock, agents, &counters, &dirty};
  TrackedPairs pairs;
  CoverageTable coverage{context};
  ReportedClearances reported{context, pairs, coverage};
  broad_phase::AdaptiveBroadPhase index;
  PreJumpMotions former{std::make_unique<broad_phase::AdaptiveBroadPhase>(), 64};
  PartnerMarks marks;
};

/// Rounding down may cost this much of an exact time.
inline void ExpectNearlyAt(Instant when, double seconds) {
  EXPECT_LE(when, At(seconds));
  EXPECT_GT(when, At(seconds - 1e-6));
}

}  // namespace collision::detection
