#include "collision_core/detection/clearance/search/uncovered_search.h"

#include <algorithm>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// On paths and sums of reaches. From the state to the sum they take up to 20 operations on terms
/// of one sign, of 2^-53 each: 1 + 2^-48 would do. A millionth is far beyond that; a ball that is
/// wider by so little meets hardly another agent, and each one costs a test only.
constexpr double kPathSlack = 1.000001;
/// Room for the rounding of places, as a part of their distance from the origin.
constexpr double kPlaceSlack = 1e-12;
/// A finite error [m] for a reach that overflows: no canonical routine sees an infinite one.
constexpr double kReachMax = 1e300;
/// So small that it adds nothing [m/s²], but not 0: the ball stands for an agent that moves, and
/// two bounds that never move are not compared.
constexpr double kNotAtRest = 1e-30;

/// |v| t + A t (t + h), with A = M + J (t + h) the greatest acceleration until then, what is known
/// of it included, is more than the path that either direction of the horn allows, with room for
/// the rounding of all this.
struct Mover {
  double speed, acceleration_max, jerk_max, time_step;

  double Path(double t) const {
    const double fastest = acceleration_max + jerk_max * (t + time_step);
    return kPathSlack * (speed + fastest * (t + time_step)) * t;
  }
};

/// The path of one agent from its newest state.
double PathOf(const motion::SpaceTimeBound& bound, double t) {
  const motion::MotionLimits& limits = bound.limits;
  return Mover{bound.state.v_WA.norm() + bound.state.velocity_error,
               limits.acceleration_max + bound.state.a_WA.norm(), limits.jerk_max, limits.time_step}
      .Path(t);
}

/// In seconds, with twice the skew: once for each clock.
double Span(Instant a, Instant b, double skew) {
  return b <= a ? 0 : numeric::SecondsBetween(a, b).upper + 2 * skew;
}

/// Whether the agent may get from its newest bound, within t seconds of it, into the ball of
/// `around`, `reach` wide beside its radius.
bool GetsInto(const motion::SpaceTimeBound& around, double reach,
              const motion::SpaceTimeBound& bound, double t) {
  const double sum = reach + around.limits.radius + bound.limits.radius +
                     2 * bound.state.position_error + PathOf(bound, t);
  const double magnitude = around.state.p_WA.norm() + bound.state.p_WA.norm();
  return !((around.state.p_WA - bound.state.p_WA).norm() >
           kPathSlack * sum + kPlaceSlack * magnitude);
}

}  // namespace

Instant UncoveredFrom(const AgentRecord& a, const AgentRecord& b, Instant covered) {
  return std::max({covered, a.admitted_from, b.admitted_from});
}

const std::vector<UncoveredPartner>& UncoveredSearch::Find(const ClearanceQuery& query) {
  uncovered_.clear();
  const AgentRecord& record = context_.agents[query.agent];
  const Instant covered = query.covered;
  // Otherwise every agent is covered beyond its own newest state: one whose state lies beyond its
  // key is renewed or queried first of all, unless it is saturated.
  const bool none_saturated = coverage_.saturated().empty();
  if (!query.renewed && record.stamp() <= covered && none_saturated) return uncovered_;
  FindCandidates(query, query.renewed ? std::max(covered, record.admitted_from) : covered);
  for (const AgentIndex partner : candidates_) Check(query, partner);
  return uncovered_;
}

void UncoveredSearch::FindCandidates(const ClearanceQuery& query, Instant from) {
  candidates_.clear();
  if (context_.agents.extremes().newest <= from) return;
  if (context_.agents[query.agent].is_half_space()) return AddAll();
  const History& history = context_.agents[query.agent].history;
  history.ForEachMotion(
      from, [&](const motion::SpaceTimeBound& motion) { FindAround(query, motion, from); });
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

// No ball contains a half-space. It is queried once, when it comes.
void UncoveredSearch::AddAll() {
  for (std::size_t k = 0; k < context_.agents.index_end(); ++k)
    candidates_.push_back(AgentIndex(k));
}

// Adds the agents that may have met this motion between `from` and the newest states.
void UncoveredSearch::FindAround(const ClearanceQuery& query, const motion::SpaceTimeBound& motion,
                                 Instant from) {
  const AgentTable& agents = context_.agents;
  const SceneExtremes::Bounds& scene = agents.extremes();
  const double others_time = Span(from, scene.newest, agents.skew());
  const Mover any{scene.speed_max, scene.acceleration_max, scene.jerk_max, scene.time_step_max};
  const double others = 2 * scene.position_error_max + any.Path(others_time);
  const double own = OwnReach(motion, from);
  motion::SpaceTimeBound around;
  around.state.stamp = from;
  around.state.p_WA = motion.state.p_WA;
  around.state.position_error = std::min(own + others, kReachMax);
  around.limits.radius = motion.limits.radius;
  around.limits.acceleration_max = kNotAtRest;
  const broad_phase::AgentBound guest{around, agents[query.agent].declaration.filter};
  const auto skip = [&](std::uint32_t index) {
    const AgentIndex partner(index);
    return partner == query.agent || query.LeavesOut(partner, coverage_.tiers());
  };
  found_.clear();
  broad_phase_->FindNeighbours(guest, from, scene.newest, skip, &found_);
  for (const broad_phase::Neighbour& neighbour : found_) {
    const AgentRecord& partner = agents[AgentIndex(neighbour.partner)];
    const double time = Span(partner.stamp(), scene.newest, agents.skew());
    if (partner.is_half_space() ||
        GetsInto(around, own, partner.wide_bound().bound, std::max(others_time, time))) {
      candidates_.push_back(AgentIndex(neighbour.partner));
    }
  }
  former_->Find(guest, from, scene.newest, &candidates_);
}

// How far from its stated position the agent may have been in this motion since `from`.
double UncoveredSearch::OwnReach(const motion::SpaceTimeBound& motion, Instant from) const {
  const double skew = context_.agents.skew();
  const Instant stamp = motion.state.stamp, newest = context_.agents.extremes().newest;
  const double time = std::max({Span(from, stamp, skew), Span(stamp, newest, skew), 2 * skew});
  return motion.state.position_error + PathOf(motion, time);
}

void UncoveredSearch::Check(const ClearanceQuery& query, AgentIndex partner) {
  const AgentTable& agents = context_.agents;
  if (partner == query.agent || !agents.Contains(partner)) return;
  const AgentRecord &record = agents[query.agent], &other = agents[partner];
  if (other.expired || query.LeavesOut(partner, coverage_.tiers()) ||
      !queries_.MayMeet(query.agent, partner)) {
    return;
  }
  Instant free_until = query.renewed ? UncoveredFrom(record, other, query.covered) : query.covered;
  if (!query.renewed && !coverage_.IsSaturated(partner)) {
    free_until = std::max(free_until, coverage_.KeyOf(partner, query.agent));
  }
  const Instant known_from = std::max(record.stamp(), other.stamp());
  if (free_until >= known_from || FreeOver(query.agent, partner, free_until, known_from)) return;
  uncovered_.push_back({partner, free_until});
}

bool UncoveredSearch::FreeOver(AgentIndex a, AgentIndex b, Instant from, Instant to) const {
  const History::Sample* of_a = context_.agents[a].history.Uninterrupted(from);
  const History::Sample* of_b = context_.agents[b].history.Uninterrupted(from);
  if (of_a == nullptr || of_b == nullptr) return false;
  return queries_.EarliestUnder({a, of_a->bound, of_a->filter}, {b, of_b->bound, of_b->filter},
                                from) >= to;
}

}  // namespace collision::detection
