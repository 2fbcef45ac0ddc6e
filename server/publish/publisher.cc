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

/// By which rates count: the world's time where that is simulated, so that a run at any speed tells
/// the same.
std::int64_t RateTime(const World& world) {
  return world.simulated() ? world.now().nanoseconds() : world.monotonic_ns();
}

/// What stands until it is acknowledged, in place of what the detector told once.
void Set(const Lowering& lowering, v1::AgentClearance* wire) {
  wire->set_lowerings(lowering.count);
  wire->set_cause(static_cast<v1::ClearanceCause>(lowering.cause));
  *wire->mutable_cause_agent() = Encode(lowering.cause_agent);
  wire->set_void_from_ns(lowering.void_from.nanoseconds());
}

}  // namespace

Publisher::Publisher(const v1::Config& config, const ServiceClaim* claim, Bus* bus,
                     ContactObserver* observer)
    : claim_(*claim),
      hello_(HelloOf(config)),
      bus_(*bus),
      observer_(observer),
      screening_(config),
      earliest_period_ns_(ToNanoseconds(config.earliest_period_s())),
      resolution_s_(config.temporal_resolution_s()) {
  streams_.reserve(1 + config.levels_size());
  const auto add = [&](const std::string& level, double announce_within) {
    streams_.push_back({.level = level,
                        .index = static_cast<std::uint32_t>(streams_.size()),
                        .demand = StateDemand(config, announce_within),
                        .filter = EventFilter(config)});
  };
  add("", config.announce_within_s());
  for (const Level& level : LevelsOf(config)) add(level.name, level.look_ahead);
}

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
  clearance.set_screening_sequence(simulator.screening_sequence());
  const auto& clearances = simulator.agents().clearances().all();
  const auto end = clearances.lower_bound((chunk + 1) * kSlotsPerChunk);
  for (auto next = clearances.lower_bound(chunk * kSlotsPerChunk); next != end; ++next) {
    const Agent& agent = *simulator.agents().Find(next->first);
    const Instant wanted =
        WantedAt(simulator.agents().clearances(), next->first, agent.stamp(), world.now());
    v1::AgentClearance& wire = *clearance.add_agents() =
        Encode(next->second, agent.acknowledged_sequence(), agent.acknowledged_revision(), wanted);
    wire.set_effective_from_ns(
        std::max({next->second.effective_from, agent.acknowledged_from(), world.promised_from()})
            .nanoseconds());
    Set(lowerings.Of(next->first), &wire);
  }
  bus_.Publish(output);
}

/// The first time at which one of the detectors wants a state of the agent in the slot.
Instant Publisher::WantedAt(const Clearances& clearances, std::uint32_t slot, Instant stamp,
                            Instant now) const {
  Instant wanted = streams_[0].demand.WantedAt(clearances.all().at(slot), stamp, now);
  for (std::size_t level = 0; level + 1 < streams_.size(); ++level) {
    const detection::AgentClearance* clearance = clearances.OfLevel(slot, level);
    if (clearance == nullptr) continue;
    wanted = std::min(wanted, streams_[level + 1].demand.WantedAt(*clearance, stamp, now));
  }
  return wanted;
}

/// Events of agents that the service removed say so. Pairs of all streams have different slots.
v1::CollisionEvent Publisher::EncodeOf(const detection::CollisionEvent& event, const World& world,
                                       const Stream& stream) const {
  v1::CollisionEvent wire = Encode(event);
  AddBecause(world, &wire);
  wire.set_level(stream.level);
  wire.set_pair_slot(event.pair_slot * static_cast<std::uint32_t>(streams_.size()) + stream.index);
  return wire;
}

std::vector<Telling> Publisher::Filter(const std::vector<detection::CollisionEvent>& events,
                                       const World& world, Stream* stream) {
  for (const detection::CollisionEvent& event : events) {
    event_log_.Add(EncodeOf(event, world, *stream));
    stream->labels.Note(event, world);
  }
  return stream->filter.Take(events, world.now(), RateTime(world));
}

void Publisher::PublishEvents(const std::vector<detection::CollisionEvent>& events,
                              const World& world, std::size_t stream) {
  Stream& of = streams_.at(stream);
  for (const Telling& telling : Filter(events, world, &of)) {
    if (claim_.speaks()) {
      Publish(telling, world, &of);
    } else if (telling.contact) {
      of.inherited.Keep(telling.event, of.labels.Of(telling.event));
    }
  }
  if (claim_.speaks() && !world.simulated()) Flush();
}

void Publisher::PublishScreening(const std::vector<detection::CollisionEvent>& events,
                                 World* world) {
  std::vector<v1::ScreeningEvent> messages = screening_.Take(events, *world, RateTime(*world));
  if (claim_.speaks()) {
    Publish(std::move(messages), world);
  } else {
    screening_.Keep(std::move(messages));
  }
}

void Publisher::Publish(std::vector<v1::ScreeningEvent> messages, World* world) {
  for (v1::ScreeningEvent& message : messages) {
    v1::ServiceStamp& stamp = *message.mutable_event()->mutable_stamp() = NextStamp();
    world->Find(message.simulator_id())->SetScreeningSequence(stamp.sequence());
    v1::Output output;
    *output.mutable_screening_event() = std::move(message);
    bus_.Publish(output);
  }
}

void Publisher::Hear(const v1::Input& input) {
  if (claim_.speaks() || !input.has_event_heard()) return;
  const auto stream = std::ranges::find(streams_, input.event_heard().level(), &Stream::level);
  if (stream != streams_.end()) stream->inherited.Hear(input.event_heard());
}

void Publisher::ForgetUndecided(Instant before) {
  for (Stream& stream : streams_) stream.inherited.DropUndecided(before);
}

void Publisher::PublishInherited(World* world) {
  for (auto& [epoch, contact] : std::exchange(unheard_, {})) {
    PublishContact(std::move(contact), epoch);
  }
  for (Stream& stream : streams_) PublishInherited(*world, &stream);
  Publish(screening_.TakeInherited(*world), world);
}

void Publisher::PublishInherited(const World& world, Stream* stream) {
  std::set<std::pair<detection::AgentId, detection::AgentId>> told;
  for (v1::CollisionEvent& contact : stream->inherited.TakeTold()) {
    told.insert({IdOf(contact.lower()), IdOf(contact.higher())});
    PublishContact(std::move(contact), epoch_);
  }
  for (const UntoldContact& contact : stream->inherited.TakeUntold()) {
    told.insert({contact.event.lower, contact.event.higher});
    PublishContact(ForReaders(contact.event, contact.labels, world, stream), epoch_);
  }
  for (const Telling& telling : stream->filter.Standing()) {
    const detection::CollisionEvent& event = telling.event;
    if (telling.contact && told.contains({event.lower, event.higher})) continue;
    Publish(telling, world, stream);
  }
}

v1::CollisionEvent Publisher::ForReaders(const detection::CollisionEvent& event,
                                         const PairLabels& labels, const World& world,
                                         Stream* stream) {
  v1::CollisionEvent wire = EncodeOf(event, world, *stream);
  AddLabels(labels, &wire);
  wire.set_contact(stream->inherited.NumberOf(event));
  return wire;
}

void Publisher::Publish(const Telling& telling, const World& world, Stream* stream) {
  v1::CollisionEvent event =
      ForReaders(telling.event, stream->labels.Of(telling.event), world, stream);
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
  if (observer_ != nullptr) observer_->TakeContact(event);
  v1::Output output;
  *output.mutable_collision_event() = std::move(event);
  bus_.Publish(output);
}

void Publisher::Flush() {
  bus_.Flush();
  if (observer_ != nullptr) observer_->ContactsHaveLeft();
}

EventCounters Publisher::event_counters() const {
  EventCounters counters = events_;
  for (const Stream& stream : streams_) counters.forecasts_withheld += stream.filter.withheld();
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
  for (Stream& stream : streams_) {
    if (!claim_.speaks()) KeepUnheard(world, &stream);
    stream.filter.Forget();
    stream.labels.Forget();
    stream.inherited.BeginEpoch(epoch);
  }
  screening_.Forget();
  while (unheard_.size() > InheritedEvents::kUntoldMax) unheard_.pop_front();
  epoch_ = epoch;
  earliest_.reset();
}

void Publisher::KeepUnheard(const World& world, Stream* stream) {
  for (v1::CollisionEvent& contact : stream->inherited.TakeTold()) {
    unheard_.emplace_back(epoch_, std::move(contact));
  }
  for (const UntoldContact& contact : stream->inherited.TakeUntold()) {
    unheard_.emplace_back(epoch_, ForReaders(contact.event, contact.labels, world, stream));
  }
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
