// The detector's questions to the broad phase, and the keys that follow.
#include <algorithm>
#include <utility>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// An agent's next meeting beyond announce_within is looked for up to a horizon, and if there is
/// none up to a later one. Horizons are announce_within times powers of this; beyond the last of
/// them all time is looked at. As a horn widens with the square of the time, who may be met grows
/// with its sixth power, so that one look too far costs more than a few that are too short.
constexpr double kHorizonFactor = 1.25;

/// Beyond so many renewed at once, agents with far keys are asked anew rather than looked at by
/// each.
constexpr std::size_t kManyRenewed = 4096;

/// Of more partners than these one in so many is asked first about a far horizon.
constexpr std::size_t kAllAsked = 64;
constexpr std::size_t kSampleShare = 32;

/// Horizons beyond this one are looked at for the next meeting alone.
constexpr int kHorizonNear = 4;

/// A saturated agent is asked again after this share of announce_within.
constexpr double kSaturatedShare = 0.125;

constexpr std::uint32_t kNobody = ~0u;

}  // namespace

// After a change of its keys.
void Detector::Implementation::NoteKeys(std::uint32_t agent) {
  const AgentRecord& record = At(agent);
  if (record.saturated) {
    queue_.Set(agent, AnnounceUntil());  // something has changed: asked again in the next step
    return;
  }
  queue_.Set(agent, record.asked == step_ ? record.keys.first() : DueAt(record));
  if (latest_.Contains(agent)) latest_.Set(agent, Reversed(record.keys.calm()));
  Touch(agent);
}

// Whose state lies beyond a key (it was granted more time before the key was lowered) is asked at
// once.
Instant Detector::Implementation::DueAt(const AgentRecord& agent) {
  return agent.keys.first() < agent.stamp() ? Instant::Always() : agent.keys.first();
}

// They may meet at `when`, if its keys do not say earlier.
void Detector::Implementation::LowerKeyOf(std::uint32_t agent, std::uint32_t partner,
                                          Instant when) {
  AgentRecord& record = At(agent);
  if (!record.saturated) record.keys.Lower(restlessness_.GroupOf(partner, agent), when);
  NoteKeys(agent);
}

void Detector::Implementation::AskAll() {
  // By index only as far as it goes: a renewal may come while others wait for theirs.
  many_ = renewed_.size() > kManyRenewed;
  if (many_) AskFarKeysAnew();
  for (const std::uint32_t agent : renewed_) {
    if (agents_[agent] && At(agent).renewed_from) Ask(agent);
  }
  const Instant until = AnnounceUntil();
  const auto due = [until](Instant key) { return key <= until && !key.is_never(); };
  while (!queue_.empty() && due(queue_.top_key())) Ask(queue_.top());
  for (const std::uint32_t agent : renewed_) {
    if (many_ && agents_[agent]) At(agent).renewed_cause = ClearanceCause::kNone;
  }
  many_ = false;
  renewed_.clear();
  SettleKeys();
}

// Keys that were set in this step may be lowered by what is renewed from now on.
void Detector::Implementation::SettleKeys() {
  for (const std::uint32_t agent : fresh_) {
    if (!agents_[agent]) continue;
    const AgentRecord& record = At(agent);
    if (record.expired || record.saturated || record.renewed_from) continue;
    latest_.Set(agent, Reversed(record.keys.calm()));
  }
  fresh_.clear();
  const broad_phase::BroadPhaseWork work = broad_phase_.work();
  counters_.pair_queries += work.pair_queries - broad_queries_seen_;
  counters_.filter_tests = work.filter_tests + looks_;
  counters_.broad_units = static_cast<std::uint64_t>(broad_phase_.units());
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
  ++counters_.queries;
  At(agent).asked = step_;
  asker_ = restlessness_.of(agent);
  if (NeedOnlyAskRestless(agent)) {
    AskRestless(agent);
  } else {
    AskEverybody(agent);
  }
  asking_ = kEverybody;
}

void Detector::Implementation::AskEverybody(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  const bool renewed = record.renewed_from.has_value();
  const bool was_saturated = record.saturated;
  const AgentKeys before = std::move(record.keys);
  // A saturated agent was promised nothing up to now.
  const Instant covered = std::min(was_saturated ? now_ : before.first(),
                                   record.renewed_from.value_or(Instant::Never()));
  const auto covered_of = [&](int group) {
    return renewed || was_saturated || group == kEverybody ? covered : before.of(group);
  };
  record.renewed_from.reset();
  if (was_saturated) Unsaturate(agent);
  latest_.Remove(agent);
  fresh_.push_back(agent);
  MarkTracked(record);
  // Before its key was due, because many others changed: where they meet it later than that, it stays.
  const bool early = many_ && !renewed && !was_saturated && covered > AnnounceUntil();
  const std::uint32_t next_before = record.next_partner;
  groups_.clear();
  restlessness_.RestlessBeside(agent, &groups_);
  const int calm = groups_.empty() ? kEverybody : Restlessness::kCalm;
  Next next = AskAbout(calm, agent, renewed, was_saturated, covered_of(calm));
  if (!record.saturated) record.keys.SetAll(next.key);
  for (const int group : groups_) {
    if (record.saturated || TracksAll(agent, group)) continue;
    const Next first = AskAbout(group, agent, renewed, was_saturated, covered_of(group));
    if (record.saturated) continue;
    record.keys.SetRestless(group, first.key);
    if (first.key < next.key) next = first;
  }
  if (!record.saturated) {
    if (!next.key.is_never()) record.next_partner = next.partner;
    if (early && next.key > covered) {
      record.next_partner = next_before;
      record.keys.SetRestless(Restlessness::kNobody, covered);
    }
    NoteKeys(agent);
  }
  const Instant from = std::min(now_, covered);
  if (renewed) LowerKeys(agent, from);
  if (many_) return TellIfLowered(agent, covered);
  record.renewed_cause = ClearanceCause::kNone;
}

// About one group, nobody of which that is not tracked is met up to `covered`.
Detector::Implementation::Next Detector::Implementation::AskAbout(int group, std::uint32_t agent,
                                                                  bool renewed, bool was_saturated,
                                                                  Instant covered) {
  asking_ = group;
  TrackUncovered(agent, renewed, covered);
  const Instant from = std::min(now_, covered);
  if (IsCrowded(agent, from, was_saturated)) {
    crowd_ = true;
    return {};
  }
  return AskBroadPhase(agent, from, renewed, was_saturated, covered);
}

// Whether the others are certified to be far beyond what is to be known now.
bool Detector::Implementation::NeedOnlyAskRestless(std::uint32_t agent) const {
  const AgentRecord& record = At(agent);
  return !record.renewed_from && !record.saturated && !many_ && RoomFor(record) > 0 &&
         restlessness_.Divides(agent) && record.keys.calm() > DueUntil(record);
}

// It stays in latest_: about who is renewed in this step, and not restless, it is not asked.
void Detector::Implementation::AskRestless(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  groups_.clear();
  record.keys.RestlessUpTo(DueUntil(record), &groups_);
  MarkTracked(record);
  for (const int group : groups_) {
    Next next;
    if (!TracksAll(agent, group)) {
      next = AskAbout(group, agent, false, false, record.keys.of(group));
    }
    if (record.saturated) return;
    record.keys.SetRestless(group, next.key);
    if (!next.key.is_never() && next.key <= record.keys.first()) record.next_partner = next.partner;
  }
  NoteKeys(agent);
}

// Which keys it is asked about.
Instant Detector::Implementation::DueUntil(const AgentRecord& agent) const {
  return std::max({AnnounceUntil(), agent.keys.first(), agent.stamp()});
}

// Then none of the group is left that could be met.
bool Detector::Implementation::TracksAll(std::uint32_t agent, int group) const {
  std::uint32_t tracked = 0;
  for (const std::uint32_t slot : At(agent).pairs) {
    const PairRecord& pair = pairs_[slot];
    const std::uint32_t partner = pair.lower == agent ? pair.higher : pair.lower;
    tracked += restlessness_.GroupOf(partner, agent) == group;
  }
  return tracked == restlessness_.Count(group);
}

// Of an agent without room for another pair all that is to be known is whether there is one that
// should be tracked: then it is saturated. In a crowd that mostly is one that was in the way
// before, or that the last such agent met; so a crowd costs one pair query an agent, not one for
// each two.
bool Detector::Implementation::IsCrowded(std::uint32_t agent, Instant from, bool was_saturated) {
  const AgentRecord& record = At(agent);
  if (RoomFor(record) > 0) return false;
  const motion::SpaceTimeBound bound = record.margin.Widen(record.bound());
  const std::uint32_t before = was_saturated ? record.crowded_with : kNobody;
  for (const std::uint32_t partner : {before, crowded_[0], crowded_[1]}) {
    if (partner >= agents_.size() || partner == agent || !agents_[partner]) continue;
    const AgentRecord& other = At(partner);
    if (other.expired || Marked(partner)) continue;
    if (!CanMeet(record.bound().declaration, other.bound().declaration)) continue;
    ++counters_.pair_queries;
    const motion::SpaceTimeBound bound_of_other = other.margin.Widen(other.bound());
    if (intersection::EarliestIntersection(bound, bound_of_other, from).instant() > AnnounceUntil())
      continue;
    Saturate(agent, partner);
    return true;
  }
  return false;
}

// Tracks who may be met soon. Of the others the first; unless the agent has become saturated.
Detector::Implementation::Next Detector::Implementation::AskBroadPhase(std::uint32_t agent,
                                                                       Instant from, bool renewed,
                                                                       bool was_saturated,
                                                                       Instant covered) {
  const AgentRecord& record = At(agent);
  // In a crowd most agents are saturated, and need no key.
  const bool crowd = crowd_ || was_saturated;
  const bool only_near = crowd || horizon() > kHorizonNear;
  const Instant until = only_near ? AnnounceUntil() : Horizon(horizon());
  FindMeetings(agent, from, until);
  crowd_ = record.saturated;
  TakeMeetings(agent, renewed, was_saturated, covered);
  if (record.saturated) return {};
  const Next next = FirstFound();
  if (next.key.is_never()) return FindKey(agent, from, until);
  NoteHorizon(next.key);
  return next;
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
    if (IsLeftOut(agent, partner)) return true;
    if (IsFull(partner)) return partner > first_full;
    return first_.size() > room && partner > first_.front();
  };
  found_.clear();
  broad_phase_.FindNeighbours(agent, {from, until, horizon}, skip, &found_);
  // They have been put into order since: what was seen first need not stand first.
  first_.clear();
  first_full = kNobody;
  seen = 0;
  look();
  if (first_.size() > room) first_full = std::min(first_full, first_.front());
  const std::uint32_t end = first_.size() > room ? first_.front() : kNobody;
  std::erase_if(found_, [&](const broad_phase::Neighbour& meeting) {
    return meeting.time.instant() <= until && (IsFull(meeting.partner) || meeting.partner >= end);
  });
  SortByPartner(0, &found_);
  if (first_full != kNobody) Saturate(agent, first_full);
}

// Tracks who may be met soon.
void Detector::Implementation::TakeMeetings(std::uint32_t agent, bool renewed, bool was_saturated,
                                            Instant covered) {
  const AgentRecord& record = At(agent);
  const Instant until = AnnounceUntil();
  for (const broad_phase::Neighbour& meeting : found_) {
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
}

// The earliest of found_ that is not tracked.
Detector::Implementation::Next Detector::Implementation::FirstFound() const {
  Next next;
  for (const broad_phase::Neighbour& meeting : found_) {
    if (Marked(meeting.partner) || meeting.time.instant() >= next.key) continue;
    next = {meeting.time.instant(), meeting.partner};
  }
  return next;
}

// Nobody that is not tracked is met by `known`.
Detector::Implementation::Next Detector::Implementation::FindKey(std::uint32_t agent, Instant from,
                                                                 Instant known) {
  Next next;
  int step = 0;
  for (int h = horizon(); next.key.is_never() && !known.is_never(); h += std::min(++step, 2)) {
    const Instant until = Horizon(h);
    if (until <= known) continue;
    FindNext(agent, from, known, until);
    next = FirstFound();
    known = until;
  }
  NoteHorizon(next.key);
  return next;
}

// Into found_: the first meeting of all that are not tracked, none of which comes by `known`. Far
// ahead a whole swarm may come near at about the same time: then a share of it is asked first, and
// the earliest of these spares nearly all of the others.
void Detector::Implementation::FindNext(std::uint32_t agent, Instant from, Instant known,
                                        Instant horizon) {
  std::size_t offered = 0, left_out = 0;
  const auto sample = [&](std::uint32_t partner) {
    if (IsLeftOut(agent, partner)) return true;
    if (++offered <= kAllAsked || offered % kSampleShare == 0) return false;
    ++left_out;
    return true;
  };
  found_.clear();
  broad_phase_.FindNeighbours(agent, {from, known, horizon}, sample, &found_);
  looks_ += offered - left_out;
  if (left_out == 0) return;
  if (!found_.empty()) horizon = found_.front().time.instant();
  const auto all = [&](std::uint32_t partner) {
    if (IsLeftOut(agent, partner)) return true;
    ++looks_;
    return false;
  };
  found_.clear();
  broad_phase_.FindNeighbours(agent, {from, known, horizon}, all, &found_);
}

Instant Detector::Implementation::Horizon(int step) const {
  if (step > kHorizons) return Instant::Never();
  double ahead = options_.announce_within;
  for (int k = 0; k < step; ++k) ahead *= kHorizonFactor;
  return numeric::AddRoundedUp(now_, ahead);
}

// Questions begin with the horizon that half of the last keys lay within, of agents as restless.
void Detector::Implementation::NoteHorizon(Instant key) {
  int& begin = horizon();
  if (key > Horizon(begin)) {
    begin = std::min(begin + 1, kHorizons);
  } else if (begin > 1 && key <= Horizon(begin - 1)) {
    --begin;
  }
}

// Told as saturated: it may touch at any time. Asked again a little later; until then its key
// promises nothing, and no question depends on it.
void Detector::Implementation::Saturate(std::uint32_t agent, std::uint32_t partner) {
  AgentRecord& record = At(agent);
  record.crowded_with = partner;
  crowded_[0] = agent, crowded_[1] = partner;
  record.keys.SetAll(std::max(now_, record.stamp()));
  latest_.Remove(agent);
  Touch(agent);
  const double rest = kSaturatedShare * options_.announce_within;
  queue_.Set(agent, numeric::AddRoundedUp(numeric::AddRoundedDown(AnnounceUntil(), rest), 1e-9));
  if (record.saturated) return;
  ++counters_.saturations;
  record.saturated = true;
  record.saturated_at = saturated_.size();
  saturated_.push_back(agent);
}

void Detector::Implementation::Unsaturate(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  record.saturated = false;
  const std::uint32_t last = saturated_.back();
  saturated_[record.saturated_at] = last;
  At(last).saturated_at = record.saturated_at;
  saturated_.pop_back();
}

}  // namespace collision::detection
