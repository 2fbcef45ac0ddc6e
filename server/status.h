// What the service says about itself.
#pragma once

#include "collision_core/detection/detector.h"
#include "idl/config.pb.h"
#include "server/event_log.h"
#include "server/intake.h"
#include "server/rejections.h"
#include "server/shape_store.h"
#include "server/world.h"

namespace collision::server {

/// Steps of the daemon and what went through them.
struct StepCounters {
  std::uint64_t batches = 0;
  std::uint64_t inputs = 0;
};

/// Everything a status is made of; all of it outlives the call.
struct StatusSources {
  const v1::Config& config;
  const World& world;
  const Detector& detector;
  const Intake& intake;
  const ShapeStore& shapes;
  const Rejections& rejections;
  const EventLog& event_log;
  StepCounters steps;
  std::vector<v1::Counter> network;  ///< Bus::network_counters().
};

/// Without service id and stamp. Texts are cut to the bounds of collision.idl.
v1::ServiceStatus MakeStatus(const StatusSources& sources);

/// Says when the next status is due: after every period, and at once when something important has
/// changed: who is there, who is alive, which run.
class StatusSchedule {
 public:
  explicit StatusSchedule(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// True if a status is to be published at this step; it then counts as published.
  bool Take(const World& world);

  /// The monotonic time at which the next one is due.
  std::int64_t next_ns() const { return next_ns_; }

 private:
  const std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
  std::vector<std::uint64_t> presence_;
};

}  // namespace collision::server
