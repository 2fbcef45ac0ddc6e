#include "server/publish/inherited_events.h"

#include <algorithm>
#include <iterator>

namespace collision::server {
namespace {

detection::AgentId IdOf(const v1::AgentId& wire) {
  return {.simulator = wire.simulator_id(),
          .slot = wire.slot(),
          .run = wire.run(),
          .generation = wire.generation()};
}

bool IsFinal(v1::EventStatus status) {
  return status != v1::EVENT_POSSIBLE && status != v1::EVENT_CONFIRMED;
}

v1::EventStatus StatusOf(const detection::CollisionEvent& event) {
  return static_cast<v1::EventStatus>(event.status);
}

}  // namespace

void InheritedEvents::Hear(const v1::CollisionEvent& event) {
  const Pair pair{IdOf(event.lower()), IdOf(event.higher())};
  const Heard heard{.contact = event.contact(),
                    .status = event.status(),
                    .begin_earliest_ns = event.begin().earliest_ns(),
                    .begin_latest_ns = event.begin().latest_ns(),
                    .offset = {}};
  Heard* known = Find(pair);
  // Contacts and forecasts come on two topics, in any order.
  if (known != nullptr && (event.contact() < known->contact ||
                           (event.contact() == known->contact && IsFinal(known->status)))) {
    return;
  }
  if (pairs_.size() >= kPairsMax) {
    earlier_ = std::move(pairs_);
    pairs_.clear();
  }
  pairs_[pair] = heard;
  std::erase_if(untold_, [&](const Event& contact) {
    return Pair{contact.lower, contact.higher} == pair && IsTold(contact);
  });
}

void InheritedEvents::Keep(const Event& contact) {
  if (IsTold(contact)) return;
  if (untold_.size() == kUntoldMax) untold_.pop_front();
  untold_.push_back(contact);
}

std::vector<InheritedEvents::Event> InheritedEvents::TakeUntold() {
  std::vector<Event> untold(std::make_move_iterator(untold_.begin()),
                            std::make_move_iterator(untold_.end()));
  untold_.clear();
  return untold;
}

std::uint32_t InheritedEvents::NumberOf(const Event& event) {
  Heard* heard = Find({event.lower, event.higher});
  if (heard == nullptr) return event.contact;
  if (!heard->offset) heard->offset = OffsetOf(event, *heard);
  return static_cast<std::uint32_t>(std::max<std::int64_t>(event.contact + *heard->offset, 1));
}

InheritedEvents::Heard* InheritedEvents::Find(const Pair& pair) {
  if (const auto found = pairs_.find(pair); found != pairs_.end()) return &found->second;
  const auto found = earlier_.find(pair);
  return found != earlier_.end() ? &found->second : nullptr;
}

std::int64_t InheritedEvents::OffsetOf(const Event& event, const Heard& heard) {
  const std::int64_t same = std::int64_t{heard.contact} - event.contact;
  // What was over before counts no more: our number is one that readers do not know.
  if (IsFinal(heard.status) && same < 0) return 0;
  const bool meet = event.begin.earliest.nanoseconds() <= heard.begin_latest_ns &&
                    heard.begin_earliest_ns <= event.begin.latest.nanoseconds();
  if (same == 0 || meet) return same;
  if (same < 0) return 0;
  if (!IsFinal(heard.status)) return same;
  return event.begin.earliest.nanoseconds() > heard.begin_latest_ns ? same + 1 : same - 1;
}

/// Whether readers know as much of it, or of a later contact of its pair.
bool InheritedEvents::IsTold(const Event& contact) {
  const Heard* heard = Find({contact.lower, contact.higher});
  if (heard == nullptr) return false;
  const std::int64_t number = contact.contact + OffsetOf(contact, *heard);
  if (number != heard->contact) return number < heard->contact;
  return IsFinal(heard->status) || heard->status == StatusOf(contact);
}

}  // namespace collision::server
