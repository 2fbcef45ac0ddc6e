// The page `collisionctl status --all`, for people.
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// The whole verdict, and everything that a status tells: the services, the broad phase and why,
/// what is left out, refusals, counters, and every simulator. Requires a status.
std::string StatusDetails(const WorldView& view);

}  // namespace collision::client
