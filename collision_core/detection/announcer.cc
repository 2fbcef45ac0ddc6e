#include "collision_core/detection/announcer.h"

#include <algorithm>
#include <limits>

#include "collision_core/detection/judge.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// To evaluate a contact when it is confirmed this part of a turn's work is allowed, beside what the turn took.
constexpr std::uint64_t kEvaluationShare = 8;

// A pair is dismissed only when it is this much further away than what is announced, so that pairs
// that travel side by side do not come and go with every state.
constexpr double kDismissFactor = 1.25;

// A possible event is revised when its earliest time moved by this share of what was left.
constexpr double kRevisionShare = 0.25;

// A confirmed event is revised when its begin bracket is narrower than this share of the published
// one.
constexpr double kNarrowerShare = 0.99;

bool Narrower(const TimeBracket& found, const TimeBracket& published) {
  return numeric::SecondsBetween(found.earliest, found.latest).upper <
         kNarrowerShare * numeric::SecondsBetween(published.earliest, published.latest).lower;
}

// A later look may tell less than an earlier one (its work was spent elsewhere). Both are certain, unless a bound
// was broken since: what either tells of the contact holds.
void TakeBrackets(const ContactEpisode& episode, const PairRecord& pair, CollisionEvent* event) {
  TimeBracket begin = episode.begin;
  Instant end = episode.end.earliest;
  bool continuous = episode.continuous;
  if (event->status == EventStatus::kConfirmed && !pair.broken) {
    // What was certain of a later contact says nothing of where this one ends.
    const bool same = event->begin.latest <= episode.end.latest;
    const bool adds = event->begin.latest < begin.latest ||
                      (same && event->continuous && event->end.earliest > end);
    // Contact was certain from here to there, and is from there to there: throughout if these join.
    const bool joins =
        event->continuous && event->begin.latest <= end && event->end.earliest >= begin.latest;
    if (adds && !joins) continuous = false;
    if (same && event->continuous) end = std::max(end, event->end.earliest);
    begin.latest = std::min(begin.latest, event->begin.latest);
    begin.earliest = std::min(std::max(begin.earliest, event->begin.earliest), begin.latest);
  }
  // The event tells of a doubt before this contact as well.
  if (pair.doubted) begin.earliest = std::min(event->begin.earliest, episode.begin.earliest);
  event->begin = begin;
  event->end.earliest = std::min(end, episode.end.latest);
  event->continuous = continuous && !pair.doubted;
}

double SecondsLeft(Instant now, Instant t) {
  if (t.is_never()) return std::numeric_limits<double>::infinity();
  return t <= now ? 0 : numeric::SecondsBetween(now, t).upper;
}

}  // namespace

struct Announcer::Subject {
  const AgentRecord& lower;
  const AgentRecord& higher;
  std::uint32_t slot;
  PairTable& pairs;
  PairRecord& pair;
  std::uint64_t work_allowed = 0;
};

void Announcer::Start(Instant now) {
  now_ = now;
  events_.clear();
}

bool Announcer::Report(const AgentRecord& lower, const AgentRecord& higher, std::uint32_t slot,
                       const ContactTracker& preview, std::uint64_t work_allowed, bool last,
                       PairTable* pairs) {
  const Subject subject{lower, higher, slot, *pairs, (*pairs)[slot], work_allowed};
  PairRecord& pair = subject.pair;
  for (const ContactEpisode& episode : pair.tracker.TakeFinished()) Finish(subject, episode);

  // What is not settled yet may hold several episodes; the event tells of the first, until that is settled.
  if (!preview.finished().empty()) {
    const ContactEpisode& first = preview.finished().front();
    if (first.contact) {
      Confirm(subject, first);
    } else if (!pair.announced && !last) {
      Open(subject, first.begin.earliest, first.began_before);
    }
    return true;
  }
  if (preview.in_contact()) {
    Confirm(subject, preview.episode());
    return true;
  }
  if (last) return true;
  const double left = SecondsLeft(now_, preview.free_until());
  const bool settled = pair.tracker.free() && preview.free();
  if (settled && left > kDismissFactor * options_.announce_within) {
    if (pair.announced) {
      Emit(subject, EventStatus::kDismissed);
      pair.announced = false;
    }
    return false;
  }
  if (left <= options_.announce_within) Possible(subject, preview);
  return true;
}

void Announcer::Leave(const AgentRecord& lower, const AgentRecord& higher, std::uint32_t slot,
                      bool gone, PairTable* pairs) {
  const Subject subject{lower, higher, slot, *pairs, (*pairs)[slot]};
  PairRecord& pair = subject.pair;
  if (!pair.announced) return;
  if (pair.event.status == EventStatus::kConfirmed) {
    if (gone) pair.event.end.latest = std::max(now_, pair.event.end.earliest);
    Emit(subject, EventStatus::kEnded);
  } else if (!pair.tracker.free()) {
    // What was heard of the two does not exclude that they touched.
    const ContactEpisode& open = pair.tracker.episode();
    pair.event.begin = pair.event.end = {open.begin.earliest, std::max(now_, open.begin.earliest)};
    Evaluate(subject, open.nearest, open.normal);
    Emit(subject, EventStatus::kUndecided);
  } else {
    Emit(subject, EventStatus::kWithdrawn);
  }
  pair.announced = false;
}

void Announcer::Finish(const Subject& subject, const ContactEpisode& episode) {
  CollisionEvent& event = subject.pair.event;
  if (episode.contact) {
    Confirm(subject, episode);
    TakeBrackets(episode, subject.pair, &event);
    event.end.latest = episode.end.latest;
    if (episode.exhausted) event.limited_by = narrow_phase::EventLimit::kBudget;
    Emit(subject, EventStatus::kEnded);
  } else if (subject.pair.announced && event.status == EventStatus::kConfirmed) {
    if (episode.end.latest <= event.begin.latest) {
      // Before the contact that was confirmed lies a doubt, and certain freedom between the two. The event tells of
      // both: its begin bracket still covers the doubt.
      subject.pair.doubted = true;
      return;
    }
    // A bound was broken since: what was confirmed under it cannot be repeated, and ends in doubt.
    event.end.latest = episode.end.latest;
    event.end.earliest = std::min(event.end.earliest, event.end.latest);
    event.continuous = false;
    Emit(subject, EventStatus::kEnded);
  } else {
    if (!subject.pair.announced) Open(subject, episode.begin.earliest, episode.began_before);
    event.begin = episode.begin;
    event.end = episode.end;
    Evaluate(subject, episode.nearest, episode.normal);
    if (episode.exhausted) event.limited_by = narrow_phase::EventLimit::kBudget;
    Emit(subject, EventStatus::kUndecided);
  }
  subject.pair.announced = false;
}

void Announcer::Possible(const Subject& subject, const ContactTracker& preview) {
  const PairRecord& pair = subject.pair;
  const Instant earliest = preview.free_until();
  if (!pair.announced) {
    Open(subject, earliest, preview.began_before());
    return;
  }
  CollisionEvent& event = subject.pair.event;
  if (event.status != EventStatus::kPossible || earliest == event.begin.earliest) return;
  const double left = SecondsLeft(now_, event.begin.earliest);
  const double moved = earliest < event.begin.earliest
                           ? std::numeric_limits<double>::infinity()
                           : numeric::SecondsBetween(event.begin.earliest, earliest).lower;
  if (moved <= kRevisionShare * left || moved <= options_.temporal_resolution) return;
  event.begin.earliest = earliest;
  Emit(subject, EventStatus::kPossible);
}

// Confirms the contact, or narrows its brackets if that was done already.
void Announcer::Confirm(const Subject& subject, const ContactEpisode& episode) {
  if (!subject.pair.announced) Open(subject, episode.begin.earliest, episode.began_before);
  CollisionEvent& event = subject.pair.event;
  if (event.status == EventStatus::kConfirmed && !Narrower(episode.begin, event.begin)) return;
  TakeBrackets(episode, subject.pair, &event);
  event.began_before = episode.began_before;
  const Instant at = episode.begin.latest;
  WorkBudget work(subject.work_allowed / kEvaluationShare);
  const History& lower = subject.lower.history;
  const History& higher = subject.higher.history;
  Evaluate(subject, {at, ProximityOf(lower, higher, at, &work)}, episode.normal);
  if (episode.exhausted) event.limited_by = narrow_phase::EventLimit::kBudget;
  subject.pair.work += work.spent();
  counters_->work_units += work.spent();
  Emit(subject, EventStatus::kConfirmed);
}

void Announcer::Open(const Subject& subject, Instant free_until, bool began_before) {
  PairRecord& pair = subject.pair;
  pair.announced = true;
  pair.doubted = pair.broken = false;
  pair.work = 0;
  pair.event = CollisionEvent{};
  pair.event.lower = subject.lower.id;
  pair.event.higher = subject.higher.id;
  pair.event.pair_slot = subject.slot;
  pair.event.contact = subject.pairs.NextContact(pair.lower, pair.higher);
  pair.event.revision = 0;
  pair.event.begin.earliest = free_until;
  pair.event.began_before = began_before;
  Emit(subject, EventStatus::kPossible);
}

void Announcer::Emit(const Subject& subject, EventStatus status) {
  CollisionEvent& event = subject.pair.event;
  if (event.revision == 0 || event.status != status) ++counters_->events[static_cast<int>(status)];
  event.status = status;
  ++event.revision;
  event.now = now_;
  event.work = subject.pair.work;
  events_.push_back(event);
}

void Announcer::Evaluate(const Subject& subject, const Nearest& nearest,
                         const narrow_phase::ContactNormal& normal) {
  if (nearest.at.is_never()) return;
  CollisionEvent& event = subject.pair.event;
  const narrow_phase::Proximity& found = nearest.found;
  event.evaluated_at = nearest.at;
  event.separation_lower = found.separation.lower;
  event.separation_upper = found.separation.upper;
  event.depth_lower = found.depth_lower;
  event.p_WC = found.p_WC;
  event.point_error = found.point_error;
  // Bodies that overlap have no shortest way between them: the one by which they came near tells.
  const bool approached = normal.known && normal.error < found.normal_error;
  event.normal = approached ? normal.normal : found.normal;
  event.normal_error = approached ? normal.error : found.normal_error;
  event.level = found.level;
  event.limited_by = found.limited_by;
}

}  // namespace collision::detection
