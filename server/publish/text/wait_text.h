// Why the world's time waits for a simulator, in words for people.
#pragma once

#include <string>

#include "server/world/world.h"

namespace collision::server {

/// As the extension `waiting_why` of the status has it: "beta: not heard for more than 12 s". The
/// seconds count since its lease was over, so it was heard last before that.
std::string WaitText(const Awaited& awaited, const World& world);

}  // namespace collision::server
