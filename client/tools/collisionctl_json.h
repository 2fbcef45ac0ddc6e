// What collisionctl says to programs: protobuf JSON, field names as in idl/messages.proto, 64-bit
// integers as strings as that mapping has it. One line each, no newline.
#pragma once

#include <string>

#include "client/tools/collisionctl_view.h"

namespace collision::client {

/// Any message of idl/messages.proto, with every field printed.
std::string Json(const google::protobuf::Message& message);

/// {"agents": [{"description": AgentDescription, "state": AgentState, "clearance": AgentClearance},
/// ...]}, without what is not known.
std::string AgentsJson(const WorldView& view);

/// {"shapes": [{"hash": hexadecimal, "simulator": name, "agents": n, "triangles": n or null, "bytes":
/// n, "parts": n, "parts_seen": n}, ...]}
std::string ShapesJson(const WorldView& view);

}  // namespace collision::client
