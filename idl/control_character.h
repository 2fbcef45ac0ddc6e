// Characters that would steer a terminal or forge a line of a log.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace collision::wire {

/// Where the first character of a text in UTF-8 is that is not for reading; nullopt: there is none.
/// That are control characters (U+0000 to U+001F, U+007F to U+009F), the separators of lines and
/// paragraphs (U+2028, U+2029), and those that turn the direction of what follows (U+061C, U+200E,
/// U+200F, U+202A to U+202E, U+2066 to U+2069): with them a name looks like another one.
constexpr std::optional<std::size_t> FindControl(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t after) {
      return i + after < text.size() ? static_cast<unsigned char>(text[i + after]) : 0u;
    };
    const auto second = byte(1), third = byte(2);
    if (byte(0) < 0x20 || byte(0) == 0x7f) return i;
    if (byte(0) == 0xc2 && second >= 0x80 && second < 0xa0) return i;
    if (byte(0) == 0xd8 && second == 0x9c) return i;
    if (byte(0) != 0xe2) continue;
    const bool is_mark = third == 0x8e || third == 0x8f || (third >= 0xa8 && third <= 0xae);
    if (second == 0x80 && is_mark) return i;
    if (second == 0x81 && third >= 0xa6 && third <= 0xa9) return i;
  }
  return std::nullopt;
}

}  // namespace collision::wire
