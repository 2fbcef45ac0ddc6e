// What is told of hypothetical agents, to their owners alone.
#pragma once

#include <optional>
#include <vector>

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
  explicit ScreeningEvents(const v1::Config& config) : filter_(config) {}

  /// What to tell after the events of a step, in this order, without stamps. `time_ns` grows with
  /// the time by which the rate counts.
  [[nodiscard]] std::vector<v1::ScreeningEvent> Take(
      const std::vector<detection::CollisionEvent>& events, const World& world,
      std::int64_t time_ns);

  /// What stands told and is not over, for a service that has taken over.
  [[nodiscard]] std::vector<v1::ScreeningEvent> Standing(const World& world) const;

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
};

}  // namespace collision::server
