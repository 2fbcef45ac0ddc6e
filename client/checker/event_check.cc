#include <algorithm>

#include "client/checker/check.h"

namespace collision::checker {
namespace {

bool In(long double t, long double tolerance, std::int64_t earliest_ns, std::int64_t latest_ns) {
  return earliest_ns - tolerance <= t && t <= latest_ns + tolerance;
}

// Whether the bracket reaches into a stretch of the contact in which a gap may have stayed unseen.
bool InBlind(const TrueContact& contact, const v1::TimeBracket& bracket) {
  return std::any_of(contact.blind.begin(), contact.blind.end(), [&](const Span& span) {
    return bracket.earliest_ns() - kRootTolerance <= span.end &&
           span.begin <= bracket.latest_ns() + kRootTolerance;
  });
}

bool BeginsIn(const TrueContact& contact, std::int64_t earliest_ns, std::int64_t latest_ns) {
  return In(contact.begin_ns, contact.begin_tolerance_ns, earliest_ns, latest_ns);
}

// Whether this revision says that the contact begins where it does.
bool Brackets(const v1::CollisionEvent& event, const TrueContact& contact) {
  const bool whole = event.status() == v1::EVENT_UNDECIDED ||
                     (IsConfirmed(event) && (!event.continuous() || event.began_before()));
  if (whole && BeginsIn(contact, event.begin().earliest_ns(), event.end().latest_ns())) return true;
  return IsConfirmed(event) &&
         BeginsIn(contact, event.begin().earliest_ns(), event.begin().latest_ns());
}

// Whether the contact, if it is not the one of this revision, is consistent with it. The two may
// touch again where the end is still sought; and a possible contact stays open while the agents'
// balls overlap.
bool Covers(const Evidence& evidence, const v1::CollisionEvent& event, const TrueContact& contact) {
  if (IsConfirmed(event)) {
    return BeginsIn(contact, event.end().earliest_ns(), event.end().latest_ns()) &&
           contact.end_ns <= event.end().latest_ns() + contact.end_tolerance_ns;
  }
  return event.status() == v1::EVENT_POSSIBLE && evidence.HasShape(contact.a, contact.b) &&
         event.begin().earliest_ns() <= contact.begin_ns + contact.begin_tolerance_ns &&
         contact.balls_until_ns >= evidence.judged_until_ns();
}

bool TooShortToDemand(const TrueContact& contact) {
  return contact.end_ns - contact.begin_ns <= 2 * kRootTolerance;
}

std::string Bracket(const Evidence& evidence, const v1::TimeBracket& bracket) {
  return "[" + evidence.Time(bracket.earliest_ns()) + ", " + evidence.Time(bracket.latest_ns()) +
         "]";
}

const char* Word(const Evidence& evidence) {
  return evidence.level() == nullptr ? "contact" : "crossing";
}

std::string Name(const Evidence& evidence, const TrueContact& contact) {
  return evidence.PairName(contact.a, contact.b) + ", true " + Word(evidence) + " " +
         evidence.Time(contact.begin_ns) + " to " + evidence.Time(contact.end_ns);
}

bool Withdrawn(const EventHistory& history, const TrueContact& contact) {
  return history.last().status() == v1::EVENT_WITHDRAWN &&
         contact.begin_ns >= history.last().begin().earliest_ns() - contact.begin_tolerance_ns;
}

const EventHistory* Find(const Evidence& evidence, const TrueContact& contact) {
  const bool leaving = evidence.MayHaveLeft(contact, contact.begin_ns);
  for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
    if (Brackets(history->last(), contact) || (leaving && Withdrawn(*history, contact)))
      return history;
  }
  for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
    if (Covers(evidence, history->last(), contact)) return history;
  }
  return nullptr;
}

// When one of the two last appeared or jumped before the contact began; nullopt: never.
std::optional<std::int64_t> LastChange(const Evidence& evidence, const TrueContact& contact) {
  std::optional<std::int64_t> last;
  for (const std::size_t i : {contact.a, contact.b}) {
    const AgentMotion& motion = evidence.motions()[i];
    const auto take = [&](std::int64_t at) {
      if (at <= contact.begin_ns) last = std::max(last.value_or(at), at);
    };
    take(motion.begin_ns());
    for (const std::int64_t jump : motion.jumps_ns) take(jump);
  }
  return last;
}

// The service publishes from when on changes of an agent count (`effective_from`), since time up to
// then was granted already. True if it did so for one of the two before the contact began; or no
// later than it announced the contact, if a simulator passed the contact's begin within granted
// time before it could receive the change.
bool InGrantedTime(const Evidence& evidence, const TrueContact& contact,
                   const EventHistory& history) {
  const std::optional<std::int64_t> change = LastChange(evidence, contact);
  bool granted = false;  // time beyond the contact's begin was granted before the change
  for (const v1::Clearance& sample : evidence.observations().clearances) {
    granted = granted || (change && sample.now_ns() <= *change &&
                          sample.granted_until_ns() > contact.begin_ns);
    for (const v1::AgentClearance& agent : sample.agents()) {
      if (agent.effective_from_ns() <= contact.begin_ns) continue;
      v1::AgentId id;
      id.set_simulator_id(sample.simulator_id());
      id.set_run(sample.run());
      id.set_slot(agent.slot());
      id.set_generation(agent.generation());
      const auto motion = evidence.MotionOf(id);
      if (motion != contact.a && motion != contact.b) continue;
      const Moment then{sample.now_ns(), sample.stamp()};
      return sample.now_ns() <= contact.begin_ns || (granted && !history.announced.IsAfter(then));
    }
  }
  return false;
}

// Whether an event of the pair was open when the contact began. An open event of an earlier contact
// is enough, since it reports the pair.
bool Reported(const Evidence& evidence, const TrueContact& contact) {
  for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
    const long double tolerance = contact.begin_tolerance_ns;
    if (history->announced.now_ns <= contact.begin_ns + tolerance &&
        (!history->closed || history->closed->now_ns >= contact.begin_ns - tolerance)) {
      return true;
    }
  }
  return false;
}

// A level that tells only what is expected need not announce the others; and with hysteresis the
// service may learn late that a pair has been far enough apart to be told again.
bool MayComeUnannounced(const Evidence& evidence, const TrueContact& contact) {
  const v1::Level* level = evidence.level();
  return level != nullptr && (level->basis() == v1::Level::EXPECTED || contact.long_visit > 1);
}

bool AnnouncedInTime(const Evidence& evidence, const TrueContact& contact,
                     const EventHistory& history) {
  if (MayComeUnannounced(evidence, contact) || Reported(evidence, contact)) return true;
  if (contact.from_start || history.last().began_before()) return true;
  const std::int64_t transit = evidence.facts().transit_ns;
  const auto begin = static_cast<std::int64_t>(contact.begin_ns);
  if (transit > 0 && evidence.Changed(contact, begin, contact.begin_ns)) return true;
  return InGrantedTime(evidence, contact, history);
}

// Whether hysteresis may hold it back: the pair crossed the level before in the same visit.
bool MayBeHeldBack(const Evidence& evidence, const TrueContact& contact) {
  if (evidence.level() == nullptr || !(evidence.level()->hysteresis_m() > 0)) return false;
  const auto& others = evidence.ContactsOf(contact.a);
  return std::any_of(others.begin(), others.end(), [&](const TrueContact* other) {
    return other->b == contact.b && other->a == contact.a &&
           other->long_visit == contact.long_visit && other->begin_ns < contact.begin_ns;
  });
}

bool Required(const Evidence& evidence, const TrueContact& contact) {
  return contact.certain && contact.begin_ns <= evidence.judged_until_ns() &&
         !TooShortToDemand(contact) && !MayBeHeldBack(evidence, contact);
}

// An event may end with any of the contacts that begin within its begin bracket: it does not say
// which one it means.
void CheckEnd(const Evidence& evidence, const TrueContact& contact, const EventHistory& history,
              Violations* violations) {
  const v1::CollisionEvent& event = history.last();
  if (contact.to_end || !Brackets(event, contact)) return;
  if (event.status() == v1::EVENT_CONFIRMED &&
      contact.balls_until_ns <= evidence.judged_until_ns()) {
    violations->push_back(Name(evidence, contact) + ": its event was never ended");
  }
  if (event.status() != v1::EVENT_ENDED) return;
  if (evidence.MayHaveLeft(contact, contact.end_ns) &&
      evidence.MayHaveLeft(contact, event.end().latest_ns())) {
    return;
  }
  for (const TrueContact* other : evidence.ContactsOf(contact.a)) {
    if (other->a != contact.a || other->b != contact.b) continue;
    if (event.continuous() && !Brackets(event, *other)) continue;
    if (In(other->end_ns, other->end_tolerance_ns, event.end().earliest_ns(),
           event.end().latest_ns()) ||
        InBlind(*other, event.end())) {
      return;
    }
  }
  violations->push_back(Name(evidence, contact) + ": its end is not in the published bracket " +
                        Bracket(evidence, event.end()));
}

void CheckContact(const Evidence& evidence, const TrueContact& contact, Violations* violations) {
  const EventHistory* history = Find(evidence, contact);
  if (history == nullptr) {
    std::string why = "no event of the pair";
    for (const EventHistory* other : evidence.HistoriesOf(contact.a, contact.b)) {
      why = "no event brackets its begin; the pair's last: " +
            v1::EventStatus_Name(other->last().status()) + ", begin " +
            Bracket(evidence, other->last().begin());
    }
    violations->push_back(Name(evidence, contact) + ": " + why);
    return;
  }
  if (!AnnouncedInTime(evidence, contact, *history)) {
    violations->push_back(Name(evidence, contact) + ": announced late, at " +
                          evidence.Time(history->announced.now_ns));
  }
  CheckEnd(evidence, contact, *history, violations);
}

// Whether a contact, or a possible one, begins where the confirmed event says.
bool IsTrue(const Evidence& evidence, const EventHistory& history,
            const v1::CollisionEvent& event) {
  for (const TrueContact* contact : evidence.ContactsOf(history.a)) {
    if (contact->a != history.a || contact->b != history.b) continue;
    if (Brackets(event, *contact) || InBlind(*contact, event.begin())) return true;
    if (!contact->certain && contact->begin_ns <= event.begin().latest_ns() + kRootTolerance &&
        contact->end_ns >= event.begin().earliest_ns() - kRootTolerance) {
      return true;
    }
  }
  return false;
}

// The first confirmed revision without a true contact.
void CheckConfirmed(const Evidence& evidence, const EventHistory& history, Violations* violations) {
  const auto& motions = evidence.motions();
  const std::int64_t logged = std::min(motions[history.a].end_ns(), motions[history.b].end_ns());
  for (const v1::CollisionEvent& event : history.revisions) {
    if (!IsConfirmed(event) || event.begin().latest_ns() > logged) continue;
    if (IsTrue(evidence, history, event)) continue;
    violations->push_back(evidence.PairName(history.a, history.b) + ": confirmed with begin " +
                          Bracket(evidence, event.begin()) + ", but no true " + Word(evidence) +
                          " begins there");
    return;
  }
}

}  // namespace

Violations CheckEvents(const Evidence& evidence) {
  Violations violations;
  for (const TrueContact& contact : evidence.contacts()) {
    if (Required(evidence, contact)) CheckContact(evidence, contact, &violations);
  }
  for (const EventHistory& history : evidence.histories())
    CheckConfirmed(evidence, history, &violations);
  if (!evidence.strange_events().empty()) {
    violations.push_back(std::to_string(evidence.strange_events().size()) +
                         " events name agents that no simulator logged");
  }
  return violations;
}

std::uint64_t ContactsUnannounced(const Evidence& evidence) {
  std::uint64_t count = 0;
  for (const TrueContact& contact : evidence.contacts()) {
    if (!Required(evidence, contact)) continue;
    const EventHistory* history = Find(evidence, contact);
    if (history == nullptr || !AnnouncedInTime(evidence, contact, *history)) ++count;
  }
  return count;
}

}  // namespace collision::checker
