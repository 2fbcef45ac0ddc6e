// Between the plain values of types.h and the messages of idl/messages.proto.
#pragma once

#include "client/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Everything but identity, revision and sequence, which the sender adds.
v1::AgentDescription ToMessage(const AgentDescription& description);
v1::AgentState ToMessage(const State& state);

AgentId FromMessage(const v1::AgentId& id);
Event FromMessage(const v1::CollisionEvent& event);
Clearance FromMessage(const v1::AgentClearance& clearance);
Rejection FromMessage(const v1::Rejection& rejection);

}  // namespace collision::client
