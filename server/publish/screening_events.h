// What is told of hypothetical agents, to their owners alone.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/base/recent_map.h"
#include "idl/config.pb.h"
#include "server/publish/event_filter.h"
#include "server/publish/event_log.h"
#include "server/publish/identity/event_labels.h"
#include "server/world/world.h"

namespace collision::server {

/// Makes the messages about the events of a ScreeningDetector. They are told at the rate of
/// forecasts (EventFilter), of each pair on one instance: what is possible, what would be a contact
/// and how it ends. They are no part of the history of contacts: nothing counts them there, and
/// they have a log of their own. One thread.
class ScreeningEvents {
 public:
  /// Pairs whose last message is kept while this service does not speak; beyond twice as many those
  /// heard of longest ago are forgotten.
  static constexpr std::size_t kUntoldPairsMax = 1024;

  explicit ScreeningEvents(const v1::Config& config) : filter_(config) {}

  /// What to tell after the events of a step, in this order, without stamps. `time_ns` grows with
  /// the time by which the rate counts.
  [[nodiscard]] std::vector<v1::ScreeningEvent> Take(
      const std::vector<detection::CollisionEvent>& events, const World& world,
      std::int64_t time_ns);

  /// This service does not speak: what Take() has returned stays untold.
  void Keep(std::vector<v1::ScreeningEvent> untold);

  /// For a service that has taken over: the ends that it has kept, and what stands told and is not
  /// over. The service before it may have told them; owners know which they have heard.
  [[nodiscard]] std::vector<v1::ScreeningEvent> TakeInherited(const World& world);

  /// The detector and its time begin anew.
  void Forget();

  /// All revisions, as Publisher::event_log() has those of real agents.
  const EventLog& log() const { return log_; }

 private:
  /// nullopt: the run of its owner is over.
  std::optional<v1::ScreeningEvent> MessageOf(const detection::CollisionEvent& event,
                                              const World& world) const;

  EventFilter filter_;
  EventLabels labels_;
  EventLog log_;
  RecentMap<std::pair<detection::AgentId, detection::AgentId>, v1::ScreeningEvent> untold_{
      kUntoldPairsMax};
};

}  // namespace collision::server
