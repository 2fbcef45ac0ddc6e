// The detector's questions to the broad phase, and the promises that follow.
#include <algorithm>
#include <tuple>

#include "collision_core/detection/detector_implementation.h"

namespace collision {
namespace {

// Keys are computed under bounds a little wider than the true ones, so that a key from an older state is not later
// than the canonical answer from a newer one that kept the contract up to rounding. Such a state may lie off by a
// few units in the last place (2^-52; 2^-40 has room for a thousand of them) and by what the rounding of its stamp
// to the nanosecond moves it.
struct Growth {
  double position;
  double velocity;
};

Growth GrowthOf(const SpaceTimeBound& bound) {
  constexpr double kShare = 0x1p-40;
  constexpr double kStampRounding = 4e-9;
  const double speed = bound.state.v_WA.norm();
  const double magnitude = bound.state.p_WA.norm() + speed + bound.declaration.radius;
  return {kShare * magnitude + kStampRounding * speed,
          kShare * speed + kStampRounding * bound.declaration.acceleration_max};
}

SpaceTimeBound Grown(SpaceTimeBound bound) {
  const Growth growth = GrowthOf(bound);
  bound.state.position_error += growth.position;
  bound.state.velocity_error += growth.velocity;
  if (bound.state.discontinuity && bound.skew > 0) {
    // The jump may have come earlier by the skew: where it has been since then belongs to the bound.
    const double speed = bound.state.v_WA.norm() + bound.declaration.acceleration_max * bound.skew;
    bound.state.position_error += 2 * speed * bound.skew;
  }
  return bound;
}

}  // namespace

void Detector::Implementation::Put(std::uint32_t agent) {
  broad_phase_.Put(agent, Grown(At(agent).bound()));
}

bool Detector::Implementation::DriftedBeyondKeys(const AgentRecord& agent) {
  const Growth room = GrowthOf(agent.bound());
  return agent.position_drift > room.position || agent.velocity_drift > room.velocity;
}

void Detector::Implementation::SetKey(std::uint32_t agent, Instant key) {
  At(agent).key = key;
  queue_.Set(agent, key);
}

void Detector::Implementation::AskAll() {
  std::vector<std::uint32_t> renewed;
  renewed.swap(renewed_);
  for (const std::uint32_t agent : renewed) {
    if (!At(agent).expired) Ask(agent);
  }
  const Instant until = AddRoundedDown(now_, options_.announce_within);
  while (!queue_.empty() && queue_.top_key() <= until) Ask(queue_.top());
  counters_.pair_queries += broad_phase_.work().pair_queries - broad_queries_seen_;
  broad_queries_seen_ = broad_phase_.work().pair_queries;
}

bool Detector::Implementation::Tracked(const AgentRecord& agent, std::uint32_t partner) const {
  return std::any_of(agent.pairs.begin(), agent.pairs.end(), [&](std::uint32_t slot) {
    return pairs_[slot].lower == partner || pairs_[slot].higher == partner;
  });
}

// Finds the agent's meetings anew: those within announce_within become tracked pairs, the earliest
// of the others its key.
void Detector::Implementation::Ask(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  const bool renewed = record.renewed_from.has_value();
  const Instant covered = record.renewed_from.value_or(record.key);
  const Instant until = AddRoundedDown(now_, options_.announce_within);
  const bool was_saturated = record.saturated;
  ++counters_.queries;
  record.asked = step_;
  record.renewed_from.reset();
  record.saturated = false;
  TrackUncovered(agent, renewed, covered);

  std::vector<Meeting> meetings;
  const auto skip = [&](std::uint32_t partner) { return Tracked(record, partner); };
  broad_phase_.Meetings(agent, std::min(now_, covered), renewed ? Instant::Never() : until,
                        Instant::Never(), skip, &meetings);
  Instant key = Instant::Never();
  for (const Meeting& meeting : meetings) {
    Instant when = meeting.time.instant();
    if (when.is_never()) continue;
    if (when <= until) {
      const bool overlap = meeting.time.seconds <= 0;
      // They may have met before: as far back as is not covered, and both were there.
      if (overlap && renewed)
        when = std::min(when, UncoveredFrom(record, At(meeting.partner), covered));
      const bool unknown_before = renewed || was_saturated || At(meeting.partner).saturated;
      Track(agent, meeting.partner, when, overlap && unknown_before);
      if (renewed) Tell(meeting.partner, agent);
      continue;
    }
    key = std::min(key, when);
    if (when < At(meeting.partner).key) {
      SetKey(meeting.partner, when);
      if (renewed) Tell(meeting.partner, agent);
    }
  }
  SetKey(agent, record.saturated ? std::min(key, record.key) : key);
  record.renewed_cause = ClearanceCause::kNone;
}

// The broad phase answers from the newest states on. What lies between the instant up to which a
// pair was covered and those states must be free as well, or the pair is tracked and judged.
void Detector::Implementation::TrackUncovered(std::uint32_t agent, bool renewed, Instant covered) {
  const AgentRecord& record = At(agent);
  for (std::uint32_t partner = 0; partner < agents_.size(); ++partner) {
    if (partner == agent || !agents_[partner]) continue;
    const AgentRecord& other = At(partner);
    if (other.expired || Tracked(record, partner) ||
        !CanMeet(record.bound().declaration, other.bound().declaration)) {
      continue;
    }
    const Instant free_until =
        renewed ? UncoveredFrom(record, other, covered) : std::max(covered, other.key);
    const Instant known_from = std::max(record.stamp(), other.stamp());
    if (free_until < known_from && !FreeOver(record, other, free_until, known_from)) {
      Track(agent, partner, free_until, renewed);
    }
  }
}

// Nothing is promised of an agent before it was admitted.
Instant Detector::Implementation::UncoveredFrom(const AgentRecord& a, const AgentRecord& b,
                                                Instant covered) const {
  return std::max({covered, a.admitted_from, b.admitted_from});
}

bool Detector::Implementation::FreeOver(const AgentRecord& a, const AgentRecord& b, Instant from,
                                        Instant to) {
  const SpaceTimeBound* bound_a = a.history.Uninterrupted(from);
  const SpaceTimeBound* bound_b = b.history.Uninterrupted(from);
  if (bound_a == nullptr || bound_b == nullptr) return false;
  ++counters_.pair_queries;
  return EarliestIntersection(*bound_a, *bound_b, from).instant() >= to;
}

void Detector::Implementation::Track(std::uint32_t a, std::uint32_t b, Instant free_until,
                                     bool began_before) {
  const std::uint32_t lower = At(a).id < At(b).id ? a : b;
  const std::uint32_t higher = lower == a ? b : a;
  const auto full = [&](std::uint32_t agent) {
    return At(agent).pairs.size() >= options_.pairs_per_agent_max;
  };
  std::optional<std::uint32_t> slot;
  if (!full(a) && !full(b)) {
    slot = pairs_.Add({.lower = lower,
                       .higher = higher,
                       .tracker = ContactTracker(free_until, began_before),
                       .clear_until = free_until});
  }
  if (slot) {
    At(a).pairs.push_back(*slot);
    At(b).pairs.push_back(*slot);
    return;
  }
  // Told as saturated, and asked again in the next step.
  for (const std::uint32_t agent : {a, b}) {
    ++counters_.saturations;
    At(agent).saturated = true;
    SetKey(agent, AddRoundedUp(AddRoundedDown(now_, options_.announce_within), 1e-9));
  }
}

// Both keys cover the pair from now on.
void Detector::Implementation::Untrack(std::uint32_t slot) {
  const PairRecord& pair = pairs_[slot];
  for (const std::uint32_t agent : {pair.lower, pair.higher}) {
    SetKey(agent, std::min(At(agent).key, pair.clear_until));
    std::erase(At(agent).pairs, slot);
  }
  pairs_.Remove(slot);
}

AgentClearance Detector::Implementation::Clearance(const AgentRecord& agent) const {
  AgentClearance clearance;
  clearance.agent = agent.id;
  clearance.effective_from = agent.effective_from;
  clearance.saturated = agent.saturated;
  clearance.clear_until = agent.key;
  for (const std::uint32_t slot : agent.pairs) {
    const PairRecord& pair = pairs_[slot];
    if (pair.in_contact) {
      clearance.in_contact = true;
    } else {
      clearance.clear_until = std::min(clearance.clear_until, pair.clear_until);
    }
  }
  if (agent.expired) clearance.clear_until = agent.bound().state.expiry;
  if (agent.saturated) clearance.clear_until = std::min(clearance.clear_until, now_);
  clearance.not_clear = clearance.clear_until <= now_;
  return clearance;
}

std::vector<AgentClearance> Detector::Implementation::TakeChangedClearances() {
  std::vector<AgentClearance> changed;
  for (const auto& [id, agent] : index_) {
    AgentRecord& record = At(agent);
    AgentClearance clearance = Clearance(record);
    const bool first = !record.told;
    const bool lowered = !first && clearance.clear_until < record.told->clear_until;
    const bool same = !first && clearance.clear_until == record.told->clear_until &&
                      clearance.not_clear == record.told->not_clear &&
                      clearance.in_contact == record.told->in_contact &&
                      clearance.saturated == record.told->saturated &&
                      clearance.effective_from == record.told->effective_from &&
                      record.void_from.is_never();
    if (!same) {
      if (first || lowered || record.cause_agent == record.id) {
        clearance.cause = record.cause;
        clearance.cause_agent = record.cause_agent;
        clearance.void_from = record.void_from;
      }
      record.told = clearance;
      changed.push_back(clearance);
    }
    record.cause = ClearanceCause::kNone;
    record.cause_agent = AgentId{};
    record.void_from = Instant::Never();
  }
  return changed;
}

std::optional<AgentClearance> Detector::Implementation::ClearanceOf(const AgentId& id) const {
  const auto found = index_.find(id);
  if (found == index_.end()) return std::nullopt;
  return Clearance(*agents_[found->second]);
}

EarliestAnswer Detector::Implementation::Earliest() {
  EarliestAnswer best;
  const auto offer = [&](std::uint32_t a, std::uint32_t b, Instant when) {
    const AgentId lower = std::min(At(a).id, At(b).id);
    const AgentId higher = std::max(At(a).id, At(b).id);
    if (when.is_never()) return;
    if (best.found &&
        std::tie(best.earliest, best.lower, best.higher) <= std::tie(when, lower, higher)) {
      return;
    }
    best = {true, when, lower, higher};
  };
  const auto canonical = [&](std::uint32_t a, std::uint32_t b) {
    ++counters_.pair_queries;
    return EarliestIntersection(At(a).bound(), At(b).bound(), now_).instant();
  };
  for (const std::uint32_t slot : pairs_.slots()) {
    PairRecord& pair = pairs_[slot];
    if (pair.in_contact) continue;
    if (pair.asked != step_) {
      pair.earliest = canonical(pair.lower, pair.higher);
      pair.asked = step_;
    }
    // The canonical answer begins at the newer state. Where that lies ahead of now (its owner was granted more
    // time than others), the pair must be certified free until there.
    const Instant known_from = std::max(At(pair.lower).stamp(), At(pair.higher).stamp());
    const bool known = pair.clear_until >= known_from;
    // States that lie ahead may tell of a contact that begins and ends before them.
    if (!pair.ahead_from.is_never() && pair.ahead_until > now_) {
      offer(pair.lower, pair.higher, std::max(now_, pair.ahead_from));
    }
    // Where balls may overlap, their shapes may be certified apart for longer.
    const Instant earliest = std::max(pair.earliest, known ? pair.clear_until : Instant::Always());
    offer(pair.lower, pair.higher,
          known ? earliest : std::min(pair.earliest, std::max(now_, pair.clear_until)));
  }
  // Keys are lower bounds, so only agents whose key is not later than the best answer can better
  // it.
  std::vector<std::uint32_t> seen;
  while (!queue_.empty() && queue_.top_key() <= best.earliest && !queue_.top_key().is_never()) {
    const std::uint32_t agent = queue_.top();
    if (At(agent).asked != step_) {
      Ask(agent);
      continue;
    }
    queue_.Remove(agent);
    seen.push_back(agent);
    for (const auto& [id, partner] : index_) {
      if (partner != agent && !At(partner).expired && !Tracked(At(agent), partner)) {
        offer(agent, partner, canonical(agent, partner));  // covered: keys are later than states
      }
    }
  }
  for (const std::uint32_t agent : seen) queue_.Set(agent, At(agent).key);
  return best;
}

}  // namespace collision
