// Which events `collisionctl events` shows.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// In place of the name of a level: contact itself.
inline constexpr char kContactLevel[] = "contact";

/// All of what is set must hold.
struct EventFilter {
  /// An event of one of these agents, "agent" or "simulator:agent"; empty: of any.
  std::vector<std::string> agents = {};
  std::vector<EventStatus> statuses = {};      ///< Empty: any.
  std::vector<std::string> levels = {};        ///< Names, or kContactLevel; empty: any.
  std::optional<std::int64_t> within_ns = {};  ///< It begins at most this far ahead of now.
  std::optional<std::int64_t> since_ns = {};   ///< This revision is at most so old.
  std::optional<std::size_t> top = {};         ///< It is one of so many that are nearest in time.
  /// If it is only possible, it is expected: IsExpected().
  bool expected = false;
};

/// Whether the agent has this name, alone or behind its simulator's: "agent", "simulator:agent".
bool IsCalled(const AgentId& id, const std::string& name, const WorldView& view);

/// A sentence if the filter names a level that the service in force does not have, with those that
/// it has; empty: it names none, or the service has not said which there are.
std::string UnknownLevelText(const EventFilter& filter, const WorldView& view);

/// A sentence about those of its agents that are not in the world now; empty: all are.
std::string AbsentAgentsText(const EventFilter& filter, const WorldView& view);

/// The status of this name, as Name(EventStatus) has it; nullopt: there is none.
std::optional<EventStatus> StatusOf(const std::string& name);

/// Whether the two touch, did or may have, or will if both keep the motion that they told. False of
/// an event that is only possible and expected to pass, or of which nothing is expected, and of one
/// that came to nothing.
bool IsExpected(const v1::CollisionEvent& event);

/// Published before the world's time began anew: its times are not those of now.
bool IsOfEarlierEpoch(const v1::CollisionEvent& event, const WorldView& view);

/// The world's time, as far as it is known when this event is looked at; for an event of an earlier
/// epoch that of its publication.
std::int64_t NowOf(const v1::CollisionEvent& event, const WorldView& view);

/// How far ahead of `now_ns` the event begins at the earliest [ns], 0 if that has come, kNever if
/// it is not known. A forecast is told anew only when it says something new, so one whose begin has
/// come is as far ahead as it was when it was told.
std::int64_t LeadTime(const v1::CollisionEvent& event, std::int64_t now_ns);

/// LeadTime(), or how long the event has been over.
std::int64_t DistanceInTime(const v1::CollisionEvent& event, std::int64_t now_ns);

/// Selects events of a view, one by one or all together. One thread.
class EventSelection {
 public:
  /// Events whose order in time is remembered for `top`, which is not higher; beyond it the
  /// farthest is forgotten.
  static constexpr std::size_t kRememberedMax = 4096;

  explicit EventSelection(EventFilter filter) : filter_(std::move(filter)) {}

  /// Those that fit, expected ones first; within these in their order, with `top` the nearest
  /// first.
  std::vector<v1::CollisionEvent> Of(std::vector<v1::CollisionEvent> events,
                                     const WorldView& view) const;

  /// Whether the event fits. With `top`: it is among the nearest of all that were asked about.
  bool Takes(const v1::CollisionEvent& event, const WorldView& view);

 private:
  /// Lower, higher, level, contact.
  using Key = std::tuple<AgentId, AgentId, std::string, std::uint32_t>;

  static Key KeyOf(const v1::CollisionEvent& event);
  bool Fits(const v1::CollisionEvent& event, const WorldView& view) const;
  bool IsOfLevels(const v1::CollisionEvent& event) const;
  bool FitsInTime(const v1::CollisionEvent& event, const WorldView& view) const;
  bool IsOfAgents(const v1::CollisionEvent& event, const WorldView& view) const;
  bool IsNearest(const v1::CollisionEvent& event, std::int64_t now_ns);

  EventFilter filter_;
  std::map<Key, v1::CollisionEvent> remembered_;  ///< Without their labels.
};

}  // namespace collision::client
