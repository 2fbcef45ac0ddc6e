// An event as a line for people.
#pragma once

#include <cstdint>
#include <string>

#include "collisionPubSubTypes.h"

namespace example {

/// An instant in seconds with all nine decimals; "open" for INT64_MAX.
std::string Seconds(std::int64_t instant_ns);

/// "sim/ada × sim/bob  #1 r4  confirmed  begin [4.749390153, 4.750609847]  end [...]"
std::string EventLine(const collision::v1::CollisionEvent& event);

}  // namespace example
