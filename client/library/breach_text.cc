#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr int kDigits = 3;      // of what was seen, where they tell it from what was declared
constexpr int kDigitsMax = 17;  // tell every double

std::string Number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// The value without what lies behind `digits` digits. The printed digits are exact, so that the
/// number is not above the value.
double Truncated(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", 2 * kDigitsMax, value);
  const std::string all = text;
  const std::size_t digits_end = 1 + static_cast<std::size_t>(digits);  // "3.40": and the point
  return std::strtod((all.substr(0, digits_end) + all.substr(all.find('e'))).c_str(), nullptr);
}

std::string SeenText(const Breach& breach) {
  if (std::isinf(breach.seen)) return "no value explains what was seen";
  int digits = kDigits;
  while (digits < kDigitsMax && Truncated(breach.seen, digits) <= breach.declared) ++digits;
  const char* unit = breach.field == "thrust_direction" ? " m/s² against it" : "";
  return "at least " + Number(Truncated(breach.seen, digits), digits) + unit + " seen";
}

}  // namespace

std::string BreachText(const Breach& breach, const AgentNamer& name, std::int64_t origin_ns) {
  const std::string times = breach.count == 1 ? "once" : std::to_string(breach.count) + " times";
  return name(breach.agent) + " broke " + breach.field + ": declared " +
         Number(breach.declared, 6) + ", " + SeenText(breach) + " between " +
         InstantText(breach.from_ns, origin_ns, 3) + " and " +
         InstantText(breach.at_ns, origin_ns, 3, Rounding::kUp) + " (" + times + ")";
}

}  // namespace collision::client
