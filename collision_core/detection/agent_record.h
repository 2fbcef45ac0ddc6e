// What the detector holds of one agent.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/detection/agent_keys.h"
#include "collision_core/detection/detector.h"
#include "collision_core/detection/history.h"
#include "collision_core/detection/key_margin.h"
#include "collision_core/detection/scene_profile.h"

namespace collision::detection {

/// What the detector keeps about one agent.
struct AgentRecord {
  static constexpr std::uint64_t kNotAsked = ~std::uint64_t{0};

  AgentId id;
  motion::AgentDeclaration
      declaration;  ///< Counts for the next state on; the newest bound has its own.
  History history;
  Instant heard = Instant::Always();          ///< The owner has told everything up to here.
  Instant admitted_from = Instant::Always();  ///< Nothing is known, or promised, of it before.
  bool expired = false;
  /// Removed, as the how manieth, but what it told reaches beyond now; 0: not removed.
  std::uint64_t leaving = 0;
  bool reshaped = false;  ///< Its shape was declared anew since the newest state.

  AgentKeys keys;                  ///< Of a saturated agent they promise nothing.
  std::uint32_t next_partner = 0;  ///< A partner that may be met at the first, as far as is known.
  /// Nothing promised before holds from here on (admission, jump, breach, widening): ask everybody
  /// anew.
  std::optional<Instant> renewed_from;
  ClearanceCause renewed_cause = ClearanceCause::kNone;
  std::uint64_t asked = 0;           ///< The step in which it was last asked, or kNotAsked.
  KeyMargin margin;                  ///< What is left of it since the last renewal.
  bool changed = false;              ///< Since the last step: listed as such.
  bool touched = false;              ///< Its clearance may have changed: listed as such.
  bool saturated = false;            ///< Listed as such.
  std::size_t saturated_at = 0;      ///< Where in that list.
  std::uint32_t crowded_with = 0;    ///< Saturated: a partner that could not be tracked.
  std::vector<std::uint32_t> pairs;  ///< Slots of the tracked pairs.
  SceneProfile::Features features = 0;

  /// What was last told, and why it was lowered since.
  std::optional<AgentClearance> told;
  ClearanceCause cause = ClearanceCause::kNone;
  AgentId cause_agent;
  Instant void_from = Instant::Never();
  Instant effective_from = Instant::Always();

  const motion::SpaceTimeBound& bound() const { return history.newest(); }
  Instant stamp() const { return bound().state.stamp; }
};

}  // namespace collision::detection
