// The bounds within which a detector works.
#pragma once

#include <cstdint>

#include "collision_core/broad_phase/broad_phase_method.h"

namespace collision::detection {

/// Every limit of the detector, with what happens at it. SI units.
struct DetectorOptions {
  double temporal_resolution = 1.0 / 60;  ///< Δt [s]: pairs nearer than this in time could overlap.
  /// A possible contact is announced this long before it [s]; >= temporal_resolution.
  double announce_within = 2.0;
  double skew = 0;                  ///< κ [s]: a sender's clock is off by at most this.
  std::uint32_t agents_max = 1000;  ///< Admit() refuses beyond.
  /// Pairs tracked at once. Beyond, both agents are saturated and queried again after
  /// announce_within / 16 to announce_within / 8.
  std::uint32_t pairs_max = 65536;
  std::uint32_t pairs_per_agent_max = 256;  ///< Likewise for one agent.
  /// States of one agent that are kept; beyond, every second old state is dropped and brackets
  /// widen. >= 1.
  std::uint32_t history_max = 64;
  /// Work units that the narrow phase may spend on a pair of shapes in one evaluation
  /// (base/work_budget.h); beyond, brackets stay wider and are marked as limited by the budget.
  std::uint64_t work_units_per_evaluation = 40000;
  /// Likewise in one step, and in each temporal_resolution of `now`, on all pairs: shared out first
  /// among owners, then among their pairs (pairs/owner_queues.h, pairs/step_budget.h). Pairs beyond
  /// it wait for a later step. The last evaluations of pairs of which an agent leaves or expires
  /// come beside it: owners pay for them out of their credit. 0: no limit but each evaluation's.
  std::uint64_t work_units_per_step = 0;
  /// Of that, at most what an owner may spend in one step if some of its pairs have waited since an
  /// earlier one. It then gets its share of a temporal_resolution in several short steps, and holds
  /// up no other owner for longer than one of these. 0: its whole share at once.
  std::uint64_t work_units_per_slice = 0;
  /// How candidate pairs are found; changes the cost, never an answer.
  broad_phase::BroadPhaseMethod broad_phase = broad_phase::BroadPhaseMethod::kAuto;
};

}  // namespace collision::detection
