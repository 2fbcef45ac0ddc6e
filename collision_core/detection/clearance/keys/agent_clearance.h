// Until when one agent is certified clear of contacts.
#pragma once

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"

namespace collision::detection {

/// Why a clearance was lowered.
enum class ClearanceCause { kNone, kAdmission, kTeleport, kBreach, kWidening, kSkew };

/// The promise to one agent, as of a step.
struct AgentClearance {
  AgentId agent{};
  Instant clear_until = Instant::Never();  ///< No new contact begins before.
  bool not_clear = false;                  ///< clear_until has come: a contact may begin.
  bool in_contact = false;                 ///< A contact is confirmed and has not ended.
  bool saturated = false;                  ///< More partners than are tracked for one agent.
  /// Until then the agent meets no partner but those of announced events; >= clear_until.
  Instant unannounced_until = Instant::Never();
  /// A contact, or a doubt, has ended by then, and a newer state will narrow it; Always(): none.
  Instant unsettled_until = Instant::Always();
  Instant effective_from =
      Instant::Always();  ///< Promises include the latest admission, jump or widening from here.
  ClearanceCause cause = ClearanceCause::kNone;  ///< Of the last lowering.
  AgentId cause_agent{};
  Instant void_from = Instant::Never();  ///< With kBreach: earlier promises are void from here.
};

}  // namespace collision::detection
