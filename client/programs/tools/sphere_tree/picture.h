// Draws a level of a sphere tree.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/tools/sphere_tree/report.h"

namespace collision::client {

/// SVG of the shaded mesh, seen along its shortest axis, under the balls of the level, coloured by
/// how far they may reach beyond the surface; with title, scale and legend.
std::string LevelPicture(const MeshTree& mesh_tree, std::uint32_t level);

}  // namespace collision::client
