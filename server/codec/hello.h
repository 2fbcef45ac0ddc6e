// Who this service is, and which simulators fit it.
#pragma once

#include <optional>

#include "idl/config.pb.h"
#include "idl/messages.pb.h"
#include "server/codec/refusal.h"

namespace collision::server {

/// What a complete configuration states of the service and its world; not the instance.
v1::ServiceHello HelloOf(const v1::Config& config);

/// Why this simulator does not fit the service: its name has another id, or it has another wire
/// revision, clock kind or, where both state one, frame. nullopt: it fits.
std::optional<Refusal> CheckHello(const v1::SimulatorHello& hello, const v1::ServiceHello& service);

}  // namespace collision::server
