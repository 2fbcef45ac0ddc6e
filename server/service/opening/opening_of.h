// What the service knows that no input says, where a segment of the flight recorder begins.
#pragma once

#include "server/bus/clock.h"
#include "server/claim/service_claim.h"
#include "server/intake/intake.h"
#include "server/publish/publisher.h"
#include "server/recording/newest_inputs.h"
#include "server/world/world.h"

namespace collision::server {

/// As of now, between two steps. Requires that this service serves. O(agents).
Opening OpeningOf(const World& world, const ServiceClaim& claim);

/// A replay that begins with a later segment of a run: takes what OpeningOf() has put into its
/// claim. `reading`: of its first step, before which it has not stood still.
void GoOnFrom(const ClaimOptions& claim, const ClockReading& reading, World* world, Intake* intake,
              Publisher* publisher);

}  // namespace collision::server
