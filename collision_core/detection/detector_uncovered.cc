// What lies between the time up to which pairs are covered and their newest states.
//
// The broad phase answers from the newest states on. Where those lie ahead (an owner was granted more
// time than others, news came out of order), what lies before must be free as well, or the pair is
// tracked and judged.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// |v| t + M t (t + h) is more than the path that either direction of the horn allows, and has room
/// for the rounding of all this.
double Path(double speed, double acceleration_max, double time_step, double t) {
  return 1.000001 * (speed + acceleration_max * (t + time_step)) * t;
}

/// Of one agent, from where its newest state says.
double PathOf(const motion::SpaceTimeBound& bound, double t) {
  return Path(bound.state.v_WA.norm() + bound.state.velocity_error,
              bound.declaration.acceleration_max, bound.declaration.time_step, t);
}

/// Twice the skew: of either clock.
double Span(Instant a, Instant b, double skew) {
  return b <= a ? 0 : numeric::SecondsBetween(a, b).upper + 2 * skew;
}

/// Whether the agent may get from its newest bound, within so much time of it, into the ball of
/// `around`, `reach` wide beside its radius.
bool GetsInto(const motion::SpaceTimeBound& around, double reach,
              const motion::SpaceTimeBound& bound, double t) {
  const double sum = reach + around.declaration.radius + bound.declaration.radius +
                     2 * bound.state.position_error + PathOf(bound, t);
  const double magnitude = around.state.p_WA.norm() + bound.state.p_WA.norm();
  return !((around.state.p_WA - bound.state.p_WA).norm() > 1.000001 * sum + 1e-12 * magnitude);
}

}  // namespace

void Detector::Implementation::TrackUncovered(std::uint32_t agent, bool renewed, Instant covered) {
  const AgentRecord& record = At(agent);
  // Else it is covered beyond its own newest state, and so is everybody else: whose state lies beyond
  // the key is renewed or asked first of all (AskAll), but for the saturated.
  if (!renewed && record.stamp() <= covered && saturated_.empty()) return;
  candidates_.clear();
  const Instant from = renewed ? std::max(covered, record.admitted_from) : covered;
  if (extremes_.bounds().newest > from) FindAround(agent, from);
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  for (const std::uint32_t partner : candidates_) {
    TrackIfUncovered(agent, partner, renewed, covered);
  }
}

void Detector::Implementation::TrackIfUncovered(std::uint32_t agent, std::uint32_t partner,
                                                bool renewed, Instant covered) {
  if (partner == agent || !agents_[partner]) return;
  const AgentRecord& record = At(agent);
  const AgentRecord& other = At(partner);
  if (other.expired || IsLeftOut(agent, partner) ||
      !CanMeet(record.bound().declaration, other.bound().declaration)) {
    return;
  }
  Instant free_until = renewed ? UncoveredFrom(record, other, covered) : covered;
  if (!renewed && !other.saturated) free_until = std::max(free_until, KeyOf(partner, agent));
  const Instant known_from = std::max(record.stamp(), other.stamp());
  if (free_until >= known_from || FreeOver(record, other, free_until, known_from)) return;
  Track(agent, partner, free_until, renewed);
  marks_[partner] = mark_;
}

// Appends to candidates_ whoever may have met the agent between `from` and its own, or the agent's,
// newest state. Each of the agent's motions since then (there is a new one after each jump) is
// replaced by a ball at rest that holds it all the time, and is wider by as far as anybody else may
// move in that time; so whoever met it overlaps that ball with its newest bound, or with what it had
// before it jumped. Of those found by their newest bounds only who moves as far itself counts: one
// that is violent does not have the others asked about each other.
void Detector::Implementation::FindAround(std::uint32_t agent, Instant from) {
  const SceneExtremes::Bounds& scene = extremes_.bounds();
  const double others_time = Span(from, scene.newest, options_.skew);
  const double others = 2 * scene.position_error_max + Path(scene.speed_max, scene.acceleration_max,
                                                            scene.time_step_max, others_time);
  const auto skip = [&](std::uint32_t partner) { return IsLeftOut(agent, partner); };
  At(agent).history.ForEachMotion(from, [&](const motion::SpaceTimeBound& motion) {
    const double own = OwnReach(motion, from);
    motion::SpaceTimeBound around;
    around.state.stamp = from;
    around.state.p_WA = motion.state.p_WA;
    around.state.position_error = std::min(own + others, 1e300);
    around.declaration.radius = motion.declaration.radius;
    around.declaration.acceleration_max = 1e-30;  // not at rest for ever: it stands for what moves
    around.declaration.group = At(agent).bound().declaration.group;
    around.declaration.mask = At(agent).bound().declaration.mask;
    broad_phase_.Set(agent, around);
    found_.clear();
    broad_phase_.FindNeighbours(agent, {from, scene.newest, scene.newest}, skip, &found_);
    for (const broad_phase::Neighbour& meeting : found_) {
      const AgentRecord& partner = At(meeting.partner);
      const motion::SpaceTimeBound bound = partner.margin.Widen(partner.bound());
      const double time = Span(partner.stamp(), scene.newest, options_.skew);
      if (GetsInto(around, own, bound, std::max(others_time, time))) {
        candidates_.push_back(meeting.partner);
      }
    }
    former_.Find(around, from, scene.newest, &candidates_);
  });
  Put(agent);
}

// How far from its place the agent may have been in this motion since `from`.
double Detector::Implementation::OwnReach(const motion::SpaceTimeBound& motion,
                                          Instant from) const {
  const double skew = options_.skew;
  const Instant stamp = motion.state.stamp;
  const double time =
      std::max({Span(from, stamp, skew), Span(stamp, extremes_.bounds().newest, skew), 2 * skew});
  return motion.state.position_error + PathOf(motion, time);
}

// Nothing is promised of an agent before it was admitted.
Instant Detector::Implementation::UncoveredFrom(const AgentRecord& a, const AgentRecord& b,
                                                Instant covered) const {
  return std::max({covered, a.admitted_from, b.admitted_from});
}

bool Detector::Implementation::FreeOver(const AgentRecord& a, const AgentRecord& b, Instant from,
                                        Instant to) {
  const motion::SpaceTimeBound* bound_a = a.history.Uninterrupted(from);
  const motion::SpaceTimeBound* bound_b = b.history.Uninterrupted(from);
  if (bound_a == nullptr || bound_b == nullptr) return false;
  ++counters_.pair_queries;
  return intersection::EarliestIntersection(*bound_a, *bound_b, from).instant() >= to;
}

}  // namespace collision::detection
