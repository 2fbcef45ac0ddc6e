// The page `collisionctl status`, for people.
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// For whom time waits and why; what has failed; which simulators take more than their share; the
/// services, simulators, broad phase and why, what is left out, refusals. Requires a status.
std::string StatusPage(const WorldView& view);

}  // namespace collision::client
