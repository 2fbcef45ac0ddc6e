// Which events of hypothetical agents are new to their owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "client/library/network/conversion.h"
#include "collision_core/base/recent_map.h"

namespace collision::client {

/// Of each pair only what is newer than what came before: a service counts contacts, and the
/// revisions of each, from 1, in another epoch anew. One that takes over tells once more what
/// stands and what is over: of the same contact the same status, and no earlier begin. From then on
/// its revisions count. One thread; depends on nothing but the calls.
class ScreeningFilter {
 public:
  /// Pairs that are remembered; beyond twice as many those heard of longest ago are forgotten, and
  /// a repetition about them counts as new.
  static constexpr std::size_t kPairsMax = 4096;

  bool IsNew(const v1::CollisionEvent& event) {
    const std::pair key(FromMessage(event.lower()), FromMessage(event.higher()));
    const Told next{event.stamp().service_id(), event.stamp().epoch(), event.contact(),
                    event.revision(),           event.status(),        event.begin().earliest_ns()};
    const Told* told = told_.Find(key);
    if (told != nullptr && IsOutdated(next, *told)) return false;
    const bool is_repeated = told != nullptr && IsRepeated(next, *told);
    told_.Touch(key) = next;
    return !is_repeated;
  }

 private:
  struct Told {
    std::uint64_t service = 0;
    std::uint32_t epoch = 0, contact = 0, revision = 0;
    v1::EventStatus status{};
    std::int64_t begin_earliest_ns = 0;
  };

  static bool IsOutdated(const Told& next, const Told& told) {
    return next.service == told.service && next.epoch == told.epoch &&
           std::pair(next.contact, next.revision) <= std::pair(told.contact, told.revision);
  }

  static bool IsRepeated(const Told& next, const Told& told) {
    return next.service != told.service && next.epoch == told.epoch &&
           next.contact == told.contact && next.status == told.status &&
           next.begin_earliest_ns >= told.begin_earliest_ns;
  }

  RecentMap<std::pair<AgentId, AgentId>, Told> told_{kPairsMax};
};

}  // namespace collision::client
