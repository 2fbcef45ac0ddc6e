// Text from the network.
#pragma once

#include <string>
#include <string_view>

namespace collision::dds {

/// `text` with '?' for every byte that is not part of well-formed UTF-8 (RFC 3629).
std::string Utf8(std::string_view text);

}  // namespace collision::dds
