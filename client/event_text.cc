#include "client/event_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/types.h"

namespace collision::client {
namespace {

constexpr std::size_t kPairColumns = 28;

/// Three digits that are not below (up) or not above (down) the value.
std::string MetresText(double value, Rounding rounding) {
  if (value != 0 && std::isfinite(value)) {
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
    value = (rounding == Rounding::kUp ? std::ceil(value / unit) : std::floor(value / unit)) * unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value + 0.0);  // -0 becomes 0.
  return text;
}

std::string BracketText(const v1::TimeBracket& bracket, std::int64_t origin_ns) {
  const std::string latest = bracket.latest_ns() == kNever
                                 ? "open"
                                 : SecondsText(bracket.latest_ns(), origin_ns, 6, Rounding::kUp);
  return "[" + SecondsText(bracket.earliest_ns(), origin_ns, 6) + ", " + latest + "]";
}

/// An end without an upper limit only says until when the contact is known to last, if that is
/// known.
std::string EndText(const v1::CollisionEvent& event, std::int64_t origin_ns) {
  const v1::TimeBracket& end = event.end();
  if (end.latest_ns() != kNever) return BracketText(end, origin_ns);
  const bool known_to_last = event.begin().latest_ns() != kNever && end.earliest_ns() != kNever &&
                             end.earliest_ns() > event.begin().latest_ns();
  return known_to_last ? "≥ " + SecondsText(end.earliest_ns(), origin_ns, 6) : "open";
}

std::string GapText(const v1::CollisionEvent& event) {
  if (event.evaluated_at_ns() == kNever || !event.has_separation_m()) return "";
  const std::string upper = MetresText(event.separation_m().upper(), Rounding::kUp);
  if (event.separation_m().upper() <= 0) return "  gap ≤ " + upper + " m";
  return "  gap [" + MetresText(event.separation_m().lower(), Rounding::kDown) + ", " + upper +
         "] m";
}

}  // namespace

std::string Padded(std::string text, std::size_t columns) {
  const auto width = static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  if (width < columns) text.append(columns - width, ' ');
  return text;
}

std::string SecondsText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                        Rounding rounding) {
  if (instant_ns == kNever) return "never";
  std::int64_t unit = 1'000'000'000;
  for (int i = 0; i < decimals; ++i) unit /= 10;
  // A difference of two int64 needs 65 bits.
  const __int128 difference = static_cast<__int128>(instant_ns) - origin_ns;
  __int128 units = difference / unit;
  const bool exact = units * unit == difference;
  if (!exact && rounding == Rounding::kUp && difference > 0) ++units;
  if (!exact && rounding == Rounding::kDown && difference < 0) --units;
  const std::int64_t per_second = 1'000'000'000 / unit;
  const auto magnitude = static_cast<std::uint64_t>(units < 0 ? -units : units);
  std::string result = (units < 0 ? "-" : "") + std::to_string(magnitude / per_second);
  if (decimals == 0) return result;
  const std::string fraction = std::to_string(magnitude % per_second);
  return result + "." + std::string(decimals - fraction.size(), '0') + fraction;
}

const char* StatusText(v1::EventStatus status) {
  switch (status) {
    case v1::EVENT_POSSIBLE:
      return Name(EventStatus::kPossible);
    case v1::EVENT_CONFIRMED:
      return Name(EventStatus::kConfirmed);
    case v1::EVENT_DISMISSED:
      return Name(EventStatus::kDismissed);
    case v1::EVENT_UNDECIDED:
      return Name(EventStatus::kUndecided);
    case v1::EVENT_WITHDRAWN:
      return Name(EventStatus::kWithdrawn);
    case v1::EVENT_ENDED:
      return Name(EventStatus::kEnded);
    default:
      return "unknown";
  }
}

std::string EventLine(const v1::CollisionEvent& event, const AgentNamer& name,
                      std::int64_t origin_ns) {
  char head[64];
  std::snprintf(head, sizeof head, "%11s s  %-9s  ",
                SecondsText(event.now_ns(), origin_ns, 3).c_str(), StatusText(event.status()));
  return head + Padded(name(event.lower()) + " × " + name(event.higher()), kPairColumns) + "  #" +
         std::to_string(event.contact()) + " r" + std::to_string(event.revision()) + "  begin " +
         BracketText(event.begin(), origin_ns) + "  end " + EndText(event, origin_ns) +
         GapText(event);
}

}  // namespace collision::client
