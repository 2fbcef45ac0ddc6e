#include "server/detectors/hysteresis.h"

#include <algorithm>
#include <utility>

namespace collision::server {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;

/// By when it has begun if it is a crossing; Never(): it is not known. Of a forecast, from when on
/// it may begin: what is told of it later is then told, too.
Instant BegunBy(const CollisionEvent& event) {
  if (event.status == EventStatus::kPossible) return event.begin.earliest;
  return event.status == EventStatus::kUndecided ? event.end.latest : event.begin.latest;
}

/// When the two were certainly free of each other, as the event says; Never(): it does not.
Instant FreeAt(const CollisionEvent& event) {
  const bool is_over =
      event.status == EventStatus::kEnded || event.status == EventStatus::kUndecided;
  return is_over ? event.end.latest : Instant::Never();
}

bool IsCrossing(EventStatus status) {
  return status == EventStatus::kConfirmed || status == EventStatus::kEnded;
}

bool CameToNothing(EventStatus status) {
  return status == EventStatus::kDismissed || status == EventStatus::kWithdrawn;
}

}  // namespace

std::vector<CollisionEvent> Hysteresis::Take(const std::vector<Event>& near,
                                             const std::vector<Event>& far) {
  std::vector<Event> told;
  for (const Event& event : near) {
    Pair* known = pairs_.Find({event.lower, event.higher});
    if (known != nullptr && !IsTold(event, *known)) {
      Hold(event, known);
      continue;
    }
    told.push_back(event);
    Note(event);
  }
  for (const Event& event : far) {
    Pair* pair = pairs_.Find({event.lower, event.higher});
    const Instant free = FreeAt(event);
    if (pair == nullptr || free.is_never()) continue;
    if (pair->apart.size() == kTimesMax) pair->apart.pop_back();
    pair->apart.push_back(free);
    if (!pair->held || !IsTold(*pair->held, *pair)) continue;
    told.push_back(*std::exchange(pair->held, std::nullopt));
    Note(told.back());
  }
  return told;
}

bool Hysteresis::IsTold(const Event& event, const Pair& pair) {
  if (event.contact == pair.told || event.began_before) return true;
  const Instant by = BegunBy(event);
  return std::ranges::any_of(pair.apart,
                             [&](Instant apart) { return pair.begin < apart && apart <= by; });
}

/// The event is told: what was held back of the pair is over.
void Hysteresis::Note(const Event& event) {
  if (!IsCrossing(event.status)) return;
  Pair& pair = pairs_.Touch({event.lower, event.higher});
  if (pair.held) ++withheld_;
  pair.held.reset();
  pair.told = event.contact;
  pair.begin = event.begin.latest;
  std::erase_if(pair.apart, [&](Instant apart) { return apart <= pair.begin; });
}

/// A forecast that comes to nothing was never told, and so is not told to be over.
void Hysteresis::Hold(const Event& event, Pair* pair) {
  if (pair->held) ++withheld_;
  pair->held.reset();
  if (CameToNothing(event.status)) {
    ++withheld_;
  } else {
    pair->held = event;
  }
}

}  // namespace collision::server
