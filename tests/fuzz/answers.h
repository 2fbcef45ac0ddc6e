// What every answer of the service and of the core must be, whatever was asked.
#pragma once

#include "idl/messages.pb.h"

namespace collision::fuzz {

/// Throws BrokenPromise unless brackets are ordered, numbers are numbers, and the status fits what
/// stands beside it.
void CheckEvent(const v1::CollisionEvent& event);
void CheckClearance(const v1::Clearance& clearance);
void CheckEarliest(const v1::EarliestIntersection& earliest);

/// The one of these that it is; and it must fit the network's types.
void CheckOutput(const v1::Output& output);

}  // namespace collision::fuzz
