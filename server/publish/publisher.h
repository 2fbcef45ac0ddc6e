// Everything that the service publishes, stamped and handed to the bus.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/claim/service_claim.h"
#include "server/detectors/level.h"
#include "server/publish/event_filter.h"
#include "server/publish/event_log.h"
#include "server/publish/identity/event_labels.h"
#include "server/publish/inherited_events.h"
#include "server/publish/screening_events.h"
#include "server/publish/state_demand.h"
#include "server/world/world.h"

namespace collision::server {

/// Events published so far.
struct EventCounters {
  std::uint64_t contacts = 0;  ///< Also the number of the last one.
  std::uint64_t forecasts = 0;
  std::uint64_t forecasts_withheld = 0;  ///< EventFilter::withheld().
};

/// Is told of each contact that is published, and when those so far have left for the network.
class ContactObserver {
 public:
  virtual ~ContactObserver() = default;
  virtual void TakeContact(const v1::CollisionEvent& contact) = 0;
  virtual void ContactsHaveLeft() = 0;
};

/// Every sample carries (service, term, sequence); the sequence counts all samples. One thread.
class Publisher {
 public:
  /// Temporal resolutions for which a clearance that only rises may wait; the steps of a wall clock
  /// are one apart at most.
  static constexpr int kRisesWait = 2;

  /// `claim`: who publishes. It, the bus and the observer (null: none) outlive the publisher.
  Publisher(const v1::Config& config, const ServiceClaim* claim, Bus* bus,
            ContactObserver* observer = nullptr);

  /// Hands what has been published to the network.
  void Flush();

  /// Publishes the chunks that are marked as changed, each complete, and takes the marks. Chunk 0,
  /// which carries the grant, comes last: a simulator that waits for its grant in it then has the
  /// others. A simulator that has been granted nothing yet keeps its marks. With a wall clock
  /// those that only rise wait for others of their chunk: for kRisesWait
  /// resolutions and a step, and not at all if what readers know ends by then.
  /// Meanwhile a simulator has usually told new states, whose acknowledgement they go with.
  void PublishClearances(World* world);

  /// Publishes what is new to readers (EventFilter). Contacts are numbered from 1, and leave before
  /// the clearances of the same step, which name the last one: a simulator that is granted time
  /// hears first whom it has met. With a wall clock they are sent at once, before the clearances of
  /// all agents are written. While this service does not speak it takes
  /// note of them.
  void PublishEvents(const std::vector<detection::CollisionEvent>& events, const World& world) {
    PublishEvents(events, world, 0);
  }

  /// Likewise of a level, by its index in the configuration: its events have the name of the level.
  /// Its crossings are contacts of the same history; its forecasts have a rate of their own.
  void PublishLevelEvents(std::size_t level, const std::vector<detection::CollisionEvent>& events,
                          const World& world) {
    PublishEvents(events, world, level + 1);
  }

  /// Likewise of hypothetical agents, to their owners.
  void PublishScreening(const std::vector<detection::CollisionEvent>& events, World* world);

  /// Every input, before it is applied. While this service does not speak
  /// (ServiceClaim::speaks()) it takes note of the events of another one.
  void Hear(const v1::Input& input);

  /// As it stands by: what the service in force has not told of the time before this, it has found
  /// not to be. What this one found there and could not decide is dropped.
  void ForgetUndecided(Instant before);

  /// This service has taken over and speaks from now on: publishes the contacts that the other one
  /// has not, and what stands told of pairs whose event is not over; readers know which of these
  /// they have heard. Call it before the events of a step.
  void PublishInherited(World* world);

  /// Whether somebody reads the earliest intersection and `earliest_period_s` is over since it was
  /// last published or found unchanged.
  bool EarliestIsDue(const World& world);

  /// Publishes the answer if it differs from the last one published, or there are new readers.
  void PublishEarliest(const detection::EarliestAnswer& answer, const World& world);

  /// These two drop everything while this service does not speak: the one in force tells it.
  void PublishRejections(std::vector<v1::Rejection> rejections);
  void PublishBreaches(std::vector<v1::AgentBreach> breaches);

  /// It speaks: publishes who it is, if that has changed. Before anything but its status.
  void PublishHello();

  void PublishStatus(v1::ServiceStatus status);

  void PublishReports(std::vector<v1::SimulatorReport> reports);

  /// What is published from here on belongs to this epoch. Contacts of the one that is over which
  /// nobody has heard of, since this service does not speak yet, are told when it does.
  void BeginEpoch(std::uint32_t epoch, const World& world);

  /// As it stands by: the service in force is in this epoch, and has told all of those before.
  void ForgetBefore(std::uint32_t epoch);

  EventCounters event_counters() const;

  /// All revisions of the detector, without stamps and numbers, which differ between instances of
  /// the service.
  const EventLog& event_log() const { return event_log_; }
  /// Likewise of hypothetical agents.
  const EventLog& screening_log() const { return screening_.log(); }

 private:
  /// The events of one detector: of contacts, or of a level.
  struct Stream {
    std::string level;    ///< Empty: of contacts.
    std::uint32_t index;  ///< Of this stream; that of contacts has 0.
    StateDemand demand;
    EventFilter filter;
    EventLabels labels = {};
    InheritedEvents inherited = {};
  };

  v1::ServiceStamp NextStamp();
  Instant WantedAt(const Clearances& clearances, std::uint32_t slot, Instant stamp,
                   Instant now) const;
  void PublishEvents(const std::vector<detection::CollisionEvent>& events, const World& world,
                     std::size_t stream);
  std::vector<Telling> Filter(const std::vector<detection::CollisionEvent>& events,
                              const World& world, Stream* stream);
  void PublishInherited(const World& world, Stream* stream);
  void Publish(const Telling& telling, const World& world, Stream* stream);
  v1::CollisionEvent ForReaders(const detection::CollisionEvent& event, const PairLabels& labels,
                                const World& world, Stream* stream);
  v1::CollisionEvent EncodeOf(const detection::CollisionEvent& event, const World& world,
                              const Stream& stream) const;
  void PublishContact(v1::CollisionEvent event, std::uint32_t epoch);
  void Publish(std::vector<v1::ScreeningEvent> messages, World* world);
  /// What nobody has heard of the epoch that ends.
  void KeepUnheard(const World& world, Stream* stream);
  void PublishChunk(const World& world, Simulator* to, std::uint32_t chunk);

  const ServiceClaim& claim_;
  v1::ServiceHello hello_;  ///< As published last.
  Bus& bus_;
  ContactObserver* const observer_;
  std::uint32_t epoch_ = 1;
  std::uint64_t sequence_ = 0;
  std::uint64_t newest_forecast_ = 0;  ///< Its sequence; 0: there was none.
  EventLog event_log_;
  std::vector<Stream> streams_;  ///< Of contacts, then of the levels in their order.
  ScreeningEvents screening_;
  std::deque<std::pair<std::uint32_t, v1::CollisionEvent>> unheard_;  ///< With their epochs.
  EventCounters events_;
  const std::int64_t earliest_period_ns_;
  std::uint32_t earliest_readers_ = 0;
  std::optional<v1::EarliestIntersection> earliest_;
  std::int64_t earliest_now_ns_ = 0, earliest_monotonic_ns_ = 0;  ///< Of `earliest_`.
  const double resolution_s_;
};

}  // namespace collision::server
