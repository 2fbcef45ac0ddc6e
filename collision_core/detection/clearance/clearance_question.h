// A question about the clearance of one agent.
#pragma once

#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/base/instant.h"
#include "collision_core/detection/clearance/acceleration_tiers.h"
#include "collision_core/detection/clearance/partner_marks.h"

namespace collision::detection {

/// The group of a question about all partners (else one of AccelerationTiers::GroupOf).
inline constexpr int kEveryGroup = -1;

/// Which partners, of those not left out, may `agent` meet at or after `from`? All that a question
/// depends on beside the bounds themselves.
struct ClearanceQuestion {
  AgentIndex agent;
  int group = kEveryGroup;
  Instant from;     ///< min(now, covered)
  Instant covered;  ///< Up to here the agent is certified clear of the group's untracked partners.
  bool renewed = false;        ///< Nothing that was promised from `covered` on holds.
  bool was_saturated = false;  ///< Nothing was promised up to now.
  /// The tracked partners, which are left out, and those that become tracked in the course of it.
  PartnerMarks* tracked = nullptr;

  bool LeavesOut(AgentIndex partner, const AccelerationTiers& tiers) const {
    if (tracked->Contains(partner)) return true;
    return group != kEveryGroup && tiers.GroupOf(partner, agent) != group;
  }
};

/// The first meeting with a partner that is not tracked.
struct NextMeeting {
  Instant when = Instant::Never();  ///< Never(): none.
  AgentIndex partner;
};

}  // namespace collision::detection
