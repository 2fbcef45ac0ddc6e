// What the agents of events are called.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "collision_core/detection/events/collision_event.h"
#include "idl/messages.pb.h"
#include "server/world/world.h"

namespace collision::server {

/// Of the agents of a pair; null: not known.
struct PairLabels {
  std::shared_ptr<const v1::AgentLabel> lower, higher;
};

void AddLabels(const PairLabels& labels, v1::CollisionEvent* event);

/// Holds the labels of both agents of each pair that has an event, from its first revision on, so
/// that later ones have them also when an agent has left meanwhile. A pair slot keeps its labels
/// until it is used for another pair: at most one entry for each of the detector's pair slots. One
/// thread.
class EventLabels {
 public:
  /// A revision that may be told, now or later: its agents are called as the world knows them now,
  /// or else as before.
  void Note(const detection::CollisionEvent& event, const World& world);

  /// Of the pair of this event; both null after another pair has taken the slot.
  PairLabels Of(const detection::CollisionEvent& event) const;

  /// The detector begins anew.
  void Forget() { pairs_.clear(); }

 private:
  struct Pair {
    detection::AgentId lower, higher;
    PairLabels labels;
  };

  std::map<std::uint32_t, Pair> pairs_;  ///< By slot.
};

}  // namespace collision::server
