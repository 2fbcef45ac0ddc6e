// When a change of a pair is worth an event, and the content of the event.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/detection/events/contact_episode.h"
#include "collision_core/detection/events/contact_numbers.h"
#include "collision_core/detection/step/detector_counters.h"
#include "collision_core/detection/step/detector_options.h"

namespace collision::detection {

/// The two agents of a pair in the order of their ids, and the pair's place in the pair table.
struct PairName {
  AgentId lower, higher;
  AgentIndex lower_index, higher_index;
  PairSlot slot;
  double margin = 0;  ///< As in CollisionEvent.
  double size = 0;    ///< The sum of the radii of both [m]: no contact is deeper.
  std::uint32_t lower_side = 0, higher_side = 0;  ///< As in CollisionEvent.
};

/// What has been published about a pair.
struct PublishedEvent {
  CollisionEvent event{};  ///< The last revision.
  bool announced = false;  ///< The event is possible or confirmed, not final yet.
  /// The event also covers a doubt before its contact; freedom is certified between the two.
  bool doubted = false;
  bool broken = false;     ///< A bound was broken since it was opened: its content may be void.
  std::uint64_t work = 0;  ///< Work units spent on the contact since it got its number.
  /// Of the settled time since it was announced, up to `followed_until` (FollowClosest()).
  std::optional<ClosestApproach> closest;
  Instant followed_until = Instant::Never();
};

/// How near two agents are at an instant, how they move there, and from which states that follows.
struct EncounterAnswer {
  narrow_phase::Proximity found;
  std::optional<RelativeVelocity> relative_velocity;
  std::optional<StateUsed> lower_state, higher_state;
  std::uint64_t work = 0;  ///< Units spent.
};

/// What is expected of two agents, and their newest states.
struct ExpectationAnswer {
  std::optional<Expectation> expected;
  std::optional<StateUsed> lower_state, higher_state;
};

/// Answers for the two agents of one pair, with budgets of its own.
class EncounterSource {
 public:
  virtual ~EncounterSource() = default;
  virtual EncounterAnswer At(Instant at) = 0;
  virtual ExpectationAnswer Expected() = 0;
};

/// Whether this is the last report about a pair.
enum class Finality {
  kOngoing,  ///< States may still come.
  kLast      ///< One of the two leaves or expires: the past is reported, nothing new announced.
};

/// Why a pair is no longer watched.
enum class Departure {
  kRemoved,   ///< An agent was removed: a contact has ended by then.
  kUnwatched  ///< An agent expired, or filters keep the two apart: a contact's end is unknown.
};

/// Whether a pair has to be tracked further.
enum class PairInterest { kNear, kFarApart };

/// Turns what is known about a pair into revisions of events: possible before confirmed, confirmed
/// before ended, each status once, and further revisions only where a bracket moved by enough to
/// matter. It computes no geometry. O(episodes) per call.
class Announcer {
 public:
  /// `counters` outlives the announcer.
  Announcer(const DetectorOptions& options, DetectorCounters* counters)
      : options_(options), counters_(counters) {}

  /// Starts a step: forgets the events of the one before.
  void Start(Instant now);
  /// The revisions of this step, in the order in which they were made; valid until the next
  /// Start().
  const std::vector<CollisionEvent>& events() const { return events_; }

  /// Asks `encounter` only for what it publishes: for the instant at which a contact is confirmed,
  /// and for what is expected when a possible event is told or revised.
  PairInterest Report(const PairName& pair, const PairOutlook& outlook, Finality finality,
                      EncounterSource* encounter, PublishedEvent* published);

  /// The pair may meet soon, and nothing more is known of it yet. Requires that it is not
  /// announced.
  void Announce(const PairName& pair, Instant free_until, bool began_before,
                EncounterSource* encounter, PublishedEvent* published);

  /// The pair is no longer watched, since both were there up to `until`: gives its event a final
  /// status. A confirmed event ends; a possible one is undecided if an episode is open (`open`;
  /// null: free), else withdrawn.
  void Close(const PairName& pair, const ContactEpisode* open, Departure departure, Instant until,
             PublishedEvent* published);

  /// Forgets the contact numbers of an agent that has left.
  void Forget(AgentIndex agent) { numbers_.Forget(agent); }

  void Validate() const { numbers_.Validate(); }

 private:
  struct Subject;  // one call of Report() or Close()

  /// Where an event begins.
  struct Opening {
    Instant free_until;
    bool began_before;  // as in CollisionEvent
  };

  void Finish(const Subject& subject, const ContactEpisode& episode);
  void Possible(const Subject& subject, const PairOutlook& outlook);
  void Confirm(const Subject& subject, const ContactEpisode& episode);
  void Open(const Subject& subject, const Opening& opening);
  void Emit(const Subject& subject, EventStatus status);

  const DetectorOptions options_;
  DetectorCounters* counters_;
  ContactNumbers numbers_;
  Instant now_;
  std::vector<CollisionEvent> events_;
};

}  // namespace collision::detection
