// What readers know of contacts from the service beside which this one stands by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/base/recent_map.h"
#include "collision_core/detection/events/collision_event.h"
#include "idl/messages.pb.h"
#include "server/publish/identity/event_labels.h"

namespace collision::server {

detection::AgentId IdOf(const v1::AgentId& wire);

/// A contact that readers have not been told of, and what its agents are called.
struct UntoldContact {
  detection::CollisionEvent event;
  PairLabels labels;
};

/// Compares the contacts that a standby finds with those that the service in force publishes, so
/// that after a take-over none is lost and none is told as another one.
///
/// Both services see the same inputs and find the same contacts, but may hear of them in other
/// steps, and one that joined late has counted other contacts of a pair. So contacts are compared
/// by their times: those of one pair have freedom between them, in which brackets never meet. One
/// that began before a service knew its pair is the one that was in progress then. The standby goes
/// on with the numbers that readers know.
///
/// All of it is of one epoch: times and numbers begin anew with the next one.
///
/// Depends on nothing but the calls. Amortised O(log pairs) for each event, and for each contact of
/// its pair that readers do not know; at most 2 kPairsMax pairs and
/// kUntoldMax contacts. One thread.
class InheritedEvents {
 public:
  /// Pairs that are remembered; beyond twice as many those heard of longest ago are forgotten, and
  /// their contacts are numbered as this service counts them.
  static constexpr std::size_t kPairsMax = 32768;

  /// Contacts that the other service has not published yet; beyond, the oldest are given up.
  static constexpr std::size_t kUntoldMax = 32768;

  /// Contacts that are told once more after a take-over; of more the oldest are not.
  static constexpr std::size_t kRepeatedMax = 1024;

  /// This service is in this epoch now. Epochs of all services of a world are numbered alike.
  void BeginEpoch(std::uint32_t epoch);

  /// The service in force has published this. Nothing if that was in an earlier epoch.
  void Hear(const v1::CollisionEvent& event);

  /// This service, standing by, would publish this contact.
  void Keep(const detection::CollisionEvent& contact, const PairLabels& labels = {});

  /// Contacts that are over before this and were never certain are dropped from now on, and those
  /// that are kept: a service that did not miss any state has not found them.
  void DropUndecided(Instant before);

  /// It takes over: the contacts that have not been published, in their order.
  std::vector<UntoldContact> TakeUntold();

  /// Before that: the newest that have, as the other service told them. It may have ended before
  /// all readers had them; those that know them pass over them.
  std::vector<v1::CollisionEvent> TakeTold();

  /// The number of the event's contact for readers.
  std::uint32_t NumberOf(const detection::CollisionEvent& event);

 private:
  using Event = detection::CollisionEvent;
  using Pair = std::pair<detection::AgentId, detection::AgentId>;

  /// What was heard of a pair.
  struct Heard {
    std::uint32_t number = 0;  ///< The highest, of a contact or a forecast.
    bool is_open = false;      ///< That is a forecast without an outcome.
    /// No contact before this that readers have not been told of.
    std::int64_t free_until_ns = Instant::Always().nanoseconds();
    v1::CollisionEvent contact;     ///< The last one; empty: none.
    std::uint32_t ours = 0;         ///< After a take-over: of our number,
    std::uint32_t for_readers = 0;  ///< and this is theirs.
  };

  using Untold = std::list<UntoldContact>;

  bool IsTold(const Event& contact);
  void DropTold(const Pair& pair);
  template <typename Predicate>
  void Drop(std::deque<Untold::iterator>* contacts, const Predicate& is_dropped);
  void DropOldest();

  std::uint32_t epoch_ = 1;                     ///< Of what was heard.
  Instant decided_before_ = Instant::Always();  ///< By the other service: DropUndecided().
  RecentMap<Pair, Heard> pairs_{kPairsMax};
  std::deque<v1::CollisionEvent> told_;
  Untold untold_;
  std::map<Pair, std::deque<Untold::iterator>> untold_of_;  ///< Of each pair, in the same order.
};

}  // namespace collision::server
