// Numbers in refusals.
#pragma once

#include <charconv>
#include <string>

namespace collision {

/// Shortest digits that name the number; the same on every platform and locale.
inline std::string NumberText(double x) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
  return {digits, end};
}

}  // namespace collision
