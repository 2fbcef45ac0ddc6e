// Why an event ended, where it did not end by what the agents' motion tells.
#pragma once

#include "idl/messages.pb.h"

namespace collision::server {

class World;

/// The key of the extension that an event then carries. Its value is that of NameOf(EndCause),
/// where the service has ended the run of an agent; "left", where an agent has been removed.
inline constexpr char kBecause[] = "because";

/// Adds the extension to a final revision about an agent that is gone, unless the contact has ended
/// before that. An event of any other agent stays as it is, bit for bit.
void AddBecause(const World& world, v1::CollisionEvent* event);

}  // namespace collision::server
