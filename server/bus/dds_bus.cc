#include "server/bus/dds_bus.h"

namespace collision::server {
namespace {

DdsSessionOptions Options(const std::string& world, std::uint32_t domain,
                          std::chrono::nanoseconds lease) {
  DdsSessionOptions options;
  options.world = world;
  options.domain = domain;
  options.role = DdsRole::kService;
  options.lease = lease;
  return options;
}

v1::Counter CounterOf(const std::string& name, std::uint64_t value) {
  v1::Counter counter;
  counter.set_name(name);
  counter.set_value(value);
  return counter;
}

}  // namespace

DdsBus::DdsBus(const std::string& world, std::uint32_t domain, std::chrono::nanoseconds lease)
    : session_(Options(world, domain, lease)) {}

bool DdsBus::Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                     std::vector<v1::Input>* inputs) {
  session_.Receive(timeout, limit, inputs, nullptr);
  return true;
}

void DdsBus::Publish(const v1::Output& output) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      return session_.Write(output.clearance());
    case v1::Output::kEarliestIntersection:
      return session_.Write(output.earliest_intersection());
    case v1::Output::kCollisionEvent:
      return session_.Write(output.collision_event());
    case v1::Output::kRejection:
      return session_.Write(output.rejection());
    case v1::Output::kServiceStatus:
      return session_.Write(output.service_status());
    case v1::Output::kSimulatorReport:
      return session_.Write(output.simulator_report());
    case v1::Output::MESSAGE_NOT_SET:
      return;
  }
}

void DdsBus::Flush() { session_.Flush(); }

void DdsBus::Wake() { session_.Wake(); }

std::uint32_t DdsBus::earliest_readers() const { return session_.earliest_readers(); }

std::vector<v1::Counter> DdsBus::network_counters() const {
  const DdsCounters counted = counters();
  return {CounterOf("dds_samples_lost", counted.samples_lost),
          CounterOf("dds_samples_refused", counted.samples_refused),
          CounterOf("dds_samples_orphaned", counted.samples_orphaned),
          CounterOf("dds_writes_failed", counted.writes_failed)};
}

DdsCounters DdsBus::counters() const { return session_.counters(); }

}  // namespace collision::server
