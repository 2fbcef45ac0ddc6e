// Which forecast a sample of another pair has ended.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "client/library/network/conversion.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Lower and higher agent, level, number of the contact: which contact an event is about.
using EventKey = std::tuple<AgentId, AgentId, std::string, std::uint32_t>;

inline EventKey KeyOf(const v1::CollisionEvent& event) {
  return {FromMessage(event.lower()), FromMessage(event.higher()), event.level(), event.contact()};
}

/// A pair slot has one forecast at a time: the sample that ends it may be overwritten by that of
/// the next pair in the slot, which a reader then hears in its place (idl/PROTOCOL.md). One thread.
class ForecastSlots {
 public:
  /// Takes events in the order of their publication. Returns the one whose forecast this one ends
  /// without a word about it.
  std::optional<EventKey> Take(const v1::CollisionEvent& event) {
    if (event.contacts_sequence() > 0) return std::nullopt;
    EventKey key = KeyOf(event);
    const auto [place, is_new] =
        slots_.try_emplace({event.stamp().service_id(), event.pair_slot()}, key);
    if (is_new || place->second == key) return std::nullopt;
    return std::exchange(place->second, std::move(key));
  }

 private:
  std::map<std::pair<std::uint64_t, std::uint32_t>, EventKey> slots_;  ///< By service and slot.
};

}  // namespace collision::client
