// A level of a sphere tree as a picture.
#pragma once

#include <cstdint>
#include <string>

#include "client/tools/sphere_tree_report.h"

namespace collision::client {

/// SVG: the mesh, shaded, seen along the axis along which it is the shortest, under the balls of the
/// level, coloured by how far they may reach beyond the surface; a title, a scale and a legend.
std::string LevelPicture(const MeshTree& mesh_tree, std::uint32_t level);

}  // namespace collision::client
