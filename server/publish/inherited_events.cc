#include "server/publish/inherited_events.h"

#include <algorithm>
#include <iterator>

namespace collision::server {

detection::AgentId IdOf(const v1::AgentId& wire) {
  return {.simulator = wire.simulator_id(),
          .slot = wire.slot(),
          .run = wire.run(),
          .generation = wire.generation()};
}

namespace {

/// Of a contact [ns].
struct Times {
  std::int64_t earliest, latest;  // of its begin
  std::int64_t over;              // at the latest
  bool began_before;
};

Times TimesOf(const detection::CollisionEvent& event) {
  return {.earliest = event.begin.earliest.nanoseconds(),
          .latest = event.begin.latest.nanoseconds(),
          .over = event.end.latest.nanoseconds(),
          .began_before = event.began_before};
}

Times TimesOf(const v1::CollisionEvent& event) {
  return {.earliest = event.begin().earliest_ns(),
          .latest = event.begin().latest_ns(),
          .over = event.end().latest_ns(),
          .began_before = event.began_before()};
}

/// `found` was in progress when its service began to know the pair, and may be `other`.
bool IsFoundWithin(const Times& found, const Times& other) {
  return found.began_before && other.earliest <= found.latest && found.earliest <= other.over;
}

/// Whether the two are one contact.
bool Meet(const Times& a, const Times& b) {
  return IsFoundWithin(a, b) || IsFoundWithin(b, a) ||
         (a.earliest <= b.latest && b.earliest <= a.latest);
}

bool IsContact(const v1::CollisionEvent& event) { return event.contacts_sequence() > 0; }

}  // namespace

void InheritedEvents::BeginEpoch(std::uint32_t epoch) {
  untold_.clear();
  untold_of_.clear();
  decided_before_ = Instant::Always();
  if (epoch <= epoch_) return;
  epoch_ = epoch;
  pairs_.Clear();
  told_.clear();
}

void InheritedEvents::Hear(const v1::CollisionEvent& event) {
  if (event.stamp().epoch() < epoch_) return;
  if (event.stamp().epoch() > epoch_) {
    epoch_ = event.stamp().epoch();
    pairs_.Clear();
    told_.clear();
  }
  if (IsContact(event)) {
    if (told_.size() == kRepeatedMax) told_.pop_front();
    told_.push_back(event);
  }
  const Pair pair{IdOf(event.lower()), IdOf(event.higher())};
  Heard& heard = pairs_.Touch(pair);
  heard.ours = 0;
  // Contacts and forecasts come on two topics, in any order.
  if (event.contact() > heard.number || (event.contact() == heard.number && heard.is_open)) {
    heard.number = event.contact();
    heard.is_open = event.status() == v1::EVENT_POSSIBLE;
  }
  if (!IsContact(event)) {
    const bool dismissed = event.status() == v1::EVENT_DISMISSED;
    heard.free_until_ns = std::max(
        {heard.free_until_ns, event.begin().earliest_ns(), dismissed ? event.now_ns() : 0});
  }
  const v1::CollisionEvent& before = heard.contact;
  if (IsContact(event) &&
      (event.contact() > before.contact() ||
       (event.contact() == before.contact() && before.status() == v1::EVENT_CONFIRMED))) {
    heard.contact = event;
  }
  DropTold(pair);
}

void InheritedEvents::Keep(const Event& contact, const PairLabels& labels) {
  if (IsTold(contact)) return;
  if (untold_.size() == kUntoldMax) DropOldest();
  untold_of_[{contact.lower, contact.higher}].push_back(
      untold_.insert(untold_.end(), {contact, labels}));
}

void InheritedEvents::DropTold(const Pair& pair) {
  const auto of_pair = untold_of_.find(pair);
  if (of_pair == untold_of_.end()) return;
  Drop(&of_pair->second, [this](const Event& contact) { return IsTold(contact); });
  if (of_pair->second.empty()) untold_of_.erase(of_pair);
}

void InheritedEvents::DropUndecided(Instant before) {
  decided_before_ = std::max(decided_before_, before);
  for (auto& [pair, contacts] : untold_of_) {
    Drop(&contacts, [this](const Event& contact) { return IsTold(contact); });
  }
  std::erase_if(untold_of_, [](const auto& of_pair) { return of_pair.second.empty(); });
}

template <typename Predicate>
void InheritedEvents::Drop(std::deque<Untold::iterator>* contacts, const Predicate& is_dropped) {
  std::erase_if(*contacts, [&](Untold::iterator contact) {
    if (!is_dropped(contact->event)) return false;
    untold_.erase(contact);
    return true;
  });
}

void InheritedEvents::DropOldest() {
  const Event& oldest = untold_.front().event;
  const auto of_pair = untold_of_.find({oldest.lower, oldest.higher});
  of_pair->second.pop_front();
  if (of_pair->second.empty()) untold_of_.erase(of_pair);
  untold_.pop_front();
}

std::vector<UntoldContact> InheritedEvents::TakeUntold() {
  std::vector<UntoldContact> untold(untold_.begin(), untold_.end());
  untold_.clear();
  untold_of_.clear();
  return untold;
}

std::vector<v1::CollisionEvent> InheritedEvents::TakeTold() {
  std::vector<v1::CollisionEvent> told(told_.begin(), told_.end());
  told_.clear();
  return told;
}

std::uint32_t InheritedEvents::NumberOf(const Event& event) {
  Heard* heard = pairs_.Find({event.lower, event.higher});
  if (heard == nullptr) return event.contact;
  if (event.contact <= heard->ours) {
    const std::uint32_t earlier = heard->ours - event.contact;
    return std::max(heard->for_readers, earlier + 1) - earlier;
  }
  // Each that is new goes on with the open forecast, or comes after all that readers know.
  const std::uint32_t next = heard->is_open ? heard->number : heard->number + 1;
  if (heard->ours > 0) {
    heard->for_readers = std::max(heard->for_readers + event.contact - heard->ours, next);
  } else if (IsContact(heard->contact) && Meet(TimesOf(event), TimesOf(heard->contact))) {
    heard->for_readers = heard->contact.contact();
  } else {
    heard->for_readers = std::max(event.contact, next);
  }
  heard->ours = event.contact;
  return heard->for_readers;
}

/// Whether readers know as much of it, or a later contact of its pair.
bool InheritedEvents::IsTold(const Event& contact) {
  const bool undecided = contact.status == detection::EventStatus::kUndecided;
  if (undecided && contact.end.latest <= decided_before_) return true;
  const Heard* heard = pairs_.Find({contact.lower, contact.higher});
  if (heard == nullptr) return false;
  // The other service knew more states, and has found that there was no contact.
  if (undecided && contact.end.latest.nanoseconds() <= heard->free_until_ns) return true;
  if (!IsContact(heard->contact)) return false;
  const Times ours = TimesOf(contact), theirs = TimesOf(heard->contact);
  if (!Meet(ours, theirs)) return ours.earliest < theirs.earliest;
  return heard->contact.status() != v1::EVENT_CONFIRMED ||
         contact.status == detection::EventStatus::kConfirmed;
}

}  // namespace collision::server
