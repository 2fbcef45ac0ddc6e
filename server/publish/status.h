// What the service publishes about itself.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/intake/intake.h"
#include "server/publish/measurements.h"
#include "server/publish/publisher.h"
#include "server/shapes/shape_store.h"
#include "server/world/rejections.h"
#include "server/world/world.h"

namespace collision::server {

/// Steps of the daemon, and their inputs.
struct StepCounters {
  std::uint64_t batches = 0;
  std::uint64_t inputs = 0;
  std::uint64_t clock_steps = 0;     ///< How often the wall clock was set.
  std::string last_clock_step = {};  ///< In words; empty: never.
};

/// How far the wall clock was set, to what, and what that means.
std::string StepText(const ClockStep& step);

/// Everything that a status is made of; all of it outlives the call.
struct StatusSources {
  const v1::Config& config;
  const World& world;
  const Detectors& detectors;
  const Intake& intake;
  const ShapeStore& shapes;
  const Rejections& rejections;
  const Publisher& publisher;
  const Bus& bus;
  const StepCounters& steps;
  const Measurements& measurements;
  std::uint64_t queries_per_second = 0;       ///< Of the detector, since the last status.
  std::uint64_t configuration = 0;            ///< ConfigurationDigest().
  std::vector<v1::KeyValue> extensions = {};  ///< Further ones.
};

/// Adds an extension, unless its text is empty; what is too long is cut off.
void AddText(const std::string& key, const std::string& text,
             std::vector<v1::KeyValue>* extensions);

/// Without service id and stamp. Texts are cut to the bounds of collision.idl.
v1::ServiceStatus MakeStatus(const StatusSources& sources);

/// The rate at which a counter grows.
class Rate {
 public:
  /// Per second since the last call, rounded to the nearest; 0 at the first, and if no time has
  /// passed.
  std::uint64_t Take(std::uint64_t count, std::int64_t monotonic_ns);

 private:
  bool taken_ = false;
  std::uint64_t count_ = 0;
  std::int64_t at_ns_ = 0;
};

/// Says when the next status is due: after every period, and at once when a simulator has come,
/// gone, been released or begun a new run.
class StatusSchedule {
 public:
  explicit StatusSchedule(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// True if a status is to be published at this step; it then counts as published.
  bool Take(const World& world);

  /// The next one is due at once.
  void Hasten() { next_ns_ = std::numeric_limits<std::int64_t>::min(); }

  /// The monotonic time at which the next one is due.
  std::int64_t next_ns() const { return next_ns_; }

 private:
  const std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
  std::vector<std::uint64_t> presence_;
};

}  // namespace collision::server
