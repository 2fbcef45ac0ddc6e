// The world that a program joins, and its credentials, unless it says otherwise.
#pragma once

#include <cstdint>
#include <string>

#include "collision/export.h"

namespace collision::client {

/// COLLISION_WORLD if it is set and not empty; else "default". Reads the environment, as getenv
/// does: not while another thread changes it.
COLLISION_API std::string DefaultWorld();

/// The DDS domain COLLISION_DOMAIN if it is set and not empty; else 0. Throws
/// std::invalid_argument, with the variable and the allowed range, if it is no number from 0 to
/// 230.
COLLISION_API std::uint32_t DefaultDomain();

/// The folder of this program's credentials, COLLISION_CREDENTIALS, if it is set; else empty: it
/// has none (docker/SECURITY.md).
COLLISION_API std::string DefaultCredentials();

}  // namespace collision::client
