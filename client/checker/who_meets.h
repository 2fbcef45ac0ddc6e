// Which agents can meet, and which a level watches, by the service's configuration.
#pragma once

#include "client/checker/motion/motion_truth.h"
#include "idl/config.pb.h"

namespace collision::checker {

/// Whether the two can meet: neither their classes nor a pair that is excluded by name keep them
/// apart.
bool CanMeet(const v1::Config& config, const AgentMotion& a, const AgentMotion& b);

/// Whether the level is about two agents that can meet, by their classes.
bool Watches(const v1::Level& level, const AgentMotion& a, const AgentMotion& b);

}  // namespace collision::checker
