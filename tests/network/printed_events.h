// The events that collisionctl has printed as JSON.
#pragma once

#include <string>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::network {

/// Of each event its agents, contact, place among the contacts, status and begin; lines that are no
/// event are left out.
std::vector<v1::CollisionEvent> ParseEvents(const std::string& lines);

}  // namespace collision::network
