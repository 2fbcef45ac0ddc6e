// From the core to the wire. Nothing is lost or rounded: the core's values are the published ones.
#pragma once

#include "collision_core/detection/detector.h"
#include "idl/messages.pb.h"

namespace collision::server {

v1::AgentId Encode(const detection::AgentId& id);
v1::CollisionEvent Encode(const detection::CollisionEvent& event);
v1::EarliestIntersection Encode(const detection::EarliestAnswer& answer);

/// `acknowledged_sequence` and `acknowledged_revision`: of the state and the description in force
/// for the agent; `state_wanted`: StateDemand::WantedAt().
v1::AgentClearance Encode(const detection::AgentClearance& clearance,
                          std::uint64_t acknowledged_sequence, std::uint32_t acknowledged_revision,
                          Instant state_wanted);

}  // namespace collision::server
