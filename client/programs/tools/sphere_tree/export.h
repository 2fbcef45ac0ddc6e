// Exports sphere trees for other programs.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/tools/sphere_tree/report.h"

namespace collision::client {

/// Wavefront OBJ: one object ball_N per ball of the level, N its node: an icosahedron whose corners
/// lie on the ball, each triangle divided in four where the level has few balls. In metres, in the
/// body frame.
std::string LevelObj(const MeshTree& mesh_tree, std::uint32_t level);

/// The level's balls (message TreeLevel of idl/sphere_tree.proto) as JSON.
std::string LevelJson(const MeshTree& mesh_tree, std::uint32_t level);

/// The whole tree (message SphereTree of idl/sphere_tree.proto), binary.
std::string TreeBinary(const MeshTree& mesh_tree);

}  // namespace collision::client
