// Text from the network.
#pragma once

#include <string>
#include <string_view>

namespace collision::dds {

/// `text` with '?' for every byte that is not part of well-formed UTF-8 (RFC 3629).
std::string Utf8(std::string_view text);

/// `text` with '?' for all that is not printable ASCII: it may stand in a line of a log.
std::string Printable(std::string text);

}  // namespace collision::dds
