// What a monitor sees of a run: kept for the checker, printed as it comes, timed.
#pragma once

#include <chrono>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "client/event_hold.h"
#include "client/monitor.h"
#include "client/simulators/checker/evidence.h"

namespace collision::client {

struct ObserverOptions {
  std::string world;
  std::uint32_t domain = 0;
  std::int64_t origin_ns = 0;  ///< Times are printed since it.
  std::int64_t end_ns =
      std::numeric_limits<std::int64_t>::max();  ///< The run's: later events are not timed.
  bool real_time = false;                        ///< The world has a wall clock.
  bool every_event = false;  ///< Print also the 201st possible, dismissed or withdrawn one.
};

/// An ordinary, read-only subscriber. One thread.
class Observer {
 public:
  /// Throws std::runtime_error if DDS is not to be had.
  explicit Observer(const ObserverOptions& options);

  /// Takes what arrives within `timeout`; prints a line for every event that changes its status, as
  /// soon as its agents' names are known or a second later, and from time to time a line of
  /// progress. Returns the number of samples.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// While quiet nothing is printed, nor later: somebody else has the terminal.
  void SetQuiet(bool quiet) { quiet_ = quiet; }

  /// Prints the events that still wait, and the last line of progress for good.
  void FinishProgress();

  const checker::Observations& observations() const { return observations_; }

  /// The service's latest time; nullopt before it has told any.
  std::optional<std::int64_t> now_ns() const { return now_ns_; }

  /// Update -> event [s]: from when this monitor received the newest states that the event can
  /// follow from to when it received the event. Those are the newest states stamped not later than
  /// its now: with a wall clock of both agents' owners, in lock-step of all simulators (the
  /// service's time comes there with the last of them); the latest of them counts. One for every
  /// change of status but withdrawals.
  const std::vector<double>& latencies() const { return latencies_; }

  /// Wall time from the service's first instant at or after the run's start to its first at or
  /// after the end [s]; 0 before that.
  double running_seconds() const;

  const std::vector<std::string>& rejections() const { return rejections_; }

 private:
  using Wall = std::chrono::steady_clock::time_point;
  using ContactKey = std::tuple<std::string, std::string, std::uint32_t>;

  Monitor::Callbacks Callbacks();
  void Hear(const v1::CollisionEvent& event);
  void Hear(const v1::AgentDescription& description);
  void Hear(const v1::AgentStates& states);
  void Hear(const v1::Rejection& rejection);
  void SeeTime(std::int64_t now_ns);
  void TimeEvent(const v1::CollisionEvent& event);
  void PrintEvents(Wall now);
  void Print(const v1::CollisionEvent& event);
  void PrintProgress(bool final);
  void ClearProgress();
  std::string NameOf(const v1::AgentId& id) const;

  std::int64_t origin_ns_;
  std::int64_t end_ns_;
  bool real_time_;
  bool every_event_;
  bool terminal_;
  bool quiet_ = false;
  std::size_t quiet_lines_ = 0;
  bool progress_shown_ = false;
  Wall progress_at_;
  checker::Observations observations_;
  std::map<std::string, std::string> names_;  // by the serialised id
  EventHold hold_;
  std::map<ContactKey, v1::EventStatus> statuses_;
  std::map<v1::EventStatus, std::size_t> counts_;
  std::map<std::uint64_t, std::deque<std::pair<std::int64_t, Wall>>>
      states_;  // newest stamp, received
  std::optional<std::int64_t> now_ns_;
  std::optional<Wall> began_at_, ended_at_;  // the run, as now_ns_ shows
  std::vector<double> latencies_;
  std::vector<std::string> rejections_;
  Monitor monitor_;  // last: its callbacks use the rest
};

}  // namespace collision::client
