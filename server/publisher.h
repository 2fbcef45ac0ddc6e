// Everything the service says, stamped and handed to the bus.
#pragma once

#include <optional>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus.h"
#include "server/event_log.h"
#include "server/state_demand.h"
#include "server/world.h"

namespace collision::server {

/// Every sample carries (service, term, sequence), the sequence counting all samples. One thread.
class Publisher {
 public:
  /// The bus outlives the publisher.
  Publisher(const v1::Config& config, Bus* bus);

  /// The chunks marked as changed, each complete, chunk 0 last. Simulators without a place in time yet keep their
  /// marks.
  void PublishClearances(World* world);

  void PublishEvents(const std::vector<detection::CollisionEvent>& events);

  /// Only if it differs from the last one published.
  void PublishEarliest(const detection::EarliestAnswer& answer, Instant now);

  void PublishRejections(std::vector<v1::Rejection> rejections);

  void PublishStatus(v1::ServiceStatus status);

  /// The events as published but for the stamp, which differs between instances of the service.
  const EventLog& event_log() const { return event_log_; }

 private:
  v1::ServiceStamp NextStamp();
  void PublishChunk(const World& world, const Simulator& simulator, std::uint32_t chunk);

  const std::uint64_t service_id_;
  const std::uint32_t term_;
  const StateDemand demand_;
  Bus& bus_;
  std::uint64_t sequence_ = 0;
  EventLog event_log_;
  std::optional<v1::EarliestIntersection> earliest_;
};

}  // namespace collision::server
