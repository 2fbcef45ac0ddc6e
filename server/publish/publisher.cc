#include "server/publish/publisher.h"

#include <algorithm>
#include <set>
#include <utility>

#include "collision_core/numeric/seconds.h"
#include "idl/limits.h"
#include "server/codec/encode.h"
#include "server/codec/hello.h"
#include "server/process/version.h"
#include "server/publish/because.h"

namespace collision::server {
namespace {

v1::ServicePhase PhaseOf(const ServiceClaim& claim) {
  switch (claim.phase()) {
    case ClaimPhase::kServing:
      return v1::PHASE_SERVING;
    case ClaimPhase::kStandby:
      return v1::PHASE_STANDBY;
    default:
      return v1::PHASE_CLAIMING;
  }
}

/// What stands until it is acknowledged, in place of what the detector told once.
void Set(const Lowering& lowering, v1::AgentClearance* wire) {
  wire->set_lowerings(lowering.count);
  wire->set_cause(static_cast<v1::ClearanceCause>(lowering.cause));
  *wire->mutable_cause_agent() = Encode(lowering.cause_agent);
  wire->set_void_from_ns(lowering.void_from.nanoseconds());
}

/// Events of agents that the service removed say so.
v1::CollisionEvent Encode(const detection::CollisionEvent& event, const EndedRuns& ended) {
  v1::CollisionEvent wire = server::Encode(event);
  AddBecause(ended, &wire);
  return wire;
}

}  // namespace

Publisher::Publisher(const v1::Config& config, const ServiceClaim* claim, Bus* bus)
    : claim_(*claim),
      demand_(config),
      hello_(HelloOf(config)),
      bus_(*bus),
      filter_(config),
      earliest_period_ns_(ToNanoseconds(config.earliest_period_s())),
      resolution_s_(config.temporal_resolution_s()) {}

v1::ServiceStamp Publisher::NextStamp() {
  v1::ServiceStamp stamp;
  stamp.set_service_id(claim_.instance());
  stamp.set_term(claim_.term());
  stamp.set_epoch(epoch_);
  stamp.set_sequence(++sequence_);
  return stamp;
}

void Publisher::PublishClearances(World* world) {
  const std::int64_t wait_ns = world->simulated() ? 0 : ToNanoseconds(kRisesWait * resolution_s_);
  const Instant soon = numeric::AddRoundedUp(world->now(), (kRisesWait + 1) * resolution_s_);
  for (auto& [id, simulator] : world->simulators()) {
    // Before time begins only who asked for it is told.
    if (world->simulated() && !simulator.time().granted()) continue;
    // Chunk 0 last: a simulator that waits for the grant in it then has all the others.
    const std::set<std::uint32_t> chunks =
        simulator.agents().clearances().TakeChanged(world->monotonic_ns(), wait_ns, soon);
    for (auto chunk = chunks.rbegin(); chunk != chunks.rend(); ++chunk) {
      PublishChunk(*world, &simulator, *chunk);
    }
  }
}

void Publisher::PublishChunk(const World& world, Simulator* to, std::uint32_t chunk) {
  const Simulator& simulator = *to;
  v1::Output output;
  v1::Clearance& clearance = *output.mutable_clearance();
  clearance.set_simulator_id(simulator.id());
  clearance.set_chunk(chunk);
  clearance.set_run(simulator.run());
  clearance.set_incarnation(simulator.incarnation());
  *clearance.mutable_stamp() = NextStamp();
  clearance.set_now_ns(world.now().nanoseconds());
  clearance.set_granted_until_ns(
      simulator.time().granted().value_or(Instant::Never()).nanoseconds());
  to->agents().clearances().Publish(chunk, clearance.stamp().sequence(), world.monotonic_ns());
  const Lowerings& lowerings = simulator.agents().clearances().lowerings();
  clearance.set_contacts_sequence(events_.contacts);
  clearance.set_forecasts_sequence(newest_forecast_);
  const auto& clearances = simulator.agents().clearances().all();
  const auto end = clearances.lower_bound((chunk + 1) * kSlotsPerChunk);
  for (auto next = clearances.lower_bound(chunk * kSlotsPerChunk); next != end; ++next) {
    const Agent& agent = *simulator.agents().Find(next->first);
    const Instant wanted = demand_.WantedAt(next->second, agent.stamp(), world.now());
    v1::AgentClearance& wire = *clearance.add_agents() =
        Encode(next->second, agent.acknowledged_sequence(), agent.acknowledged_revision(), wanted);
    wire.set_effective_from_ns(
        std::max({next->second.effective_from, agent.acknowledged_from(), world.promised_from()})
            .nanoseconds());
    Set(lowerings.Of(next->first), &wire);
  }
  bus_.Publish(output);
}

std::vector<Telling> Publisher::Filter(const std::vector<detection::CollisionEvent>& events,
                                       const World& world) {
  for (const detection::CollisionEvent& event : events) {
    event_log_.Add(Encode(event, world.ended_runs()));
    labels_.Note(event, world);
  }
  // By the world's time where that is simulated, so that a run at any speed tells the same.
  const std::int64_t time_ns = world.simulated() ? world.now().nanoseconds() : world.monotonic_ns();
  return filter_.Take(events, world.now(), time_ns);
}

void Publisher::PublishEvents(const std::vector<detection::CollisionEvent>& events,
                              const World& world) {
  for (const Telling& telling : Filter(events, world)) {
    if (claim_.speaks()) {
      Publish(telling, world);
    } else if (telling.contact) {
      inherited_.Keep(telling.event, labels_.Of(telling.event));
    }
  }
  if (claim_.speaks() && !world.simulated()) bus_.Flush();
}

void Publisher::Hear(const v1::Input& input) {
  if (!claim_.speaks() && input.has_event_heard()) inherited_.Hear(input.event_heard());
}

void Publisher::PublishInherited(const World& world) {
  for (auto& [epoch, contact] : std::exchange(unheard_, {})) {
    PublishContact(std::move(contact), epoch);
  }
  std::set<std::pair<detection::AgentId, detection::AgentId>> told;
  for (v1::CollisionEvent& contact : inherited_.TakeTold()) {
    told.insert({IdOf(contact.lower()), IdOf(contact.higher())});
    PublishContact(std::move(contact), epoch_);
  }
  for (const UntoldContact& contact : inherited_.TakeUntold()) {
    told.insert({contact.event.lower, contact.event.higher});
    PublishContact(ForReaders(contact.event, contact.labels, world), epoch_);
  }
  for (const Telling& telling : filter_.Standing()) {
    const detection::CollisionEvent& event = telling.event;
    if (!telling.contact || !told.contains({event.lower, event.higher})) Publish(telling, world);
  }
}

v1::CollisionEvent Publisher::ForReaders(const detection::CollisionEvent& event,
                                         const PairLabels& labels, const World& world) {
  v1::CollisionEvent wire = Encode(event, world.ended_runs());
  AddLabels(labels, &wire);
  wire.set_contact(inherited_.NumberOf(event));
  return wire;
}

void Publisher::Publish(const Telling& telling, const World& world) {
  v1::CollisionEvent event = ForReaders(telling.event, labels_.Of(telling.event), world);
  if (telling.contact) return PublishContact(std::move(event), epoch_);
  ++events_.forecasts;
  *event.mutable_stamp() = NextStamp();
  newest_forecast_ = event.stamp().sequence();
  v1::Output output;
  *output.mutable_collision_event() = std::move(event);
  bus_.Publish(output);
}

void Publisher::PublishContact(v1::CollisionEvent event, std::uint32_t epoch) {
  // One instance holds the history of all contacts.
  event.set_pair_slot(0);
  event.set_contacts_sequence(++events_.contacts);
  *event.mutable_stamp() = NextStamp();
  event.mutable_stamp()->set_epoch(epoch);
  v1::Output output;
  *output.mutable_collision_event() = std::move(event);
  bus_.Publish(output);
}

EventCounters Publisher::event_counters() const {
  EventCounters counters = events_;
  counters.forecasts_withheld = filter_.withheld();
  return counters;
}

bool Publisher::EarliestIsDue(const World& world) {
  const std::uint32_t readers = bus_.earliest_readers();
  // A reader that joins has the last sample, which may be old if nobody read it meanwhile.
  if (readers > earliest_readers_) earliest_.reset();
  earliest_readers_ = readers;
  if (readers == 0) return false;
  return !earliest_ || world.now().nanoseconds() - earliest_now_ns_ >= earliest_period_ns_ ||
         world.monotonic_ns() - earliest_monotonic_ns_ >= earliest_period_ns_;
}

void Publisher::PublishEarliest(const detection::EarliestAnswer& answer, const World& world) {
  v1::EarliestIntersection wire = Encode(answer);
  earliest_now_ns_ = world.now().nanoseconds();
  earliest_monotonic_ns_ = world.monotonic_ns();
  if (earliest_ && earliest_->SerializeAsString() == wire.SerializeAsString()) return;
  earliest_ = wire;
  wire.set_service_id(claim_.instance());
  wire.set_now_ns(earliest_now_ns_);
  *wire.mutable_stamp() = NextStamp();
  v1::Output output;
  *output.mutable_earliest_intersection() = std::move(wire);
  bus_.Publish(output);
}

void Publisher::PublishRejections(std::vector<v1::Rejection> rejections) {
  if (!claim_.speaks()) return;
  for (v1::Rejection& rejection : rejections) {
    v1::Output output;
    *output.mutable_rejection() = std::move(rejection);
    *output.mutable_rejection()->mutable_stamp() = NextStamp();
    bus_.Publish(output);
  }
}

void Publisher::PublishReports(std::vector<v1::SimulatorReport> reports) {
  for (v1::SimulatorReport& report : reports) {
    v1::Output output;
    *output.mutable_simulator_report() = std::move(report);
    *output.mutable_simulator_report()->mutable_stamp() = NextStamp();
    bus_.Publish(output);
  }
}

void Publisher::PublishBreaches(std::vector<v1::AgentBreach> breaches) {
  if (!claim_.speaks()) return;
  for (v1::AgentBreach& breach : breaches) {
    v1::Output output;
    *output.mutable_agent_breach() = std::move(breach);
    *output.mutable_agent_breach()->mutable_stamp() = NextStamp();
    bus_.Publish(output);
  }
}

void Publisher::BeginEpoch(std::uint32_t epoch, const World& world) {
  if (!claim_.speaks()) {
    for (v1::CollisionEvent& contact : inherited_.TakeTold()) {
      unheard_.emplace_back(epoch_, std::move(contact));
    }
    for (const UntoldContact& contact : inherited_.TakeUntold()) {
      unheard_.emplace_back(epoch_, ForReaders(contact.event, contact.labels, world));
    }
    while (unheard_.size() > InheritedEvents::kUntoldMax) unheard_.pop_front();
  }
  epoch_ = epoch;
  earliest_.reset();
  filter_.Forget();
  labels_.Forget();
  inherited_.BeginEpoch(epoch);
}

void Publisher::ForgetBefore(std::uint32_t epoch) {
  std::erase_if(unheard_, [epoch](const auto& contact) { return contact.first < epoch; });
}

void Publisher::PublishHello() {
  const bool is_known = hello_.service_id() == claim_.instance() &&
                        hello_.term() == claim_.term() && hello_.epoch() == epoch_;
  if (is_known) return;
  hello_.set_service_id(claim_.instance());
  hello_.set_term(claim_.term());
  hello_.set_epoch(epoch_);
  hello_.set_version(std::string(Version()).substr(0, wire::kLabelMax));
  v1::Output output;
  *output.mutable_service_hello() = hello_;
  bus_.Publish(output);
}

void Publisher::PublishStatus(v1::ServiceStatus status) {
  v1::Output output;
  status.set_service_id(claim_.instance());
  status.set_phase(PhaseOf(claim_));
  *status.mutable_stamp() = NextStamp();
  *output.mutable_service_status() = std::move(status);
  bus_.Publish(output);
}

}  // namespace collision::server
