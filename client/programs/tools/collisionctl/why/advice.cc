#include "client/programs/tools/collisionctl/why/advice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

/// A part of the reach, and what makes it smaller.
struct Part {
  double metres;
  std::string remedy;
};

/// The parts add up to the reach when the pair can meet.
void AddParts(const BoundReport& bound, std::vector<Part>* parts) {
  const Reach& fresh = bound.fresh;
  const std::string of = " of " + bound.name;
  parts->push_back(
      {bound.at_earliest.Sum() - fresh.Sum(),
       "a newer state" + of + ": its last is " + NumberText(bound.age, "%.2g") + " s old"});
  parts->push_back({fresh.position_error, "a smaller position_error_m in the states" + of});
  parts->push_back({fresh.velocity_error, "a smaller velocity_error_m_s in the states" + of});
  parts->push_back(
      {fresh.acceleration, "a smaller acceleration_max_m_s2" + of +
                               ", with the acceleration that its owner knows in its states"});
  parts->push_back({fresh.jerk, "a smaller jerk_max_m_s3" + of});
  parts->push_back({fresh.skew, "clocks that differ less, and a smaller clock.skew_max_s"});
}

/// What the pair's event says was short; empty: nothing but the motion.
std::string EventRemedy(const PairReport& report) {
  if (!report.event) return "";
  if (report.event->limited_by() == v1::LIMIT_BUDGET) {
    return "more working time: its event is limited by budget (time_budget_us)";
  }
  if (report.event->limited_by() == v1::LIMIT_GEOMETRY) {
    return "finer shapes: its event is limited by geometry";
  }
  return "";
}

}  // namespace

std::string AdviceOn(const PairReport& report) {
  if (!report.apart.empty())
    return "nothing: the pair is not looked at, since " + report.apart.front();
  for (const BoundReport* one : {&report.a, &report.b}) {
    if (!one->unusable.empty()) return "what is missing of " + one->name + ": " + one->unusable;
  }
  if (*report.earliest_ns == kNever) return "nothing: from these bounds they never meet";
  const std::string remedy = EventRemedy(report);
  if (!remedy.empty()) return remedy;
  std::vector<Part> parts;
  AddParts(report.a, &parts);
  AddParts(report.b, &parts);
  const double all = report.a.at_earliest.Sum() + report.b.at_earliest.Sum();
  const auto most = std::max_element(
      parts.begin(), parts.end(), [](const Part& x, const Part& y) { return x.metres < y.metres; });
  // What is told leaves almost nothing open beside the bodies themselves.
  constexpr double kLittle = 0.01;
  const double bodies =
      report.a.agent.description.radius_m() + report.b.agent.description.radius_m();
  if (all <= kLittle * bodies) {
    return "nothing: their motion itself brings them together, all that is not known of it is " +
           MetresText(all, Rounding::kUp) + " m";
  }
  return most->remedy + "; that makes up " + NumberText(100 * most->metres / all, "%.0f") +
         " % of the reach of both, " + MetresText(all, Rounding::kUp) + " m";
}

}  // namespace collision::client
