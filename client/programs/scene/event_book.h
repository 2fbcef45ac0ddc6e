// The events of a world with the history of their brackets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "client/programs/shared/forecast_slots.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Keeps each event with what its revisions said, the newest kEventsMax; those that came to
/// nothing go first. One thread.
class EventBook {
 public:
  static constexpr std::size_t kEventsMax = 4096;
  /// Of one event; then every second one but the newest is forgotten.
  static constexpr std::size_t kRevisionsMax = 256;

  void Take(const v1::CollisionEvent& event);

  /// This stamp of this service counts: what it told in former epochs is forgotten.
  void ForgetEpochsBefore(const v1::ServiceStamp& stamp, std::uint64_t service);

  struct Revision {
    std::int64_t now_ns = 0;
    v1::TimeBracket begin, end;
    v1::EventStatus status = v1::EVENT_POSSIBLE;
  };

  struct Entry {
    std::uint64_t number = 0;  ///< From 1, in the order in which events were told first.
    v1::CollisionEvent newest;
    std::vector<Revision> revisions;
    bool is_superseded = false;  ///< A forecast of which nothing more will be told.

    bool CameToNothing() const {
      return is_superseded || newest.status() == v1::EVENT_DISMISSED ||
             newest.status() == v1::EVENT_WITHDRAWN;
    }
  };

  /// By their numbers.
  struct Changes {
    std::vector<std::uint64_t> dropped;  ///< Not kept any more.
    std::vector<std::uint64_t> changed;
  };

  /// Since the last call.
  Changes TakeChanges();

  /// Of all that are kept, the oldest first.
  std::vector<std::uint64_t> Numbers() const;

  /// Requires that it is kept.
  const Entry& At(std::uint64_t number) const { return events_.at(by_age_.at(number)); }

 private:
  using Key = EventKey;

  void Supersede(const Key& key);
  void Drop(std::map<std::uint64_t, Key>::iterator oldest);
  void DropOldest();

  std::map<Key, Entry> events_;
  std::map<std::uint64_t, Key> by_age_;  ///< By the number of the event.
  std::set<Key> changed_;
  ForecastSlots slots_;
  std::vector<std::uint64_t> dropped_;
  std::uint64_t last_ = 0;
  std::uint64_t service_ = 0;  ///< In force, and its epoch.
  std::uint32_t epoch_ = 0;
};

}  // namespace collision::client
