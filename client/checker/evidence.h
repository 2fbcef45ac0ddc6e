// The truth of a run side by side with what was published about it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "client/checker/motion/true_contacts.h"
#include "idl/config.pb.h"
#include "idl/messages.pb.h"
#include "idl/scene.pb.h"

namespace collision::checker {

/// What a monitor received, in the order of arrival.
struct Observations {
  std::vector<v1::CollisionEvent> events;
  std::vector<v1::EarliestIntersection> earliest;
  std::vector<v1::Clearance> clearances;
  std::vector<v1::AgentName> names;
  v1::ServiceStatus status;  ///< The last.
};

/// Facts about the run that the checker cannot observe.
struct RunFacts {
  std::int64_t start_ns = 0;  ///< Start of the run, from which a scene's times count.
  /// End of the run: what a scene expects later is not demanded.
  std::int64_t end_ns = std::numeric_limits<std::int64_t>::max();
  /// An agent may have left for the service this long before its motion ends: simulators may be
  /// ahead by the time it grants. See Evidence::MayHaveLeft().
  std::int64_t leaving_ns = 0;
  /// In real time: the longest delay of a sample. Changes this recent excuse a promise.
  std::int64_t transit_ns = 0;
  /// The service's, as far as it differs from the defaults: its levels, classes and excluded pairs.
  v1::Config config = {};
};

/// When something was published. Several steps of the service may have the same time; the stamps
/// tell their order.
struct Moment {
  std::int64_t now_ns = 0;
  v1::ServiceStamp stamp;

  bool IsAfter(const Moment& other) const;
};

/// Whether an event says that its contact has taken place or certainly will.
bool IsConfirmed(const v1::CollisionEvent& event);

/// All revisions of one contact, or of one crossing of a level, as published.
struct EventHistory {
  std::size_t a = 0;  ///< Indices of the motions, a < b.
  std::size_t b = 0;
  Moment announced;                 ///< The first revision, or the first after `closed` was void.
  std::optional<Moment> confirmed;  ///< The first that was confirmed.
  std::optional<Moment> closed;     ///< The first that was final since.
  std::vector<v1::CollisionEvent> revisions;  ///< As received; the newest last.

  const v1::CollisionEvent& last() const { return revisions.back(); }
};

/// The id of an agent, with a hash: every promise is looked up by it.
struct AgentKey {
  std::uint64_t simulator = 0;
  std::uint32_t run = 0, slot = 0, generation = 0;

  friend bool operator==(const AgentKey&, const AgentKey&) = default;
  struct Hash {
    std::size_t operator()(const AgentKey& key) const {
      constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
      std::uint64_t hash = key.simulator;
      for (const std::uint32_t part : {key.run, key.slot, key.generation}) {
        hash = (hash ^ (hash >> 32) ^ part) * kOdd;
      }
      return hash;
    }
  };
};

/// About contacts; and of each level of the configuration likewise about its crossings, which are
/// contacts of agents that are grown by half of its margin.
class Evidence {
 public:
  Evidence(std::vector<AgentMotion> motions, const Observations& observations,
           const RunFacts& facts);

  const std::vector<AgentMotion>& motions() const { return motions_; }
  const std::vector<TrueContact>& contacts() const { return contacts_; }
  const std::vector<EventHistory>& histories() const { return histories_; }
  const Observations& observations() const { return observations_; }
  const RunFacts& facts() const { return facts_; }

  /// The evidence about each level, in the configuration's order.
  const std::vector<Evidence>& levels() const { return levels_; }

  /// What this is about; nullptr: contacts.
  const v1::Level* level() const { return level_ ? &*level_ : nullptr; }

  /// Contacts of one agent, in order of begin.
  const std::vector<const TrueContact*>& ContactsOf(std::size_t motion) const {
    return by_agent_[motion];
  }

  /// Histories of the pair a < b.
  std::vector<const EventHistory*> HistoriesOf(std::size_t a, std::size_t b) const;

  /// The motion of an agent; nullopt if no simulator logged it.
  std::optional<std::size_t> MotionOf(const v1::AgentId& id) const;

  /// Events about agents that no simulator logged.
  const std::vector<v1::CollisionEvent>& strange_events() const { return strange_events_; }

  /// The service may not have decided contacts that begin later: the earliest end of the logs, less
  /// one piece and the transit.
  std::int64_t judged_until_ns() const { return judged_until_ns_; }

  /// Whether one of the two appeared or jumped in [from, to]; earlier promises could not know it.
  bool Changed(const TrueContact& contact, std::int64_t from_ns, long double to_ns) const {
    return Changed(contact.a, contact.b, from_ns, to_ns);
  }
  bool Changed(std::size_t a, std::size_t b, std::int64_t from_ns, long double to_ns) const;

  /// Whether one of the two may have left by then. Of who has left nothing is promised, a contact
  /// that would begin later is withdrawn, and one in progress is ended.
  bool MayHaveLeft(const TrueContact& contact, long double at_ns) const {
    return MayHaveLeft(contact.a, contact.b, at_ns);
  }
  bool MayHaveLeft(std::size_t a, std::size_t b, long double at_ns) const;

  /// Whether one of the two is more than a ball or a half-space.
  bool HasShape(std::size_t a, std::size_t b) const {
    return motions_[a].body().HasShape() || motions_[b].body().HasShape();
  }

  /// Number of true contacts that are not grazes.
  std::size_t contacts_certain() const;

  /// "9 × 11", or "9 × 11, level near".
  std::string PairName(std::size_t a, std::size_t b) const;

  /// An instant as seconds since the run's start.
  std::string Time(long double instant_ns) const;

 private:
  Evidence(std::vector<AgentMotion> motions, const Observations& observations,
           const RunFacts& facts, const v1::Level& level);

  void FindEvents();
  void Sort(const v1::CollisionEvent& event);

  std::vector<AgentMotion> motions_;
  const Observations& observations_;
  RunFacts facts_;
  std::optional<v1::Level> level_;
  std::vector<Evidence> levels_;
  std::vector<TrueContact> contacts_;
  std::vector<std::vector<const TrueContact*>> by_agent_;
  std::vector<EventHistory> histories_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> histories_of_;
  std::vector<v1::CollisionEvent> strange_events_;
  std::unordered_map<AgentKey, std::size_t, AgentKey::Hash> ids_;
  std::int64_t judged_until_ns_ = 0;
};

}  // namespace collision::checker
