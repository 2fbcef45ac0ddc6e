// What readers know of contacts from the service beside which this one stands by.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/detection/events/collision_event.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// Compares the contacts that a standby finds with those that the service in force publishes, so
/// that after a take-over none is lost and none is told as another one.
///
/// Both services see the same inputs and find the same contacts, but may hear of them in other
/// steps, or one of them joined later: then it has counted fewer contacts of a pair. An event of
/// one is that of the other if they have one number, if that of the other is open, or if their
/// begin brackets meet; the standby goes on with the numbers that readers know.
///
/// Depends on nothing but the calls. O(log pairs) for each event; at most 2 kPairsMax pairs and
/// kUntoldMax contacts. One thread.
class InheritedEvents {
 public:
  /// Pairs that are remembered; beyond twice as many those heard of longest ago are forgotten, and
  /// their contacts are numbered as this service counts them.
  static constexpr std::size_t kPairsMax = 32768;

  /// Contacts that the other service has not published yet; beyond, the oldest are given up.
  static constexpr std::size_t kUntoldMax = 32768;

  /// The service in force has published this.
  void Hear(const v1::CollisionEvent& event);

  /// This service, standing by, would publish this contact.
  void Keep(const detection::CollisionEvent& contact);

  /// It takes over: the contacts that have not been published, in their order.
  std::vector<detection::CollisionEvent> TakeUntold();

  /// The number of the event's contact for readers.
  std::uint32_t NumberOf(const detection::CollisionEvent& event);

 private:
  using Event = detection::CollisionEvent;
  using Pair = std::pair<detection::AgentId, detection::AgentId>;

  /// The newest that was heard of a pair.
  struct Heard {
    std::uint32_t contact = 0;
    v1::EventStatus status{};
    std::int64_t begin_earliest_ns = 0, begin_latest_ns = 0;
    std::optional<std::int64_t> offset;  ///< Readers' numbers less ours, once one was used.
  };

  Heard* Find(const Pair& pair);
  static std::int64_t OffsetOf(const Event& event, const Heard& heard);
  bool IsTold(const Event& contact);

  std::map<Pair, Heard> pairs_, earlier_;  ///< When the first is full it takes the other's place.
  std::deque<Event> untold_;
};

}  // namespace collision::server
