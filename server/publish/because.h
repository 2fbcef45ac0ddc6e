// Why an event ended, where the service itself ended it.
#pragma once

#include "idl/messages.pb.h"
#include "server/world/silence/ended_runs.h"

namespace collision::server {

/// The key of the extension that an event then carries; its value is that of NameOf(EndCause).
inline constexpr char kBecause[] = "because";

/// Adds the extension to a final revision about an agent whose run the service has ended. An event
/// of any other agent stays as it is, bit for bit.
void AddBecause(const EndedRuns& ended, v1::CollisionEvent* event);

}  // namespace collision::server
