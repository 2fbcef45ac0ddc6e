// What a new declaration changes before the next state comes.
#pragma once

#include "collision_core/detection/agents/agent_record.h"

namespace collision::detection {

/// What a change of a bound means for answers that rely on it.
enum class BoundChange {
  kWithin,  ///< The agent can meet nothing that it could not meet before: answers stay valid.
  kWidened  ///< The agent may meet more than before: answers must be computed anew.
};

/// Makes `declaration` the agent's. The filter and everything wider than before are in force at
/// once; narrower limits from the next state on. A shape that had been awaited is in force from the
/// state on with which it was awaited; a shape that changes is somewhere within the ball until the
/// next state. Another tree of the same body takes the former tree's place in the whole history.
/// Requires that an awaited shape is null.
BoundChange ApplyDeclaration(const AgentDeclaration& declaration, AgentRecord* record);

/// Whether `next` promises more than `before` in some respect, so that the agent may be unable to
/// meet a partner that it could meet before.
bool IsNarrower(const motion::MotionLimits& before, const motion::MotionLimits& next);

}  // namespace collision::detection
