// The page `collisionctl top`.
#pragma once

#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/top/open_events.h"

namespace collision::client {

/// Lines without newlines: the verdict, the world, and a table of at most `rows` pairs, the nearest
/// in time first.
std::vector<std::string> TopLines(const WorldView& view, const OpenEvents& events,
                                  bool service_alive, std::size_t rows);

/// The same as a document of kind "top", in one line without a newline.
std::string TopJson(const WorldView& view, const OpenEvents& events, bool service_alive,
                    std::size_t rows);

}  // namespace collision::client
