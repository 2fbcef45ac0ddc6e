// What Cyclone DDS says of itself.
#pragma once

#include <functional>
#include <string>

namespace collision::dds {

/// Hands on what Cyclone DDS would write to standard error: errors (`is_error`), warnings and
/// notes, a line each. Of the whole process, and for good; from any of its threads, one at a time.
void SetNetworkLog(std::function<void(bool is_error, const std::string& line)> write);

}  // namespace collision::dds
