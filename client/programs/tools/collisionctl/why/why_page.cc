#include "client/programs/tools/collisionctl/why/why_page.h"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "client/programs/tools/collisionctl/why/advice.h"
#include "collision/event_text.h"
#include "collision/shape.h"

namespace collision::client {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string Number(double value) { return NumberText(value, "%.6g"); }

std::string VectorText(const v1::Vector3& v) {
  return "(" + Number(v.x()) + ", " + Number(v.y()) + ", " + Number(v.z()) + ")";
}

std::string BodyText(const v1::AgentDescription& description) {
  constexpr std::size_t kBytesShown = 4;
  const std::string& hash = description.shape_hash();
  if (description.has_half_space()) {
    const v1::HalfSpace& half_space = description.half_space();
    return "all x with " + VectorText(half_space.normal()) +
           " · x <= " + Number(half_space.offset_m()) + " m";
  }
  return (hash.empty() ? "ball" : "shape " + HexText(hash.substr(0, kBytesShown)) + " in a ball") +
         " of " + Number(description.radius_m()) + " m" +
         (description.margin_m() > 0 ? " + margin " + Number(description.margin_m()) + " m" : "");
}

std::string BoundsText(const v1::AgentDescription& description) {
  std::string text = "D " + Number(description.acceleration_max_m_s2()) + " m/s²";
  text += ", J " + Number(description.jerk_max_m_s3()) + " m/s³";
  if (description.speed_max_m_s() > 0) {
    text += ", speed " + Number(description.speed_max_m_s()) + " m/s";
  }
  if (description.time_step_s() > 0) text += ", step " + Number(description.time_step_s()) + " s";
  return text;
}

/// "speed_max_m_s, 4 times", as of the last breach that was told.
std::string BrokenText(const AgentView& agent) {
  if (!agent.breach) return "nothing";
  return agent.breach->field() + ", " + std::to_string(agent.breach->count()) +
         (agent.breach->count() == 1 ? " time" : " times");
}

std::string ClearText(const AgentView& agent) {
  if (!agent.clearance) return "not told";
  const v1::AgentClearance& clearance = *agent.clearance;
  return SinceText(clearance.clear_until_ns()) + (clearance.saturated()   ? " saturated"
                                                  : clearance.not_clear() ? " not clear"
                                                                          : "");
}

/// A row of both agents.
using Cell = std::function<std::string(const BoundReport&)>;

void Add(const std::string& label, const PairReport& report, const Cell& cell, Rows* rows) {
  const auto text = [&cell](const BoundReport& one) {
    return IsDescribed(one.agent.description) ? cell(one) : std::string("-");
  };
  rows->push_back({label, text(report.a), text(report.b)});
}

void AddStates(const PairReport& report, Rows* rows) {
  const auto add = [&](const char* label,
                       const std::function<std::string(const v1::AgentState&)>& of) {
    Add(
        label, report,
        [&](const BoundReport& one) {
          return one.agent.state ? of(*one.agent.state) : std::string("-");
        },
        rows);
  };
  Add(
      "state", report,
      [](const BoundReport& one) {
        if (!one.agent.state) return std::string("none has come");
        return NumberText(std::abs(one.age), "%.3f") +
               (one.age < 0 ? " s ahead, at " : " s old, at ") +
               SinceText(one.agent.state->stamp_ns());
      },
      rows);
  add("position [m]", [](const auto& state) { return VectorText(state.position_m()); });
  add("velocity [m/s]", [](const auto& state) { return VectorText(state.velocity_m_s()); });
  add("acceleration [m/s²]",
      [](const auto& state) { return VectorText(state.acceleration_m_s2()); });
  add("errors", [](const auto& state) {
    return Number(state.position_error_m()) + " m, " + Number(state.velocity_error_m_s()) + " m/s";
  });
}

/// "0.06 m: acceleration 0.06" with the terms that are not 0.
std::string ReachText(const Reach& reach) {
  std::string terms;
  for (const auto& [name, metres] : {std::pair("position error", reach.position_error),
                                     {"velocity error", reach.velocity_error},
                                     {"acceleration", reach.acceleration},
                                     {"jerk", reach.jerk},
                                     {"skew", reach.skew}}) {
    if (metres == 0) continue;
    terms += (terms.empty() ? ": " : ", ") + std::string(name) + " " + NumberText(metres, "%.3g");
  }
  return NumberText(reach.Sum(), "%.3g") + " m" + terms;
}

/// "now", or "at 12.500 s" where a state lies ahead of now.
std::string FromText(const PairReport& report) {
  return report.from_ns == report.now_ns ? "now" : "at " + SinceText(report.from_ns);
}

/// What is not in the report where a state lies ahead of now.
std::string AheadText(const PairReport& report) {
  if (report.from_ns == report.now_ns) return "";
  return "; a state lies ahead of now: what was told of the time before " +
         SinceText(report.from_ns) + " is not looked at";
}

Rows AgentRows(const PairReport& report) {
  Rows rows = {{"", report.a.name, report.b.name}};
  Add(
      "body", report, [](const auto& one) { return BodyText(one.agent.description); }, &rows);
  Add(
      "bounds", report, [](const auto& one) { return BoundsText(one.agent.description); }, &rows);
  AddStates(report, &rows);
  const auto reach = [&](const std::string& label, Reach BoundReport::*member) {
    Add(
        label, report,
        [member](const BoundReport& one) {
          return one.unusable.empty() ? ReachText(one.*member) : std::string("-");
        },
        &rows);
  };
  reach("reach " + FromText(report), &BoundReport::first);
  if (report.earliest_ns && *report.earliest_ns != kNever) {
    reach("reach at the earliest", &BoundReport::at_earliest);
  }
  if (report.a.agent.breach || report.b.agent.breach) {
    Add(
        "broken", report, [](const auto& one) { return BrokenText(one.agent); }, &rows);
  }
  rows.push_back({"clear until", ClearText(report.a.agent), ClearText(report.b.agent)});
  return rows;
}

std::string Joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::string EventText(const PairReport& report, const WorldView& view) {
  if (!report.event) return "none";
  const Event event = FromMessage(*report.event);
  const auto name = [&view](const AgentId& id) { return view.FullName(id); };
  return std::string(Name(event.status)) + ": " +
         EventSentence(event, name, NowOf(*report.event, view), 0) + " (" +
         std::to_string(event.work_units) + " units of work, limited by " + Name(event.limited_by) +
         ")";
}

/// Between which the distance is told.
std::string PlacesText(const PairReport& report) {
  const bool to_plane =
      report.a.agent.description.has_half_space() || report.b.agent.description.has_half_space();
  return to_plane ? "the reference point and the plane" : "the reference points";
}

std::string ReachJson(const Reach& reach) {
  return JsonObject()
      .Number("position_error_m", reach.position_error)
      .Number("velocity_error_m", reach.velocity_error)
      .Number("acceleration_m", reach.acceleration)
      .Number("jerk_m", reach.jerk)
      .Number("skew_m", reach.skew)
      .Number("sum_m", reach.Sum())
      .Json();
}

std::string BoundJson(const BoundReport& bound, bool they_meet, const WorldView& view) {
  const bool usable = bound.unusable.empty();
  JsonObject object;
  object.Add("agent", AgentJson(bound.agent, view)).TextOrNull("unusable", bound.unusable);
  object.Number("age_s", usable ? bound.age : std::numeric_limits<double>::quiet_NaN());
  return object.Add("reach_at_from", usable ? ReachJson(bound.first) : "null")
      .Add("reach_at_earliest", usable && they_meet ? ReachJson(bound.at_earliest) : "null")
      .Json();
}

}  // namespace

std::string WhyPage(const PairReport& report, const WorldView& view) {
  std::string page = Table(AgentRows(report)) + "\n" + Line("now", SinceText(report.now_ns));
  if (report.earliest_ns) {
    page += Line("distance", NumberText(report.distance, "%.6g") + " m between " +
                                 PlacesText(report) + " " + FromText(report) + ", " +
                                 MetresText(report.gap, Rounding::kDown) +
                                 " m between all that they can reach");
    page += Line("earliest", *report.earliest_ns == kNever
                                 ? "never, from these bounds" + AheadText(report)
                                 : "not before " + InstantText(*report.earliest_ns, 0, 6) +
                                       ", from these bounds" + AheadText(report));
  }
  page += Line("apart", report.apart.empty() ? "nothing that they declare" : Joined(report.apart));
  if (!report.not_told.empty()) {
    page += Line("not told", Joined(report.not_told) + ": see the service's configuration");
  }
  return page + Line("event", EventText(report, view)) + Line("narrower by", AdviceOn(report));
}

std::string WhyJson(const PairReport& report, const WorldView& view) {
  const bool known = report.earliest_ns.has_value();
  const bool they_meet = known && *report.earliest_ns != kNever;
  const double none = std::numeric_limits<double>::quiet_NaN();
  JsonObject document = JsonDocument("why");
  document.Instant("now", report.now_ns)
      .Instant("from", report.from_ns)
      .Number("skew_s", report.skew)
      .Add("a", BoundJson(report.a, they_meet, view))
      .Add("b", BoundJson(report.b, they_meet, view))
      .Number("distance_m", known ? report.distance : none)
      .Number("gap_m", known ? report.gap : none)
      .Flag("computed", known)
      .Instant("earliest", report.earliest_ns.value_or(kNever))
      .Add("apart", JsonTexts(report.apart))
      .Add("not_told", JsonTexts(report.not_told));
  if (report.event) {
    JsonObject event;
    AddEvent(*report.event, view, &event);
    document.Add("event", event.Json());
  } else {
    document.Null("event");
  }
  return document.Text("advice", AdviceOn(report)).Json();
}

}  // namespace collision::client
