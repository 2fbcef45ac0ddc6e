// The page `collisionctl status`, for people.
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// Whatever the size of the world, the page has no more lines.
inline constexpr int kStatusLinesMax = 12;

/// The verdict, then what matters most of service, world, simulators, agents and events: at most
/// kStatusLinesMax lines. Requires a status.
std::string StatusPage(const WorldView& view);

}  // namespace collision::client
