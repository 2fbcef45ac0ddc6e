#include "client/programs/tools/collisionctl/why/pair_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "client/library/network/conversion.h"
#include "client/library/validation.h"
#include "client/programs/tools/collisionctl/why/agent_lookup.h"
#include "collision_core/broad_phase/half_space.h"
#include "collision_core/intersection/earliest_intersection.h"
#include "idl/hello_extensions.h"

namespace collision::client {
namespace {

Eigen::Vector3d ToCore(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// What decides about its path; both were validated.
motion::SpaceTimeBound ToCore(const BoundReport& report, double skew) {
  const v1::AgentDescription& description = report.agent.description;
  const v1::AgentState& state = *report.agent.state;
  motion::SpaceTimeBound bound;
  bound.skew = skew;
  bound.limits.radius = description.radius_m();
  bound.limits.acceleration_max = description.acceleration_max_m_s2();
  bound.limits.jerk_max = description.jerk_max_m_s3();
  bound.limits.time_step = description.time_step_s();
  if (description.speed_max_m_s() > 0) bound.limits.speed_max = description.speed_max_m_s();
  bound.state.stamp = Instant::FromNanoseconds(state.stamp_ns());
  bound.state.p_WA = ToCore(state.position_m());
  bound.state.v_WA = ToCore(state.velocity_m_s());
  bound.state.a_WA = ToCore(state.acceleration_m_s2());
  bound.state.position_error = state.position_error_m();
  bound.state.velocity_error = state.velocity_error_m_s();
  bound.state.direction = ToCore(state.thrust_direction());
  bound.state.direction_until = Instant::FromNanoseconds(state.direction_until_ns());
  bound.state.expiry = Instant::FromNanoseconds(state.expiry_ns());
  return bound;
}

/// Why nothing can be computed of the agent; empty: all can.
std::string Unusable(const AgentView& agent) {
  if (!IsDescribed(agent.description)) return "nothing is known of it";
  if (!agent.state) return "no state of it has come";
  try {
    Validate(FromMessage(agent.description).description);
    Validate(FromMessage(*agent.state));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

double Seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * (static_cast<double>(to_ns) - static_cast<double>(from_ns));
}

/// The centre of its ball.
Eigen::Vector3d CentreAt(std::int64_t ns, const v1::AgentState& state) {
  const double s = Seconds(state.stamp_ns(), ns);
  return ToCore(state.position_m()) + s * ToCore(state.velocity_m_s()) +
         0.5 * s * s * ToCore(state.acceleration_m_s2());
}

BoundReport BoundOf(const AgentView& agent, const PairReport& report, const WorldView& view) {
  BoundReport bound{.agent = agent,
                    .name = view.FullName(IdOf(agent)),
                    .unusable = Unusable(agent),
                    .first = {},
                    .at_earliest = {},
                    .fresh = {}};
  if (!bound.unusable.empty()) return bound;
  bound.age = Seconds(agent.state->stamp_ns(), report.now_ns);
  if (agent.description.has_half_space()) return bound;
  bound.first = ReachAfter(Seconds(agent.state->stamp_ns(), report.from_ns), report.skew,
                           agent.description, *agent.state);
  return bound;
}

bool Lists(const google::protobuf::RepeatedPtrField<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Either lists the other.
bool AreListed(const v1::AgentDescription& a, const v1::AgentDescription& b, bool never) {
  return never ? Lists(a.never_meets(), b.agent_name()) || Lists(b.never_meets(), a.agent_name())
               : Lists(a.meets_in_assembly(), b.agent_name()) ||
                     Lists(b.meets_in_assembly(), a.agent_name());
}

/// Whether one of the names in `list`, separated by blanks, is this.
bool Names(const std::string& list, const std::string& name) {
  return (" " + list + " ").find(" " + name + " ") != std::string::npos;
}

/// Whether two classes meet; nullopt: the service does not tell.
std::optional<bool> ClassesMeet(const std::string& a, const std::string& b, const WorldView& view) {
  const std::string key(wire::kClassExtension);
  const auto listed_by_a = view.HelloExtension(key + a), listed_by_b = view.HelloExtension(key + b);
  if (!listed_by_a || !listed_by_b) return std::nullopt;
  return Names(*listed_by_a, b) || Names(*listed_by_b, a);
}

void FindConfigured(const WorldView& view, PairReport* report) {
  const v1::AgentDescription& a = report->a.agent.description;
  const v1::AgentDescription& b = report->b.agent.description;
  if (!a.class_name().empty() && !b.class_name().empty()) {
    const std::optional<bool> meet = ClassesMeet(a.class_name(), b.class_name(), view);
    const std::string classes = "class " + a.class_name();
    if (!meet) report->not_told.push_back("whether " + classes + " meets class " + b.class_name());
    if (meet == false) report->apart.push_back(classes + " does not meet class " + b.class_name());
  }
  const auto excluded = view.HelloExtension(std::string(wire::kExcludedExtension));
  if (excluded == "0") return;
  report->not_told.push_back("whether the configuration excludes the pair" +
                             (excluded ? ", one of " + *excluded : std::string()));
}

void FindFilters(const WorldView& view, PairReport* report) {
  const v1::AgentDescription& a = report->a.agent.description;
  const v1::AgentDescription& b = report->b.agent.description;
  if (a.hypothetical() && b.hypothetical()) report->apart.push_back("both are hypothetical");
  if (a.simulator_id() == b.simulator_id()) {
    if (AreListed(a, b, true)) report->apart.push_back("one lists the other in never_meets");
    const bool together = !a.assembly().empty() && a.assembly() == b.assembly();
    if (together && !AreListed(a, b, false)) {
      report->apart.push_back("both are of assembly " + a.assembly() +
                              ", and neither lists the other in meets_in_assembly");
    }
  }
  for (const BoundReport* one : {&report->a, &report->b}) {
    if (!IsHeld(one->agent)) {
      report->apart.push_back("the service does not hold " + one->name);
    }
  }
  FindConfigured(view, report);
}

/// Of two agents, at most one of which is a half-space.
struct Meeting {
  double distance;
  Instant earliest;
};

Meeting MeetingOfBalls(const PairReport& report, double margin, Instant from) {
  const motion::SpaceTimeBound a = ToCore(report.a, report.skew);
  const motion::SpaceTimeBound b = ToCore(report.b, report.skew);
  const double distance = (CentreAt(report.from_ns, *report.a.agent.state) -
                           CentreAt(report.from_ns, *report.b.agent.state))
                              .norm();
  return {distance,
          intersection::EarliestIntersection(a, b, from, Instant::Never(), margin).instant()};
}

Meeting MeetingOf(const v1::HalfSpace& told, const BoundReport& agent, const PairReport& report,
                  double margin, Instant from) {
  const broad_phase::HalfSpace half_space{ToCore(told.normal()), told.offset_m()};
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, from, Instant::Never()};
  const Eigen::Vector3d centre = CentreAt(report.from_ns, *agent.agent.state);
  return {
      half_space.normal.dot(centre) - half_space.offset,
      EarliestIntersectionOf(query, half_space, {ToCore(agent, report.skew)}, margin).instant()};
}

/// Distance, earliest time, and how far each can be by then.
void Meet(PairReport* report) {
  const v1::AgentDescription& of_a = report->a.agent.description;
  const v1::AgentDescription& of_b = report->b.agent.description;
  if (of_a.has_half_space() && of_b.has_half_space()) {
    return report->apart.push_back("both are half-spaces");
  }
  const double margin = of_a.margin_m() + of_b.margin_m();
  const Instant from = Instant::FromNanoseconds(report->from_ns);
  const auto [distance, earliest] =
      of_a.has_half_space()   ? MeetingOf(of_a.half_space(), report->b, *report, margin, from)
      : of_b.has_half_space() ? MeetingOf(of_b.half_space(), report->a, *report, margin, from)
                              : MeetingOfBalls(*report, margin, from);
  report->distance = distance;
  report->gap = distance - of_a.radius_m() - of_b.radius_m() - margin - report->a.first.Sum() -
                report->b.first.Sum();
  report->earliest_ns = earliest.nanoseconds();
  if (NeverMoves(ToCore(report->a, report->skew)) && NeverMoves(ToCore(report->b, report->skew))) {
    report->apart.push_back("neither can move");
  }
  if (earliest.is_never()) return;
  for (BoundReport* one : {&report->a, &report->b}) {
    if (one->agent.description.has_half_space()) continue;
    const v1::AgentState& state = *one->agent.state;
    const double elapsed = Seconds(state.stamp_ns(), *report->earliest_ns);
    const double newest = std::min(elapsed, Seconds(report->now_ns, *report->earliest_ns));
    one->at_earliest = ReachAfter(elapsed, report->skew, one->agent.description, state);
    one->fresh = ReachAfter(newest, report->skew, one->agent.description, state);
  }
}

}  // namespace

Reach ReachAfter(double elapsed, double skew, const v1::AgentDescription& description,
                 const v1::AgentState& state) {
  const double sigma = elapsed + skew, step = description.time_step_s();
  const double speed = ToCore(state.velocity_m_s()).norm();
  const double known = ToCore(state.acceleration_m_s2()).norm();
  Reach reach;
  reach.position_error = state.position_error_m();
  reach.velocity_error = state.velocity_error_m_s() * sigma;
  reach.acceleration = 0.5 * description.acceleration_max_m_s2() * sigma * (sigma + step);
  reach.jerk = description.jerk_max_m_s3() / 6 * sigma *
               (sigma * sigma + 3 * step * sigma + 3 * step * step);
  reach.skew = speed * skew + known * (skew + 0.5 * step) * sigma;
  return reach;
}

PairReport ReportOn(const AgentView& a, const AgentView& b,
                    const std::optional<v1::CollisionEvent>& event, const WorldView& view) {
  PairReport report;
  report.now_ns = view.status()->now_ns();
  report.from_ns = report.now_ns;
  for (const AgentView* agent : {&a, &b}) {
    if (!Unusable(*agent).empty()) continue;
    report.from_ns = std::max<std::int64_t>(report.from_ns, agent->state->stamp_ns());
  }
  report.skew = 1e-9 * static_cast<double>(view.skew_max_ns());
  report.event = event;
  report.a = BoundOf(a, report, view);
  report.b = BoundOf(b, report, view);
  FindFilters(view, &report);
  if (report.a.unusable.empty() && report.b.unusable.empty()) Meet(&report);
  return report;
}

}  // namespace collision::client
