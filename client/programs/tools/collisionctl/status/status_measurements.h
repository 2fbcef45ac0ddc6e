// What a service tells of its own process, and of how long its work takes.
#pragma once

#include <string>

#include "idl/messages.pb.h"

namespace collision::client {

/// Lines of the page: build, start, use of the machine, and for each histogram the ends of the
/// classes below which half, 99 of 100 and all values lie. Empty where the service tells none.
std::string MeasurementLines(const v1::ServiceStatus& status);

/// "3 d 4 h", "12 min", "9 s": the two greatest units at most.
std::string DurationText(std::int64_t ns);

}  // namespace collision::client
