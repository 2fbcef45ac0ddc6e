// The status for programs: a document of kind "status".
#pragma once

#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// The verdict, and all that the service in force and those that stand by say of themselves. One
/// line without a newline. Requires a status.
std::string StatusJson(const WorldView& view);

}  // namespace collision::client
