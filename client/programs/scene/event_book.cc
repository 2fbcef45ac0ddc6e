#include "client/programs/scene/event_book.h"

#include <utility>

namespace collision::client {
namespace {

bool IsOpen(v1::EventStatus status) {
  return status == v1::EVENT_POSSIBLE || status == v1::EVENT_CONFIRMED;
}

}  // namespace

void EventBook::Take(const v1::CollisionEvent& event) {
  const v1::ServiceStamp& stamp = event.stamp();
  if (stamp.service_id() == service_ && stamp.epoch() < epoch_) return;  // of a former epoch
  if (const auto ended = slots_.Take(event)) Supersede(*ended);
  const Key key = KeyOf(event);
  const auto [place, is_new] = events_.try_emplace(key);
  Entry& entry = place->second;
  if (is_new) {
    entry.number = ++last_;
    by_age_[entry.number] = key;
  }
  const bool is_of_another = entry.newest.stamp().service_id() == stamp.service_id() &&
                             entry.newest.stamp().epoch() < stamp.epoch();
  if (is_of_another) entry.revisions.clear();
  entry.newest = event;
  entry.is_superseded = false;
  entry.revisions.push_back({.now_ns = event.now_ns(),
                             .begin = event.begin(),
                             .end = event.end(),
                             .status = event.status()});
  if (entry.revisions.size() > kRevisionsMax) {
    std::vector<Revision> kept;
    for (std::size_t i = 1; i < entry.revisions.size(); i += 2) kept.push_back(entry.revisions[i]);
    if (entry.revisions.size() % 2 == 1) kept.push_back(entry.revisions.back());
    entry.revisions = std::move(kept);
  }
  changed_.insert(key);
  if (events_.size() > kEventsMax) DropOldest();
}

void EventBook::Supersede(const Key& key) {
  const auto former = events_.find(key);
  if (former == events_.end() || former->second.newest.status() != v1::EVENT_POSSIBLE) return;
  former->second.is_superseded = true;
  changed_.insert(key);
}

/// The oldest that came to nothing; where none did, the oldest that is over, or else the oldest.
void EventBook::DropOldest() {
  auto over = by_age_.end();
  for (auto next = by_age_.begin(); next != by_age_.end(); ++next) {
    const Entry& entry = events_.at(next->second);
    if (entry.CameToNothing()) return Drop(next);
    if (over == by_age_.end() && !IsOpen(entry.newest.status())) over = next;
  }
  Drop(over == by_age_.end() ? by_age_.begin() : over);
}

void EventBook::Drop(std::map<std::uint64_t, Key>::iterator oldest) {
  dropped_.push_back(oldest->first);
  changed_.erase(oldest->second);
  events_.erase(oldest->second);
  by_age_.erase(oldest);
}

void EventBook::ForgetEpochsBefore(const v1::ServiceStamp& stamp, std::uint64_t service) {
  if (service == service_ && stamp.epoch() == epoch_) return;
  service_ = service;
  epoch_ = stamp.epoch();
  for (auto next = by_age_.begin(); next != by_age_.end();) {
    const auto one = next++;
    const v1::ServiceStamp& told = events_.at(one->second).newest.stamp();
    if (told.service_id() == service && told.epoch() < stamp.epoch()) Drop(one);
  }
}

std::vector<std::uint64_t> EventBook::Numbers() const {
  std::vector<std::uint64_t> numbers;
  for (const auto& [number, key] : by_age_) numbers.push_back(number);
  return numbers;
}

EventBook::Changes EventBook::TakeChanges() {
  Changes changes{.dropped = std::exchange(dropped_, {}), .changed = {}};
  for (const Key& key : std::exchange(changed_, {})) {
    changes.changed.push_back(events_.at(key).number);
  }
  return changes;
}

}  // namespace collision::client
