// Names of simulators as one text of bounded length.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace collision::server {

/// "a, b, c": as many whole names as fit into `length_max` bytes; where some do not fit, it ends
/// with how many: "a, b, +7 more".
std::string NamesText(const std::vector<std::string>& names, std::size_t length_max);

}  // namespace collision::server
