#include "server/publish/event_filter.h"

#include <algorithm>

#include "server/world/world.h"

namespace collision::server {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;

/// What one forecast takes of the credit; a second at the rate of one a second gives it back.
constexpr std::int64_t kOne = 1'000'000'000;

/// The rate may be used up at once for so long.
constexpr std::int64_t kBurstNs = 1'000'000'000;

bool IsFinal(EventStatus status) {
  return status != EventStatus::kPossible && status != EventStatus::kConfirmed;
}

bool SameEvent(const CollisionEvent& a, const CollisionEvent& b) {
  return a.lower == b.lower && a.higher == b.higher && a.contact == b.contact;
}

/// Whether the two touch if both keep their motion.
bool IsExpected(const CollisionEvent& event) {
  return event.expected && event.expected->outcome == detection::ExpectedOutcome::kTouch;
}

/// The width of its begin bracket [ns], also where nothing is known of its beginning.
std::uint64_t Width(const CollisionEvent& event) {
  return static_cast<std::uint64_t>(event.begin.latest.nanoseconds()) -
         static_cast<std::uint64_t>(event.begin.earliest.nanoseconds());
}

}  // namespace

bool IsContact(EventStatus status) {
  return status == EventStatus::kConfirmed || status == EventStatus::kEnded ||
         status == EventStatus::kUndecided;
}

EventFilter::EventFilter(const v1::Config& config)
    : temporal_resolution_ns_(ToNanoseconds(config.temporal_resolution_s())),
      per_second_max_(config.forecasts_per_second_max()),
      credit_(per_second_max_ * kBurstNs) {}

std::vector<Telling> EventFilter::Take(const std::vector<CollisionEvent>& events, Instant now,
                                       std::int64_t time_ns) {
  Refill(time_ns);
  std::vector<Telling> tellings;
  for (const CollisionEvent& event : events) {
    Pair& pair = pairs_[event.pair_slot];
    const auto& known = pair.contact ? pair.contact : pair.forecast ? pair.forecast : pair.waiting;
    if (known && !SameEvent(*known, event)) {
      Drop(&pair);
      pair = {};
    }
    if (IsContact(event.status)) {
      TakeContact(event, &pair, &tellings);
    } else if (event.status == EventStatus::kPossible) {
      TakePossible(event, &pair);
    } else {
      Drop(&pair);
      if (pair.forecast) tellings.push_back({event, false});
      withheld_ += pair.forecast ? 0 : 1;
    }
    if (IsFinal(event.status)) pairs_.erase(event.pair_slot);
  }
  Release(now, &tellings);
  return tellings;
}

void EventFilter::TakeContact(const Event& event, Pair* pair, std::vector<Telling>* tellings) {
  const bool news = !pair->contact || pair->contact->status != event.status ||
                    Width(event) < Width(*pair->contact) / 2;
  if (!news) return;
  tellings->push_back({event, true});
  pair->contact = event;
  Drop(pair);
  if (pair->forecast) tellings->push_back({event, false});
  pair->forecast.reset();
}

void EventFilter::TakePossible(const Event& event, Pair* pair) {
  Drop(pair);
  if (pair->forecast && !IsNews(event, *pair->forecast)) {
    ++withheld_;
    return;
  }
  pair->waiting = event;
  queue_.emplace(event.begin.earliest, event.pair_slot);
}

bool EventFilter::IsNews(const Event& event, const Event& told) const {
  if (IsExpected(event) != IsExpected(told)) return true;
  const Instant begin = event.begin.earliest, told_begin = told.begin.earliest;
  if (begin <= told_begin) return begin < told_begin;
  if (told_begin > event.now) {
    const std::int64_t moved = begin.nanoseconds() - told_begin.nanoseconds();
    if (moved <= (told_begin.nanoseconds() - event.now.nanoseconds()) / 4) return false;
  }
  const std::int64_t left = Left(event), told_left = Left(told);
  return left < told_left - told_left / 4 || told_left < left - left / 4;
}

/// How far ahead its begin is, at least a temporal resolution: nearer ones are equally near.
std::int64_t EventFilter::Left(const Event& event) const {
  if (event.begin.earliest <= event.now) return temporal_resolution_ns_;
  return std::max(temporal_resolution_ns_,
                  event.begin.earliest.nanoseconds() - event.now.nanoseconds());
}

/// What waited is not told any more.
void EventFilter::Drop(Pair* pair) {
  if (!pair->waiting) return;
  queue_.erase({pair->waiting->begin.earliest, pair->waiting->pair_slot});
  pair->waiting.reset();
  ++withheld_;
}

void EventFilter::Refill(std::int64_t time_ns) {
  const std::int64_t passed = time_ns_ ? time_ns - *time_ns_ : 0;
  time_ns_ = time_ns;
  credit_ += std::clamp<std::int64_t>(passed, 0, kBurstNs) * per_second_max_;
  credit_ = std::min(credit_, kBurstNs * per_second_max_);
}

void EventFilter::Release(Instant now, std::vector<Telling>* tellings) {
  const Instant soon = Instant::FromNanoseconds(now.nanoseconds() + temporal_resolution_ns_);
  while (!queue_.empty()) {
    const auto [begin, slot] = *queue_.begin();
    if (credit_ < kOne && begin > soon) return;
    credit_ = std::max<std::int64_t>(credit_ - kOne, 0);
    queue_.erase(queue_.begin());
    Pair& pair = pairs_.at(slot);
    pair.forecast = std::exchange(pair.waiting, std::nullopt);
    tellings->push_back({*pair.forecast, false});
  }
}

std::vector<Telling> EventFilter::Standing() const {
  std::vector<Telling> tellings;
  for (const auto& [slot, pair] : pairs_) {
    if (pair.contact) {
      tellings.push_back({*pair.contact, true});
    } else if (pair.forecast) {
      tellings.push_back({*pair.forecast, false});
    }
  }
  return tellings;
}

void EventFilter::Forget() {
  pairs_.clear();
  queue_.clear();
  time_ns_.reset();
  credit_ = kBurstNs * per_second_max_;
}

}  // namespace collision::server
