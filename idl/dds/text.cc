#include "idl/dds/text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace collision::dds {
namespace {

/// How many bytes the character at the front has; 0 if it is none. Table 3-7 of the Unicode
/// standard.
std::size_t CharacterLength(std::string_view text) {
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const auto between = [&](std::size_t i, int low, int high) {
    return i < text.size() && low <= at(i) && at(i) <= high;
  };
  const auto follow = [&](std::size_t i) { return between(i, 0x80, 0xBF); };
  const int first = at(0);
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return follow(1) ? 2 : 0;
  if (first < 0xF0) {
    const bool second = between(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follow(2) ? 3 : 0;
  }
  if (first > 0xF4) return 0;
  const bool second = between(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
  return second && follow(2) && follow(3) ? 4 : 0;
}

}  // namespace

std::string Utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = CharacterLength(text);
    if (length == 0) {
      result += '?';
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string Printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace collision::dds
