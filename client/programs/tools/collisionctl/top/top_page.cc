#include "client/programs/tools/collisionctl/top/top_page.h"

#include <algorithm>
#include <sstream>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

/// How long until the pair can touch at the earliest, or that it may now, or does.
std::string WhenText(const v1::CollisionEvent& event, std::int64_t now_ns) {
  const std::int64_t lead_ns = LeadTime(event, now_ns);
  const bool touches = event.status() == v1::EVENT_CONFIRMED;
  if (lead_ns == kNever) return "-";
  if (lead_ns == 0) return touches ? "now" : "now?";
  const bool is_ahead = event.begin().earliest_ns() > now_ns;
  return std::string(touches    ? "in "
                     : is_ahead ? "in ≥ "
                                : "in ≈ ") +
         SecondsText(lead_ns, 0, 3) + " s";
}

/// [earliest, latest], as far as they are known.
std::string BeginText(const Event& event) {
  const auto text = [](std::int64_t instant_ns, Rounding rounding) {
    return instant_ns == kNever ? std::string("open") : TimeText(instant_ns, 0, 3, rounding);
  };
  const std::string earliest =
      event.began_before ? "before" : text(event.begin.earliest_ns, Rounding::kDown);
  return "[" + earliest + ", " + text(event.begin.latest_ns, Rounding::kUp) + "]";
}

std::string GapText(const Event& event) {
  if (!event.proximity) return "-";
  const Proximity& proximity = *event.proximity;
  const std::string upper = MetresText(proximity.separation_upper_m, Rounding::kUp);
  if (proximity.separation_upper_m <= 0) return "≤ " + upper;
  return "[" + MetresText(proximity.separation_lower_m, Rounding::kDown) + ", " + upper + "]";
}

/// Of a pair that may touch: whether it does if both keep their motion.
std::string ExpectedText(const Event& event) {
  if (!event.expected) return "-";
  const Expectation& expected = *event.expected;
  switch (expected.outcome) {
    case ExpectedOutcome::kTouch:
      return "touch " + TimeText(expected.begin.earliest_ns, 0, 3, Rounding::kDown);
    case ExpectedOutcome::kPass:
      return expected.closest ? "pass ≥ " +
                                    MetresText(std::max(0.0, expected.closest->distance_lower_m),
                                               Rounding::kDown) +
                                    " m"
                              : "pass";
    case ExpectedOutcome::kUndecided:
      return "undecided";
  }
  return "-";
}

std::vector<std::string> Row(const v1::CollisionEvent& message, const WorldView& view) {
  const Event event = FromMessage(message);
  return {WhenText(message, NowOf(message, view)),
          BeginText(event),
          Name(event.status),
          GapText(event),
          ExpectedText(event),
          view.FullName(event.lower) + " × " + view.FullName(event.higher)};
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::vector<std::string> TopLines(const WorldView& view, const OpenEvents& events,
                                  bool service_alive, std::size_t rows) {
  const v1::ServiceStatus& status = *view.status();
  std::vector<std::string> lines = {
      service_alive ? Verdict(view).front() : "GONE: no service is heard; what follows is old",
      "world " + status.world() + ", now " + SinceText(status.now_ns()) +
          "; agents: " + std::to_string(status.agents()) + "; pairs that touch: " +
          std::to_string(events.confirmed()) + ", that may: " + std::to_string(events.possible())};
  std::vector<std::vector<std::string>> table = {
      {"WHEN", "BEGIN", "STATUS", "GAP [m]", "EXPECTED", "PAIR"}};
  for (const v1::CollisionEvent* event : events.Nearest(view, rows)) {
    table.push_back(Row(*event, view));
  }
  for (std::string& line : LinesOf(Table(table))) lines.push_back(std::move(line));
  if (table.size() == 1) lines.push_back("no pair touches or may touch");
  return lines;
}

std::string TopJson(const WorldView& view, const OpenEvents& events, bool service_alive,
                    std::size_t rows) {
  std::vector<std::string> pairs;
  for (const v1::CollisionEvent* event : events.Nearest(view, rows)) {
    JsonObject pair;
    AddEvent(*event, view, &pair);
    pairs.push_back(pair.Json());
  }
  const v1::ServiceStatus& status = *view.status();
  return JsonDocument("top")
      .Flag("service_alive", service_alive)
      .Text("verdict", Verdict(view).front())
      .Text("world", status.world())
      .Instant("now", status.now_ns())
      .Count("agents", status.agents())
      .Count("confirmed", events.confirmed())
      .Count("possible", events.possible())
      .Add("pairs", JsonArray(pairs))
      .Json();
}

}  // namespace collision::client
