// The pages of collisionctl for programs: protobuf JSON with the field names of idl/messages.proto
// and, as that mapping has it, 64-bit integers as strings. One line each, without a newline.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// Any message of idl/messages.proto, with every field printed.
std::string Json(const google::protobuf::Message& message);

/// The status of the service in force, and behind it one of each that stands by: a line each.
std::string StatusJson(const WorldView& view);

/// Among the events, where contacts were lost: {"contacts_missed": "how many since the last time",
/// "contacts_missed_so_far": "in all"}
std::string MissedJson(std::uint64_t more, std::uint64_t so_far);

/// The earliest intersection with the names of its agents, or {}.
std::string EarliestJson(const WorldView& view);

/// {"agents": [{"description": AgentDescription, "state": AgentState, "clearance": AgentClearance},
/// ...]}, without the parts that are not known. Where an agent is not simply there, it has
/// "presence": "silent", "waited_for", "not_held", "evicted" or "removed_silent". Where agents are
/// held of which nothing is known, "unknown": [{"simulator": name, "agents": n}, ...] follows.
std::string AgentsJson(const WorldView& view);

/// {"shapes": [{"hash": hexadecimal, "simulator": name, "agents": n, "triangles": n or null,
/// "solids": n or null, "bytes": n, "parts": n, "parts_seen": n}, ...]}
std::string ShapesJson(const WorldView& view);

}  // namespace collision::client
