#include "client/library/network/revision_filter.h"

namespace collision::client {

bool IsForecast(v1::EventStatus status) {
  return status == v1::EVENT_POSSIBLE || status == v1::EVENT_DISMISSED ||
         status == v1::EVENT_WITHDRAWN;
}

bool RevisionFilter::IsNew(const v1::CollisionEvent& event, ContactSequence* contacts) {
  const bool is_contact = event.contacts_sequence() > 0;
  if (is_contact ? !contacts->Take(event.contacts_sequence()) : !IsForecast(event.status()))
    return false;
  return Take(event, is_contact);
}

bool RevisionFilter::Take(const v1::CollisionEvent& event, bool is_contact) {
  // What has come of an earlier epoch is history.
  if (IsPast(event.stamp())) return is_contact;
  const Pair pair{Id(event.lower()), Id(event.higher()), event.level()};
  Known* known = known_.Find(pair);
  const Revision revision{
      event.stamp().service_id(),  event.contact(),          event.revision(), event.status(),
      event.begin().earliest_ns(), event.begin().latest_ns()};
  const bool repeated = known != nullptr && IsRepeated(event, is_contact, *known);
  if (known != nullptr && !repeated && IsOutdated(event, *known)) {
    if (!is_contact) return false;
    // A contact is history: it counts, however late it comes, but once.
    Revision& last = known->last_contact;
    const bool says_the_same = revision.service == last.service &&
                               revision.contact == last.contact && revision.status == last.status &&
                               revision.begin_earliest_ns == last.begin_earliest_ns &&
                               revision.begin_latest_ns == last.begin_latest_ns;
    if (says_the_same) return false;
    if (revision.contact >= last.contact) last = revision;
    return true;
  }
  if (repeated && is_contact) {
    ++contacts_repeated_;
    // What is over stays over, and what came after it stays the newest.
    if (event.status() != known->last_contact.status || event.contact() < known->newest.contact) {
      return false;
    }
  }
  Known next = known != nullptr ? *known : Known();
  next.newest = revision;
  if (is_contact) next.last_contact = revision;
  known_.Touch(pair) = next;
  return !repeated;
}

bool RevisionFilter::IsRepeated(const v1::CollisionEvent& event, bool is_contact,
                                const Known& known) {
  if (!is_contact) {
    return event.stamp().service_id() != known.newest.service &&
           event.contact() == known.newest.contact && event.status() == known.newest.status &&
           event.begin().earliest_ns() >= known.newest.begin_earliest_ns;
  }
  const Revision& last = known.last_contact;
  if (last.contact == 0 || last.service == event.stamp().service_id()) return false;
  // Of an earlier contact of the pair readers of this one have been told.
  if (event.begin().latest_ns() < last.begin_earliest_ns) return true;
  const bool same = event.contact() == last.contact &&
                    event.begin().earliest_ns() <= last.begin_latest_ns &&
                    last.begin_earliest_ns <= event.begin().latest_ns();
  const bool is_over = last.status == v1::EVENT_ENDED || last.status == v1::EVENT_UNDECIDED;
  return same && (event.status() == last.status || is_over);
}

bool RevisionFilter::IsOutdated(const v1::CollisionEvent& event, const Known& known) {
  if (known.newest.service != event.stamp().service_id()) return false;
  return std::pair(event.contact(), event.revision()) <=
         std::pair(known.newest.contact, known.newest.revision);
}

/// Whether it is of an earlier epoch than the newest event. With a later one all is forgotten.
bool RevisionFilter::IsPast(const v1::ServiceStamp& stamp) {
  if (stamp.service_id() == service_ && stamp.epoch() < epoch_) return true;
  if (stamp.epoch() > epoch_) known_.Clear();
  service_ = stamp.service_id();
  epoch_ = stamp.epoch();
  return false;
}

RevisionFilter::Agent RevisionFilter::Id(const v1::AgentId& id) {
  return {id.simulator_id(), id.run(), id.slot(), id.generation()};
}

}  // namespace collision::client
