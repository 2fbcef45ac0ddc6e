// Which events are new to a reader of contacts and forecasts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>

#include "client/library/network/contact_sequence.h"
#include "collision_core/base/recent_map.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Possible, dismissed or withdrawn.
bool IsForecast(v1::EventStatus status);

/// Makes one stream of the two topics: each revision once, no forecast after a later revision of
/// its pair, every contact. Each level has contacts and forecasts of its own. A service counts
/// revisions from 1 for each contact. One that takes over goes on with the contacts of the one
/// before it and tells once more what stands: of the same contact the same status and begin, a
/// forecast that does not begin earlier. In another epoch it counts all anew; one that was started
/// again may count epochs anew, too.
class RevisionFilter {
 public:
  /// Pairs that are remembered; beyond twice as many those heard of longest ago are forgotten, and
  /// a late repetition of a forecast about them counts as new.
  static constexpr std::size_t kPairsMax = 65536;

  /// False: it is a contact that has come before; a forecast that was overtaken by a later revision
  /// of the same pair; the copy among the forecasts that says that a pair has become a contact,
  /// which the contact itself says; or the repetition by another service of what is known.
  bool IsNew(const v1::CollisionEvent& event, ContactSequence* contacts);

  /// Of a topic that has no sequence of contacts, as that of hypothetical agents: each event counts
  /// like a forecast. False: it was overtaken, or repeats what is known.
  bool IsNewest(const v1::CollisionEvent& event) { return Take(event, false); }

  /// Contacts that a service which took over has told once more.
  std::uint64_t contacts_repeated() const { return contacts_repeated_; }

 private:
  using Agent = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  using Pair = std::tuple<Agent, Agent, std::string>;  ///< The last: the level.

  /// What an event says, as far as it is compared.
  struct Revision {
    std::uint64_t service = 0;
    std::uint32_t contact = 0;  ///< 0: none.
    std::uint32_t revision = 0;
    v1::EventStatus status{};
    std::int64_t begin_earliest_ns = 0, begin_latest_ns = 0;
  };

  /// Of a pair.
  struct Known {
    Revision newest;
    Revision last_contact;  ///< No forecast.
  };

  static Agent Id(const v1::AgentId& id);
  static bool IsOutdated(const v1::CollisionEvent& event, const Known& known);
  static bool IsRepeated(const v1::CollisionEvent& event, bool is_contact, const Known& known);
  bool Take(const v1::CollisionEvent& event, bool is_contact);
  bool IsPast(const v1::ServiceStamp& stamp);

  std::uint64_t contacts_repeated_ = 0;
  std::uint64_t service_ = 0;  ///< Of the newest event ...
  std::uint32_t epoch_ = 0;    ///< ... and its epoch.
  RecentMap<Pair, Known> known_{kPairsMax};
};

}  // namespace collision::client
