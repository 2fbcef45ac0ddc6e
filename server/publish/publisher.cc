#include "server/publish/publisher.h"

#include <set>
#include <utility>

#include "server/codec/encode.h"
#include "server/publish/because.h"

namespace collision::server {

Publisher::Publisher(const v1::Config& config, const ServiceClaim* claim, Bus* bus)
    : claim_(*claim), demand_(config), bus_(*bus) {}

v1::ServiceStamp Publisher::NextStamp() {
  v1::ServiceStamp stamp;
  stamp.set_service_id(claim_.instance());
  stamp.set_term(claim_.term());
  stamp.set_epoch(epoch_);
  stamp.set_sequence(++sequence_);
  return stamp;
}

void Publisher::PublishClearances(World* world) {
  if (!world->started()) return;
  for (auto& [id, simulator] : world->simulators()) {
    if (world->simulated() && !simulator.time().granted()) continue;
    // Chunk 0 last: a simulator that waits for the grant in it then has all the others.
    const std::set<std::uint32_t> chunks = simulator.agents().clearances().TakeChanged();
    for (auto chunk = chunks.rbegin(); chunk != chunks.rend(); ++chunk) {
      PublishChunk(*world, simulator, *chunk);
    }
  }
}

void Publisher::PublishChunk(const World& world, const Simulator& simulator, std::uint32_t chunk) {
  v1::Output output;
  v1::Clearance& clearance = *output.mutable_clearance();
  clearance.set_simulator_id(simulator.id());
  clearance.set_chunk(chunk);
  clearance.set_run(simulator.run());
  *clearance.mutable_stamp() = NextStamp();
  clearance.set_now_ns(world.now().nanoseconds());
  clearance.set_granted_until_ns(
      simulator.time().granted().value_or(Instant::Never()).nanoseconds());
  const auto& clearances = simulator.agents().clearances().all();
  const auto end = clearances.lower_bound((chunk + 1) * kSlotsPerChunk);
  for (auto next = clearances.lower_bound(chunk * kSlotsPerChunk); next != end; ++next) {
    const Agent& agent = *simulator.agents().Find(next->first);
    const Instant wanted = demand_.WantedAt(next->second, agent.stamp(), world.now());
    *clearance.add_agents() =
        Encode(next->second, agent.acknowledged_sequence(), agent.revision(), wanted);
  }
  bus_.Publish(output);
}

void Publisher::PublishEvents(const std::vector<detection::CollisionEvent>& events,
                              const EndedRuns& ended) {
  for (const detection::CollisionEvent& event : events) {
    v1::Output output;
    *output.mutable_collision_event() = Encode(event);
    AddBecause(ended, output.mutable_collision_event());
    event_log_.Add(output.collision_event());
    *output.mutable_collision_event()->mutable_stamp() = NextStamp();
    bus_.Publish(output);
  }
}

void Publisher::PublishEarliest(const detection::EarliestAnswer& answer, Instant now) {
  v1::EarliestIntersection wire = Encode(answer);
  if (earliest_ && earliest_->SerializeAsString() == wire.SerializeAsString()) return;
  earliest_ = wire;
  wire.set_service_id(claim_.instance());
  wire.set_now_ns(now.nanoseconds());
  *wire.mutable_stamp() = NextStamp();
  v1::Output output;
  *output.mutable_earliest_intersection() = std::move(wire);
  bus_.Publish(output);
}

void Publisher::PublishRejections(std::vector<v1::Rejection> rejections) {
  for (v1::Rejection& rejection : rejections) {
    v1::Output output;
    *output.mutable_rejection() = std::move(rejection);
    *output.mutable_rejection()->mutable_stamp() = NextStamp();
    bus_.Publish(output);
  }
}

void Publisher::BeginEpoch(std::uint32_t epoch) {
  epoch_ = epoch;
  earliest_.reset();
}

void Publisher::PublishStatus(v1::ServiceStatus status) {
  v1::Output output;
  status.set_service_id(claim_.instance());
  status.set_phase(claim_.phase() == ClaimPhase::kServing ? v1::PHASE_SERVING : v1::PHASE_CLAIMING);
  *status.mutable_stamp() = NextStamp();
  *output.mutable_service_status() = std::move(status);
  bus_.Publish(output);
}

}  // namespace collision::server
