// The order of events that arrive together.
#pragma once

#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// Moves the events behind everything else, in the order in which the service published them:
/// contacts and forecasts come through two topics, between which the network keeps no order. Where
/// another service's events begin, they stay behind those before them.
void OrderEvents(std::vector<v1::Output>* outputs);

}  // namespace collision::client
