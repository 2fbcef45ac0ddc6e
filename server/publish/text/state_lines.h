// What the service knows, for people.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "collision_core/detection/earliest/earliest_answer.h"
#include "idl/messages.pb.h"
#include "server/world/world.h"

namespace collision::server {

/// "3 simulators, 112 agents, next contact not before 4.1 s": rounded down, from now on.
std::string StatusLine(const World& world, std::size_t agents,
                       const detection::EarliestAnswer& earliest);

/// The status as JSON, then a line for each agent, at most `agents_max`, and how many more there
/// are.
std::vector<std::string> StateLines(const v1::ServiceStatus& status, const World& world,
                                    std::size_t agents_max);

}  // namespace collision::server
