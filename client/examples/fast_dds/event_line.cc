// An event as a line for people.
#include "event_line.h"

#include <cstdio>
#include <limits>

namespace example {
namespace {

using namespace collision::v1;

std::string Text(const TimeBracket& bracket) {
  return "[" + Seconds(bracket.earliest_ns()) + ", " + Seconds(bracket.latest_ns()) + "]";
}

std::string Text(const AgentLabel& label) {
  return label.simulator_name().to_string() + "/" + label.agent_name().to_string();
}

std::string Text(EventStatus status) {
  switch (status) {
    case EVENT_POSSIBLE:
      return "possible";
    case EVENT_CONFIRMED:
      return "confirmed";
    case EVENT_DISMISSED:
      return "dismissed";
    case EVENT_UNDECIDED:
      return "undecided";
    case EVENT_WITHDRAWN:
      return "withdrawn";
    case EVENT_ENDED:
      return "ended";
  }
  return "status " + std::to_string(status);  // Of a newer service.
}

}  // namespace

std::string Seconds(std::int64_t instant_ns) {
  if (instant_ns == std::numeric_limits<std::int64_t>::max()) return "open";
  constexpr std::int64_t kSecond = 1'000'000'000;
  char text[32];
  std::snprintf(text, sizeof text, "%s%lld.%09lld", instant_ns < 0 ? "-" : "",
                std::abs(static_cast<long long>(instant_ns / kSecond)),
                std::abs(static_cast<long long>(instant_ns % kSecond)));
  return text;
}

std::string EventLine(const CollisionEvent& event) {
  std::string line = Text(event.lower_label()) + " × " + Text(event.higher_label()) + "  #" +
                     std::to_string(event.contact()) + " r" + std::to_string(event.revision()) +
                     "  " + Text(event.status()) + "  begin " + Text(event.begin()) + "  end " +
                     Text(event.end());
  const std::string level = event.level().to_string();
  if (!level.empty()) line += "  of level " + level;
  return line;
}

}  // namespace example
