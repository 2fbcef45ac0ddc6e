// What the detector holds of one agent.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/detection/detector.h"
#include "collision_core/detection/history.h"

namespace collision {

struct AgentRecord {
  AgentId id;
  AgentDeclaration declaration;  ///< Counts for the next state on; the newest bound has its own.
  History history;
  Instant heard = Instant::Always();          ///< The owner has told everything up to here.
  Instant admitted_from = Instant::Always();  ///< Nothing is known, or promised, of it before.
  bool expired = false;
  bool reshaped = false;  ///< Its shape was declared anew since the newest state.

  /// Certified free of every partner that is not tracked up to here.
  Instant key = Instant::Always();
  /// Nothing promised before holds from here on (admission, jump, breach, widening): ask everybody
  /// anew.
  std::optional<Instant> renewed_from;
  ClearanceCause renewed_cause = ClearanceCause::kNone;
  std::uint64_t asked = 0;  ///< The step in which it was last asked.
  /// How far kept states may lie off by rounding, summed since the last renewal.
  double position_drift = 0;
  double velocity_drift = 0;
  bool changed = true;  ///< Since the last step.
  bool saturated = false;
  std::vector<std::uint32_t> pairs;  ///< Slots of the tracked pairs.

  /// What was last told, and why it was lowered since.
  std::optional<AgentClearance> told;
  ClearanceCause cause = ClearanceCause::kNone;
  AgentId cause_agent;
  Instant void_from = Instant::Never();
  Instant effective_from = Instant::Always();

  const SpaceTimeBound& bound() const { return history.newest(); }
  Instant stamp() const { return bound().state.stamp; }
};

}  // namespace collision
