#include "client/programs/tools/suggest_bounds/bounds_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/programs/tools/collisionctl/json/json_writer.h"

namespace collision::client {
namespace {

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string NameIn(const SuggestedBounds& bounds) {
  return bounds.simulator.empty() ? bounds.name : bounds.simulator + "/" + bounds.name;
}

std::string DeclaredText(const SuggestedBounds& bounds) {
  if (!bounds.declared) return "-";
  std::string text = Short(bounds.declared->acceleration_max_m_s2);
  if (bounds.declared->jerk_max_m_s3 > 0) text += ", " + Short(bounds.declared->jerk_max_m_s3);
  return text;
}

/// Of an agent of which nothing is known between two states.
std::string BareRow(const std::string& name, const SuggestedBounds& bounds) {
  char text[256];
  std::snprintf(text, sizeof text, "%-28s %8zu %10s %10s %10s  %-5s %10s %10s  %s\n", name.c_str(),
                bounds.samples, "-", "-", "-", "-", "-", "-", DeclaredText(bounds).c_str());
  return text;
}

std::string Row(const std::string& name, const SuggestedBounds& bounds) {
  if (bounds.pieces == 0) return BareRow(name, bounds);
  const auto& angular = bounds.angular_acceleration_max_rad_s2;
  char text[256];
  std::snprintf(
      text, sizeof text, "%-28s %8zu %10s %10s %10s  %-5s %10s %10s  %s\n", name.c_str(),
      bounds.samples, RoundedUpText(bounds.acceleration_max_m_s2).c_str(),
      RoundedUpText(bounds.deviation_max_m_s2).c_str(), RoundedUpText(bounds.jerk_max_m_s3).c_str(),
      bounds.known_is_narrower ? "yes" : "no", RoundedUpText(bounds.speed_max_m_s).c_str(),
      angular ? RoundedUpText(*angular).c_str() : "-", DeclaredText(bounds).c_str());
  return text;
}

std::string BasisText(const SuggestedBounds& bounds, const BoundsRequest& request) {
  if (bounds.is_proof) return "a proof for the curve through the rows, rounded up";
  const std::string share = request.quantile >= 1 ? "all that was seen"
                                                  : "what " + Short(100 * request.quantile) +
                                                        " % of the pieces between two states need";
  return "an estimate: " + share + ", and " + Short(100 * request.margin) + " % more";
}

std::string AgentJson(const SuggestedBounds& bounds) {
  const auto& angular = bounds.angular_acceleration_max_rad_s2;
  const auto number = [&bounds](double value) {
    return bounds.pieces > 0 ? JsonNumber(value) : std::string("null");
  };
  JsonObject json;
  json.TextOrNull("simulator", bounds.simulator)
      .TextOrNull("name", bounds.name)
      .Count("states", bounds.samples)
      .Text("basis", bounds.is_proof ? "proof" : "estimate")
      .Add("acceleration_max_m_s2", number(bounds.acceleration_max_m_s2))
      .Add("known", JsonObject()
                        .Add("acceleration_max_m_s2", number(bounds.deviation_max_m_s2))
                        .Add("jerk_max_m_s3", number(bounds.jerk_max_m_s3))
                        .Flag("narrower", bounds.known_is_narrower)
                        .Json())
      .Add("speed_max_m_s", number(bounds.speed_max_m_s))
      .Add("angular_acceleration_max_rad_s2", angular ? JsonNumber(*angular) : "null");
  if (!bounds.declared) return json.Null("declared").Json();
  return json
      .Add("declared", JsonObject()
                           .Number("acceleration_max_m_s2", bounds.declared->acceleration_max_m_s2)
                           .Number("jerk_max_m_s3", bounds.declared->jerk_max_m_s3)
                           .Json())
      .Json();
}

}  // namespace

std::string RoundedUpText(double value) {
  if (!(value > 0)) return "0";
  const double step = std::pow(10, std::floor(std::log10(value)) - 3);
  double rounded = std::ceil(value / step) * step;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", rounded);
  for (; std::strtod(text, nullptr) < value; rounded += step) {
    std::snprintf(text, sizeof text, "%.4g", rounded + step);
  }
  return text;
}

std::string BoundsPage(const BoundsSource& source, const std::vector<SuggestedBounds>& all,
                       const BoundsRequest& request) {
  std::string page = source.name + " (" + source.kind + "): bounds of " +
                     std::to_string(all.size()) + " agents, " + BasisText(all.front(), request) +
                     "\n\n";
  char head[256];
  std::snprintf(head, sizeof head, "%-28s %8s %10s %10s %10s  %-5s %10s %10s  %s\n", "agent",
                "states", "M m/s2", "D m/s2", "J m/s3", "known", "speed m/s", "rad/s2", "declared");
  page += head;
  for (const SuggestedBounds& bounds : all) page += Row(NameIn(bounds), bounds);
  if (all.size() > 1) page += Row("all", GreatestOf(all, request.look_ahead_s));
  const auto is_bare = [](const SuggestedBounds& bounds) { return bounds.pieces == 0; };
  if (std::ranges::any_of(all, is_bare)) {
    page += "\n-: one state alone tells nothing about acceleration; two without a jump do.\n";
  }
  return page +
         "\nAn agent declares acceleration_max M; or, if its states tell their acceleration, D "
         "and\n"
         "jerk_max J. known: so the bound is smaller after " +
         Short(request.look_ahead_s) +
         " s. rad/s2: angular_acceleration_max of an agent that turns.\n";
}

std::string BoundsJson(const BoundsSource& source, const std::vector<SuggestedBounds>& all,
                       const BoundsRequest& request) {
  std::vector<std::string> agents;
  for (const SuggestedBounds& bounds : all) agents.push_back(AgentJson(bounds));
  return JsonDocument("bounds")
             .Text("source", source.name)
             .Text("source_kind", source.kind)
             .Number("quantile", request.quantile)
             .Number("margin", all.front().is_proof ? 0 : request.margin)
             .Number("look_ahead_s", request.look_ahead_s)
             .Add("agents", JsonArray(agents))
             .Add("all", AgentJson(GreatestOf(all, request.look_ahead_s)))
             .Json() +
         "\n";
}

}  // namespace collision::client
