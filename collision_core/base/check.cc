#include "collision_core/base/check.h"

#include <cstdio>
#include <string>

namespace collision {

void ThrowCheckFailure(const char* condition, const char* file, int line, const char* message,
                       std::span<const double> values) {
  std::string text = std::string(file) + ":" + std::to_string(line) + ": " + message +
                     " (check failed: " + condition;
  for (const double value : values) {
    char number[32];
    std::snprintf(number, sizeof(number), "%.17g", value);
    text += "; ";
    text += number;
  }
  throw CheckFailure(text + ")");
}

}  // namespace collision
