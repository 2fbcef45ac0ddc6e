// Everything that the service publishes, stamped and handed to the bus.
#pragma once

#include <optional>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/claim/service_claim.h"
#include "server/publish/event_log.h"
#include "server/publish/state_demand.h"
#include "server/world/world.h"

namespace collision::server {

/// Every sample carries (service, term, sequence); the sequence counts all samples. One thread.
class Publisher {
 public:
  /// `claim`: who publishes. It and the bus outlive the publisher.
  Publisher(const v1::Config& config, const ServiceClaim* claim, Bus* bus);

  /// Publishes the chunks that are marked as changed, each complete, and takes the marks. Chunk 0,
  /// which carries the grant, comes last: a simulator that waits for its grant in it then has the
  /// others. A simulator that has been granted nothing yet keeps its marks.
  void PublishClearances(World* world);

  /// In this order. They leave before the clearances of the same step, so that a simulator that is
  /// granted time has been told what it may meet.
  /// `ended`: events of agents that the service removed say so.
  void PublishEvents(const std::vector<detection::CollisionEvent>& events,
                     const EndedRuns& ended = {});

  /// Publishes the answer if it differs from the last one published.
  void PublishEarliest(const detection::EarliestAnswer& answer, Instant now);

  void PublishRejections(std::vector<v1::Rejection> rejections);

  void PublishStatus(v1::ServiceStatus status);

  /// What is published from here on belongs to this epoch.
  void BeginEpoch(std::uint32_t epoch);

  /// The events as published, without the stamp, which differs between instances of the service.
  const EventLog& event_log() const { return event_log_; }

 private:
  v1::ServiceStamp NextStamp();
  void PublishChunk(const World& world, const Simulator& simulator, std::uint32_t chunk);

  const ServiceClaim& claim_;
  const StateDemand demand_;
  Bus& bus_;
  std::uint32_t epoch_ = 1;
  std::uint64_t sequence_ = 0;
  EventLog event_log_;
  std::optional<v1::EarliestIntersection> earliest_;
};

}  // namespace collision::server
