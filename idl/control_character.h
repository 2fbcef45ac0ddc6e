// Characters that would steer a terminal or forge a line of a log.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace collision::wire {

/// Where the first control character of a text in UTF-8 is: U+0000 to U+001F, U+007F to U+009F;
/// nullopt: there is none.
constexpr std::optional<std::size_t> FindControl(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f) return i;
    const bool begins_c1 = byte == 0xc2 && i + 1 < text.size();
    if (begins_c1 && static_cast<unsigned char>(text[i + 1]) < 0xa0) return i;
  }
  return std::nullopt;
}

}  // namespace collision::wire
