// Until when one agent is certified clear of contacts.
#pragma once

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"

namespace collision::detection {

/// Why a clearance was lowered.
enum class ClearanceCause {
  kNone,       ///< Not lowered, or for none of the causes below.
  kAdmission,  ///< An agent was admitted.
  kTeleport,   ///< An agent jumped: a declared discontinuity.
  kBreach,     ///< An agent broke its bound.
  kWidening,   ///< An agent promises less than before.
  kSkew        ///< The clock of an agent's owner is off by more than is allowed for.
};

/// What is published to one agent, as of a step: until when no new contact can begin.
struct AgentClearance {
  AgentId agent{};
  Instant clear_until = Instant::Never();  ///< No new contact begins before this.
  bool not_clear = false;                  ///< clear_until is not later than now.
  bool in_contact = false;                 ///< A contact is confirmed and has not ended.
  bool saturated = false;                  ///< More partners qualify than are tracked.
  /// Before this the agent can meet only partners with which it has an open event; >= clear_until.
  Instant unannounced_until = Instant::Never();
  /// The latest end of a contact or doubt whose bracket newer states will narrow; Always(): none.
  Instant unsettled_until = Instant::Always();
  /// The clearances of other agents take account of this agent's latest admission, jump, breach or
  /// widening from this instant on.
  Instant effective_from = Instant::Always();
  /// What changed it. With a `void_from` it need not be lower; with kNone it may be lower, where a
  /// contact ended or the agent became saturated.
  ClearanceCause cause = ClearanceCause::kNone;
  AgentId cause_agent{};  ///< The agent that caused it; meaningful unless kNone.
  /// With kBreach and kSkew: earlier clearances are void from here.
  Instant void_from = Instant::Never();
};

}  // namespace collision::detection
