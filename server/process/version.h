// The version of this program.
#pragma once

namespace collision::server {

/// As CMakeLists.txt states it: `--version`, the status topic and recordings contain it.
inline constexpr char kVersion[] = COLLISION_VERSION;

}  // namespace collision::server
