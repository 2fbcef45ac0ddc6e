// Which revisions of events are published, and on which topic.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "collision_core/detection/events/collision_event.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Whether a revision is history (confirmed, ended, undecided), of which no reader may miss any;
/// the others are opinions about the future (possible, dismissed, withdrawn), of which only the
/// newest of a pair counts.
bool IsContact(detection::EventStatus status);

/// A revision to be published.
struct Telling {
  detection::CollisionEvent event;
  bool contact = false;  ///< On the topic of contacts; else on that of forecasts.
};

/// Stands between the detector, which revises an event whenever it knows better, and the readers,
/// who want to hear what is new. The detector's revision numbers stay: a reader sees them grow.
///
/// A *contact* is told when its status changes, and while it is confirmed when its begin bracket
/// has become narrower than half of the one told last. Point and normal belong to the end of that
/// bracket, so they change with it.
///
/// A *forecast* is told
///  - when it is new, when it is dismissed or withdrawn after it was told, and, with that status,
///    when its pair turns out to be a contact;
///  - when its certified begin is earlier than told;
///  - when the two are expected to touch, and were not as told, or the other way about;
///  - when that is later by more than a quarter of what is left until the begin told, and what is
///    left now differs by more than a quarter from what was left then. Two people side by side
///    could always meet in half a second: each moment moves the begin, and says nothing new.
/// In one step only the newest of a pair is told. New and moved forecasts are told at most at the
/// configured rate, the soonest begin first, and wait otherwise; a newer revision replaces one that
/// waits. What may begin within a temporal resolution does not wait, so that no contact begins
/// before its forecast was told. Nothing else waits.
///
/// Depends on nothing but the calls. O(log pairs) for each event; at most one entry for each of the
/// detector's pair slots.
class EventFilter {
 public:
  explicit EventFilter(const v1::Config& config);

  /// What to publish after the events of a step, in this order. `now` is that of the step, and
  /// `time_ns` grows with the time by which the rate counts.
  std::vector<Telling> Take(const std::vector<detection::CollisionEvent>& events, Instant now,
                            std::int64_t time_ns);

  /// What stands told and is not over, by pair: of each its contact, or else its forecast.
  std::vector<Telling> Standing() const;

  /// The detector and its time begin anew.
  void Forget();

  /// Revisions of forecasts that said nothing new, or were replaced while they waited.
  std::uint64_t withheld() const { return withheld_; }

 private:
  using Event = detection::CollisionEvent;

  /// What was told of the event that a pair slot has now.
  struct Pair {
    std::optional<Event> contact;   ///< Told last.
    std::optional<Event> forecast;  ///< Told last, and not over to its readers.
    std::optional<Event> waiting;   ///< To be told.
  };

  void TakeContact(const Event& event, Pair* pair, std::vector<Telling>* tellings);
  void TakePossible(const Event& event, Pair* pair);
  bool IsNews(const Event& event, const Event& told) const;
  std::int64_t Left(const Event& event) const;
  void Drop(Pair* pair);
  void Refill(std::int64_t time_ns);
  void Release(Instant now, std::vector<Telling>* tellings);

  const std::int64_t temporal_resolution_ns_;
  const std::int64_t per_second_max_;
  std::map<std::uint32_t, Pair> pairs_;                ///< By slot.
  std::set<std::pair<Instant, std::uint32_t>> queue_;  ///< Begin and slot of those that wait.
  std::int64_t credit_;                                ///< Forecasts that may be told, in 1e-9.
  std::optional<std::int64_t> time_ns_;
  std::uint64_t withheld_ = 0;
};

}  // namespace collision::server
