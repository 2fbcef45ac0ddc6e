#include "collision_core/detection/events/announcer.h"

#include <algorithm>
#include <limits>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

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

// A later evaluation may give wider brackets than an earlier one (its work was spent elsewhere).
// Both are certain unless a bound was broken in between, so their brackets are intersected.
void TakeBrackets(const ContactEpisode& episode, PublishedEvent* published) {
  CollisionEvent& event = published->event;
  TimeBracket begin = episode.begin;
  Instant end = episode.end.earliest;
  bool continuous = episode.continuous;
  if (event.status == EventStatus::kConfirmed && !published->broken) {
    // A later contact that was certified says nothing about the end of this one.
    const bool same = event.begin.latest <= episode.end.latest;
    const bool adds =
        event.begin.latest < begin.latest || (same && event.continuous && event.end.earliest > end);
    // Two intervals of certain contact that join are one.
    const bool joins =
        event.continuous && event.begin.latest <= end && event.end.earliest >= begin.latest;
    if (adds && !joins) continuous = false;
    if (same && event.continuous) end = std::max(end, event.end.earliest);
    begin.latest = std::min(begin.latest, event.begin.latest);
    begin.earliest = std::min(std::max(begin.earliest, event.begin.earliest), begin.latest);
  }
  // The event covers a doubt before this contact as well.
  if (published->doubted) begin.earliest = std::min(event.begin.earliest, episode.begin.earliest);
  event.begin = begin;
  event.end.earliest = std::min(end, episode.end.latest);
  event.continuous = continuous && !published->doubted;
}

std::optional<std::uint32_t> PartOf(const std::optional<ElementIndex>& element) {
  if (!element) return std::nullopt;
  return element->value();
}

// Point, normal, separation and depth at one instant. Bodies that overlap have no shortest way
// between them: the direction in which they approached may be known better.
void TakeProximity(const NearestInstant& nearest, const narrow_phase::ContactNormal& normal,
                   CollisionEvent* event) {
  if (nearest.at.is_never()) return;
  const narrow_phase::Proximity& found = nearest.found;
  event->evaluated_at = nearest.at;
  event->separation_lower = found.separation.lower;
  event->separation_upper = found.separation.upper;
  event->depth_lower = found.depth_lower;
  event->p_WC = found.p_WC;
  event->point_error = found.point_error;
  const bool approached = normal.known && normal.error < found.normal_error;
  event->normal = approached ? normal.normal : found.normal;
  event->normal_error = approached ? normal.error : found.normal_error;
  event->lower_part = PartOf(found.element_A);
  event->higher_part = PartOf(found.element_B);
  event->level = found.level;
  event->limited_by = found.limited_by;
}

// The two are nearest while they touch. What was found counts if it covers all of that.
void TakeClosest(const TimeBracket& contact, double separation_upper, double size,
                 PublishedEvent* published) {
  std::optional<ClosestApproach>& closest = published->closest;
  if (!closest || closest->from > contact.earliest || closest->until < contact.latest) {
    closest = {contact.earliest, contact.latest, contact, {-size, std::min(0.0, separation_upper)}};
    return;
  }
  closest->distance.upper = std::min({0.0, separation_upper, closest->distance.upper});
  closest->at = {std::max(closest->at.earliest, contact.earliest),
                 std::min(closest->at.latest, contact.latest)};
}

double SecondsLeft(Instant now, Instant t) {
  if (t.is_never()) return std::numeric_limits<double>::infinity();
  return t <= now ? 0 : numeric::SecondsBetween(now, t).upper;
}

}  // namespace

struct Announcer::Subject {
  const PairName& pair;
  EncounterSource* encounter;  ///< Null in Close(), which confirms and forecasts nothing.
  PublishedEvent& published;
};

void Announcer::Start(Instant now) {
  now_ = now;
  events_.clear();
}

PairInterest Announcer::Report(const PairName& pair, const PairOutlook& outlook, Finality finality,
                               EncounterSource* encounter, PublishedEvent* published) {
  CORE_CHECK(encounter != nullptr && published != nullptr, "a report has a source and a target");
  const Subject subject{pair, encounter, *published};
  for (const ContactEpisode& episode : outlook.settled) Finish(subject, episode);

  // There may be several episodes that are not settled; the event is about the first until that is
  // settled.
  if (!outlook.heard.empty()) {
    const ContactEpisode& first = outlook.heard.front();
    if (first.contact) {
      Confirm(subject, first);
    } else if (!published->announced && finality == Finality::kOngoing) {
      Open(subject, {first.begin.earliest, first.began_before});
    }
    return PairInterest::kNear;
  }
  if (outlook.in_contact()) {
    Confirm(subject, *outlook.open);
    return PairInterest::kNear;
  }
  if (finality == Finality::kLast) {
    // The two came and go within one step: Close() says that it is not known whether they touched.
    if (!outlook.free() && !published->announced) {
      Open(subject, {outlook.free_until, outlook.began_before});
    }
    return PairInterest::kNear;
  }
  const double left = SecondsLeft(now_, outlook.free_until);
  const bool settled = outlook.settled_free && outlook.free();
  if (settled && left > kDismissFactor * options_.announce_within) {
    if (published->announced) {
      Emit(subject, EventStatus::kDismissed);
      published->announced = false;
    }
    return PairInterest::kFarApart;
  }
  if (left <= options_.announce_within) Possible(subject, outlook);
  return PairInterest::kNear;
}

void Announcer::Announce(const PairName& pair, Instant free_until, bool began_before,
                         EncounterSource* encounter, PublishedEvent* published) {
  CORE_CHECK(!published->announced, "a pair is announced once", pair.slot.value());
  Open({pair, encounter, *published}, {free_until, began_before});
}

void Announcer::Close(const PairName& pair, const ContactEpisode* open, Departure departure,
                      Instant until, PublishedEvent* published) {
  const Subject subject{pair, nullptr, *published};
  if (!published->announced) return;
  CollisionEvent& event = published->event;
  if (event.status == EventStatus::kConfirmed) {
    if (departure == Departure::kRemoved) event.end.latest = std::max(until, event.end.earliest);
    const Instant end = event.end.latest.is_never() ? event.end.earliest : event.end.latest;
    TakeClosest({event.begin.earliest, end}, 0, pair.size, published);
    Emit(subject, EventStatus::kEnded);
  } else if (open != nullptr) {
    // What is known of the two does not exclude a contact.
    event.begin = event.end = {open->begin.earliest, std::max(until, open->begin.earliest)};
    TakeProximity(open->nearest, open->normal, &event);
    Emit(subject, EventStatus::kUndecided);
  } else {
    Emit(subject, EventStatus::kWithdrawn);
  }
  published->announced = false;
}

void Announcer::Finish(const Subject& subject, const ContactEpisode& episode) {
  PublishedEvent& published = subject.published;
  CollisionEvent& event = published.event;
  if (episode.contact) {
    Confirm(subject, episode);
    TakeBrackets(episode, &published);
    event.end.latest = episode.end.latest;
    TakeClosest({episode.begin.earliest, episode.end.latest},
                episode.nearest.found.separation.upper, subject.pair.size, &published);
    if (episode.exhausted) event.limited_by = narrow_phase::BracketLimit::kBudget;
    Emit(subject, EventStatus::kEnded);
  } else if (published.announced && event.status == EventStatus::kConfirmed) {
    if (episode.end.latest <= event.begin.latest) {
      // A doubt lies before the confirmed contact, and certain freedom between the two. The event
      // covers both: its begin bracket still contains the doubt.
      published.doubted = true;
      return;
    }
    // A bound was broken since: the contact confirmed under it can no longer be certified, and ends
    // in doubt.
    event.end.latest = episode.end.latest;
    event.end.earliest = std::min(event.end.earliest, event.end.latest);
    event.continuous = false;
    TakeClosest({event.begin.earliest, event.end.latest}, 0, subject.pair.size, &published);
    Emit(subject, EventStatus::kEnded);
  } else {
    if (!published.announced) Open(subject, {episode.begin.earliest, episode.began_before});
    event.begin = episode.begin;
    event.end = episode.end;
    TakeProximity(episode.nearest, episode.normal, &event);
    if (episode.exhausted) event.limited_by = narrow_phase::BracketLimit::kBudget;
    Emit(subject, EventStatus::kUndecided);
  }
  published.announced = false;
}

void Announcer::Possible(const Subject& subject, const PairOutlook& outlook) {
  const Instant earliest = outlook.free_until;
  if (!subject.published.announced) {
    Open(subject, {earliest, outlook.began_before});
    return;
  }
  CollisionEvent& event = subject.published.event;
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
  PublishedEvent& published = subject.published;
  if (!published.announced) Open(subject, {episode.begin.earliest, episode.began_before});
  CollisionEvent& event = published.event;
  if (event.status == EventStatus::kConfirmed && !Narrower(episode.begin, event.begin)) return;
  TakeBrackets(episode, &published);
  event.began_before = episode.began_before;
  const Instant at = episode.begin.latest;
  const EncounterAnswer answer = subject.encounter->At(at);
  published.work += answer.work;
  TakeProximity({at, answer.found}, episode.normal, &event);
  event.relative_velocity = answer.relative_velocity;
  event.lower_state = answer.lower_state;
  event.higher_state = answer.higher_state;
  if (episode.exhausted) event.limited_by = narrow_phase::BracketLimit::kBudget;
  Emit(subject, EventStatus::kConfirmed);
}

void Announcer::Open(const Subject& subject, const Opening& opening) {
  PublishedEvent& published = subject.published;
  published.announced = true;
  published.doubted = published.broken = false;
  published.work = 0;
  published.closest.reset();
  published.followed_until = now_;
  CollisionEvent& event = published.event;
  event = CollisionEvent{};
  event.lower = subject.pair.lower;
  event.higher = subject.pair.higher;
  event.lower_side = subject.pair.lower_side;
  event.higher_side = subject.pair.higher_side;
  event.pair_slot = subject.pair.slot.value();
  event.contact = numbers_.Next(subject.pair.lower_index, subject.pair.higher_index);
  event.revision = 0;
  event.margin = subject.pair.margin;
  event.begin.earliest = opening.free_until;
  event.began_before = opening.began_before;
  Emit(subject, EventStatus::kPossible);
}

void Announcer::Emit(const Subject& subject, EventStatus status) {
  CollisionEvent& event = subject.published.event;
  if (event.revision == 0 || event.status != status) ++counters_->events[static_cast<int>(status)];
  event.status = status;
  ++event.revision;
  event.now = now_;
  event.work = subject.published.work;
  event.closest = subject.published.closest;
  event.expected.reset();
  if (status == EventStatus::kPossible) {
    ExpectationAnswer answer = subject.encounter->Expected();
    event.expected = answer.expected;
    event.lower_state = answer.lower_state;
    event.higher_state = answer.higher_state;
  }
  events_.push_back(event);
}

}  // namespace collision::detection
