// All contacts of a run, from the agents' exact motion.
#pragma once

#include <functional>
#include <vector>

#include "client/checker/motion/motion_truth.h"
#include "client/checker/motion/true_contact.h"

namespace collision::checker {

/// Whether two agents, which are not of one assembly, can meet.
using MayMeet = std::function<bool(const AgentMotion&, const AgentMotion&)>;

/// All contacts of agents that can meet, in order of begin. Boxes swept over slabs of time leave
/// the near pairs to the root finder, which leaves the spans in which balls overlap to the
/// triangles.
std::vector<TrueContact> TrueContacts(
    const std::vector<AgentMotion>& motions,
    const MayMeet& may_meet = [](const AgentMotion&, const AgentMotion&) { return true; });

}  // namespace collision::checker
