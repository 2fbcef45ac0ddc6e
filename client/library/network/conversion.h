// Conversion between the plain values of client/include and the messages of idl/messages.proto.
#pragma once

#include "collision/monitor.h"
#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Everything except identity, revision and sequence, which the sender adds.
v1::AgentDescription ToMessage(const AgentDescription& description);
v1::AgentState ToMessage(const State& state);

AgentId FromMessage(const v1::AgentId& id);
State FromMessage(const v1::AgentState& state);
DescribedAgent FromMessage(const v1::AgentDescription& description);
SimulatorClock FromMessage(const v1::SimulatorClock& clock);

/// An event without a separation counts as evaluated at no instant.
Event FromMessage(const v1::CollisionEvent& event);
Clearance FromMessage(const v1::AgentClearance& clearance);
Rejection FromMessage(const v1::Rejection& rejection);
Rejection FromMessage(const v1::StandingRefusal& refusal, const v1::SimulatorReport& report);
Breach FromMessage(const v1::AgentBreach& breach);
EarliestIntersection FromMessage(const v1::EarliestIntersection& earliest);
ServiceStatus FromMessage(const v1::ServiceStatus& status);

}  // namespace collision::client
