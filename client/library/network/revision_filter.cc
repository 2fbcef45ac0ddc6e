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
  const Pair pair{Id(event.lower()), Id(event.higher())};
  Known* known = Find(pair);
  if (known != nullptr && IsOutdated(event, *known)) {
    // A contact is history: it counts, however late it comes.
    return is_contact && known->service == event.stamp().service_id();
  }
  const bool repeated = known != nullptr && IsRepeated(event, *known);
  if (repeated && is_contact) ++contacts_repeated_;
  // What is over stays over.
  if (repeated && event.status() != known->status) return false;
  if (known_.size() >= kPairsMax) {
    earlier_ = std::move(known_);
    known_.clear();
  }
  known_[pair] = {
      event.stamp().service_id(),  event.contact(),          event.revision(), event.status(),
      event.begin().earliest_ns(), event.begin().latest_ns()};
  return !repeated;
}

bool RevisionFilter::IsRepeated(const v1::CollisionEvent& event, const Known& known) {
  if (known.service == event.stamp().service_id()) return false;
  const bool same = event.contact() == known.contact;
  if (IsForecast(event.status())) {
    return same && event.status() == known.status &&
           event.begin().earliest_ns() >= known.begin_earliest_ns;
  }
  // Of an earlier contact of the pair readers of this one have been told.
  if (!IsForecast(known.status) && event.begin().latest_ns() < known.begin_earliest_ns) return true;
  const bool meets = event.begin().earliest_ns() <= known.begin_latest_ns &&
                     known.begin_earliest_ns <= event.begin().latest_ns();
  const bool is_over = known.status == v1::EVENT_ENDED || known.status == v1::EVENT_UNDECIDED;
  return same && meets && (event.status() == known.status || (is_over && !event.began_before()));
}

bool RevisionFilter::IsOutdated(const v1::CollisionEvent& event, const Known& known) {
  if (known.service != event.stamp().service_id()) return false;
  return std::pair(event.contact(), event.revision()) <= std::pair(known.contact, known.revision);
}

RevisionFilter::Known* RevisionFilter::Find(const Pair& pair) {
  if (const auto found = known_.find(pair); found != known_.end()) return &found->second;
  const auto found = earlier_.find(pair);
  return found != earlier_.end() ? &found->second : nullptr;
}

RevisionFilter::Agent RevisionFilter::Id(const v1::AgentId& id) {
  return {id.simulator_id(), id.run(), id.slot(), id.generation()};
}

}  // namespace collision::client
