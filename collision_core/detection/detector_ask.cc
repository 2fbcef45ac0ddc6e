// The detector's questions to the broad phase, and the keys that follow.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"

namespace collision {
namespace {

/// So many of the latest keys are looked at one by one when an agent is renewed, so that a few
/// agents that are clear for long do not make everybody's renewal look far ahead.
constexpr std::size_t kKeysAside = 32;

/// A saturated agent is asked again after this share of announce_within.
constexpr double kSaturatedShare = 0.125;

/// The order of ~key is that of the keys from the last to the first.
Instant Reversed(Instant key) { return Instant::FromNanoseconds(~key.nanoseconds()); }

constexpr std::uint32_t kNobody = ~0u;

bool ByPartner(const Meeting& a, const Meeting& b) { return a.partner < b.partner; }

}  // namespace

void Detector::Implementation::SetKey(std::uint32_t agent, Instant key) {
  AgentRecord& record = At(agent);
  if (record.saturated) {
    queue_.Set(agent, AnnounceUntil());  // something has changed: asked again in the next step
    return;
  }
  record.key = key;
  queue_.Set(agent, key);
  if (latest_.Contains(agent)) latest_.Set(agent, Reversed(key));
  Touch(agent);
}

void Detector::Implementation::AskAll() {
  // By index only as far as it goes: a renewal may come while others wait for theirs.
  for (const std::uint32_t agent : renewed_) {
    if (agents_[agent] && At(agent).renewed_from) Ask(agent);
  }
  renewed_.clear();
  const Instant until = AnnounceUntil();
  const auto due = [until](Instant key) { return key <= until && !key.is_never(); };
  while (!queue_.empty() && due(queue_.top_key())) Ask(queue_.top());
  SettleKeys();
}

// Keys that were set in this step may be lowered by what is renewed from now on.
void Detector::Implementation::SettleKeys() {
  for (const std::uint32_t agent : fresh_) {
    if (!agents_[agent]) continue;
    const AgentRecord& record = At(agent);
    if (record.expired || record.saturated || record.renewed_from) continue;
    latest_.Set(agent, Reversed(At(agent).key));
  }
  fresh_.clear();
  const BroadPhaseWork work = broad_phase_.work();
  counters_.pair_queries += work.pair_queries - broad_queries_seen_;
  counters_.filter_tests = work.filter_tests;
  counters_.method_changes = broad_phase_.changes();
  broad_queries_seen_ = work.pair_queries;
}

void Detector::Implementation::MarkTracked(const AgentRecord& agent) {
  ++mark_;
  for (const std::uint32_t slot : agent.pairs) {
    marks_[pairs_[slot].lower] = marks_[pairs_[slot].higher] = mark_;
  }
}

std::size_t Detector::Implementation::RoomFor(const AgentRecord& agent) const {
  const std::size_t taken = agent.pairs.size();
  if (taken >= options_.pairs_per_agent_max) return 0;
  return std::min(options_.pairs_per_agent_max - taken, pairs_.room());
}

// Finds the agent's meetings anew: those within announce_within become tracked pairs, the earliest
// of the others its key.
void Detector::Implementation::Ask(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  const bool renewed = record.renewed_from.has_value();
  const bool was_saturated = record.saturated;
  const Instant covered = record.renewed_from.value_or(record.key);
  ++counters_.queries;
  record.asked = step_;
  record.renewed_from.reset();
  if (was_saturated) {
    record.saturated = false;
    std::erase(saturated_, agent);
  }
  latest_.Remove(agent);
  fresh_.push_back(agent);
  MarkTracked(record);
  // A saturated agent was promised nothing.
  if (renewed || !was_saturated) TrackUncovered(agent, renewed, covered);
  const Instant from = std::min(now_, covered);
  // In a crowd most agents are saturated, and need no key.
  const bool crowd = crowd_ || was_saturated;
  FindMeetings(agent, from, crowd ? AnnounceUntil() : Instant::Never());
  crowd_ = record.saturated;
  TakeMeetings(agent, renewed, was_saturated, covered);
  if (crowd && !record.saturated) FindKey(agent, from);
  if (renewed) LowerKeys(agent, from);
  record.renewed_cause = ClearanceCause::kNone;
}

// Into found_, by partner: whom the agent may meet within announce_within, and the earliest of the
// others. Of more than there is room for the first by index, and none that has no room itself: then
// the agent is saturated. What is not needed for that is not asked, and what is found depends on
// nobody's order of asking.
void Detector::Implementation::FindMeetings(std::uint32_t agent, Instant from, Instant horizon) {
  const Instant until = AnnounceUntil();
  const std::size_t room = RoomFor(At(agent));
  std::uint32_t first_full = kNobody;
  first_.clear();
  std::size_t seen = 0;
  const auto look = [&] {
    for (; seen < found_.size(); ++seen) {
      if (found_[seen].time.instant() > until) continue;
      const std::uint32_t partner = found_[seen].partner;
      if (IsFull(partner)) {
        first_full = std::min(first_full, partner);
        continue;
      }
      first_.push_back(partner);
      std::push_heap(first_.begin(), first_.end());
      if (first_.size() <= room + 1) continue;
      std::pop_heap(first_.begin(), first_.end());
      first_.pop_back();
    }
  };
  const auto skip = [&](std::uint32_t partner) {
    look();
    if (Marked(partner)) return true;
    if (IsFull(partner)) return partner > first_full;
    return first_.size() > room && partner > first_.front();
  };
  found_.clear();
  broad_phase_.Meetings(agent, from, until, horizon, skip, &found_);
  look();
  if (first_.size() > room) first_full = std::min(first_full, first_.front());
  const std::uint32_t end = first_.size() > room ? first_.front() : kNobody;
  std::erase_if(found_, [&](const Meeting& meeting) {
    return meeting.time.instant() <= until && (IsFull(meeting.partner) || meeting.partner >= end);
  });
  std::sort(found_.begin(), found_.end(), ByPartner);
  if (first_full != kNobody) Saturate(agent, first_full);
}

// Tracks who may be met soon; the earliest of the others is the agent's key.
void Detector::Implementation::TakeMeetings(std::uint32_t agent, bool renewed, bool was_saturated,
                                            Instant covered) {
  const AgentRecord& record = At(agent);
  const Instant until = AnnounceUntil();
  for (const Meeting& meeting : found_) {
    Instant when = meeting.time.instant();
    if (when > until) continue;
    const AgentRecord& partner = At(meeting.partner);
    const bool overlap = meeting.time.seconds <= 0;
    // They may have met before: as far back as is not covered, and both were there.
    if (overlap && renewed) when = std::min(when, UncoveredFrom(record, partner, covered));
    const bool unknown_before = renewed || was_saturated || partner.saturated;
    Track(agent, meeting.partner, when, overlap && unknown_before);
    marks_[meeting.partner] = mark_;
    if (renewed) Tell(meeting.partner, agent);
  }
  TakeKey(agent);
}

// The earliest of found_ that is not tracked.
void Detector::Implementation::TakeKey(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  if (record.saturated) return;
  Instant key = Instant::Never();
  for (const Meeting& meeting : found_) {
    if (Marked(meeting.partner) || meeting.time.instant() >= key) continue;
    key = meeting.time.instant();
    record.next_partner = meeting.partner;
  }
  SetKey(agent, key);
}

void Detector::Implementation::FindKey(std::uint32_t agent, Instant from) {
  const auto skip = [this](std::uint32_t partner) { return Marked(partner); };
  found_.clear();
  broad_phase_.Meetings(agent, from, AnnounceUntil(), Instant::Never(), skip, &found_);
  std::sort(found_.begin(), found_.end(), ByPartner);
  TakeKey(agent);
}

// Every partner whose key is later than its meeting with the renewed agent gets the earlier one.
// Only keys of earlier steps can be: whoever is asked in this step is asked about the new bound.
void Detector::Implementation::LowerKeys(std::uint32_t agent, Instant from) {
  const Instant until = AnnounceUntil();
  latest_.First(kKeysAside + 1, &aside_);
  Instant horizon = until;
  if (aside_.size() > kKeysAside) {
    horizon = std::max(until, At(aside_.back()).key);
    aside_.pop_back();
    const auto skip = [&](std::uint32_t partner) {
      return Marked(partner) || !latest_.Contains(partner) || At(partner).saturated ||
             CertainlyLater(At(agent), partner);
    };
    found_.clear();
    broad_phase_.Meetings(agent, from, horizon, horizon, skip, &found_);
    std::sort(found_.begin(), found_.end(), ByPartner);
    for (const Meeting& meeting : found_) {
      LowerKey(meeting.partner, agent, meeting.time.instant());
    }
  }
  const SpaceTimeBound bound = At(agent).margin.Widen(At(agent).bound());
  std::sort(aside_.begin(), aside_.end());
  for (const std::uint32_t partner : aside_) {
    const AgentRecord& other = At(partner);
    if (Marked(partner) || other.saturated || CertainlyLater(At(agent), partner)) continue;
    ++counters_.pair_queries;
    const SpaceTimeBound bound_of_other = other.margin.Widen(other.bound());
    LowerKey(partner, agent, EarliestIntersection(bound, bound_of_other, from).instant());
  }
}

void Detector::Implementation::LowerKey(std::uint32_t partner, std::uint32_t agent, Instant when) {
  if (when >= At(partner).key) return;
  if (when <= AnnounceUntil()) {
    Saturate(partner, agent);  // there was no room to track the two
  } else {
    At(partner).next_partner = agent;
    SetKey(partner, when);
  }
  Tell(partner, agent);
}

// Whether the two are certain not to meet before the partner's key: a cheap test that spares most
// questions. The centres' difference moves on a segment, which stays away from the origin by more
// than both can reach until then.
bool Detector::Implementation::CertainlyLater(const AgentRecord& agent,
                                              std::uint32_t partner) const {
  constexpr double kRoundings = 0x1p-40;
  const AgentRecord& other = At(partner);
  const Instant from = std::max(agent.stamp(), other.stamp());
  if (other.key <= from) return true;
  if (other.key.is_never()) return false;
  const auto seconds = [](Instant from, Instant to) {
    return 1e-9 * (static_cast<double>(to.nanoseconds()) - static_cast<double>(from.nanoseconds()));
  };
  double reach = 0, magnitude = 0;
  Eigen::Vector3d d = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();
  for (const AgentRecord* record : {&agent, &other}) {
    const MotionState& state = record->bound().state;
    const AgentDeclaration& declaration = record->bound().declaration;
    const double tau = seconds(state.stamp, other.key) + options_.skew;
    const double speed = state.v_WA.norm();
    reach += declaration.radius + state.position_error + speed * options_.skew +
             state.velocity_error * tau +
             declaration.acceleration_max * tau * (tau + declaration.time_step) / 2;
    if (state.discontinuity) {
      reach += 2 * (speed + declaration.acceleration_max * options_.skew) * options_.skew;
    }
    magnitude += state.p_WA.norm() + speed * (tau + 1) + 1e-6 * speed;
    const double sign = record == &agent ? -1 : 1;
    d += sign * (state.p_WA + state.v_WA * seconds(state.stamp, from));
    w += sign * state.v_WA;
  }
  const double duration = seconds(from, other.key);
  const double nearest = std::clamp(-d.dot(w) / std::max(w.squaredNorm(), 1e-300), 0.0, duration);
  const double margin = kRoundings * (magnitude + reach) + 1e-8 * (w.norm() + 1);
  return (d + w * nearest).norm() > reach + margin;
}

// Told as saturated: it may touch at any time. Asked again a little later; until then its key
// promises nothing, and no question depends on it.
void Detector::Implementation::Saturate(std::uint32_t agent, std::uint32_t partner) {
  AgentRecord& record = At(agent);
  record.crowded_with = partner;
  record.key = std::max(now_, record.stamp());
  latest_.Remove(agent);
  Touch(agent);
  const double rest = kSaturatedShare * options_.announce_within;
  queue_.Set(agent, AddRoundedUp(AddRoundedDown(AnnounceUntil(), rest), 1e-9));
  if (record.saturated) return;
  ++counters_.saturations;
  record.saturated = true;
  saturated_.push_back(agent);
}

}  // namespace collision
