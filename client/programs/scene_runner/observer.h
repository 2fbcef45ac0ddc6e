// Observes a run as a monitor: keeps what it receives for the checker, prints it, and times it.
#pragma once

#include <chrono>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "client/checker/evidence.h"
#include "client/library/network/message_monitor.h"
#include "collision/pending_names.h"

namespace collision::client {

struct ObserverOptions {
  std::string world;
  std::uint32_t domain = 0;
  std::int64_t origin_ns = 0;  ///< Printed times count from it.
  std::int64_t end_ns =
      std::numeric_limits<std::int64_t>::max();  ///< The run's: later events are not timed.
  bool real_time = false;                        ///< The world has a wall clock.
  std::string credentials = {};                  ///< A folder, in a secured world.
  bool every_event = false;  ///< Print also the 201st possible, dismissed or withdrawn one.
};

/// An ordinary, read-only subscriber. One thread.
class Observer {
 public:
  /// Throws std::runtime_error if DDS is not available.
  explicit Observer(const ObserverOptions& options);

  /// Takes in what arrives within `timeout`. Prints a line for every event that changes its status,
  /// once its agents' names are known or a second later, and from time to time a line of progress.
  /// Returns the number of samples.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// A quiet observer prints nothing, also not later: another program has the terminal.
  void SetQuiet(bool quiet) { quiet_ = quiet; }

  /// Prints the events that still wait, and the last line of progress for good.
  void FinishProgress();

  const checker::Observations& observations() const { return observations_; }

  /// The service's latest time; nullopt until it has published one.
  std::optional<std::int64_t> now_ns() const { return now_ns_; }

  /// Latency from update to event [s], one for every change of status except withdrawals: from this
  /// monitor's receipt of the newest states that the event can follow from to its receipt of the
  /// event. Those are the newest states stamped not later than the event's time: in real time
  /// those of both agents' owners, in lock-step those of all simulators (the last of them lets the
  /// service's time advance); the latest receipt counts.
  const std::vector<double>& latencies() const { return latencies_; }

  /// Wall time from the service's first instant at or after the run's start to its first at or
  /// after the end [s]; 0 before that.
  double running_seconds() const;

  const std::vector<std::string>& rejections() const { return rejections_; }

 private:
  using Wall = std::chrono::steady_clock::time_point;
  using ContactKey = std::tuple<std::string, std::string, std::uint32_t>;

  MessageMonitor::Callbacks Callbacks();
  void Handle(const v1::CollisionEvent& event);
  void Handle(const v1::AgentDescription& description);
  void Handle(const v1::AgentStates& states);
  void Handle(const v1::Rejection& rejection);
  bool IsOver(const v1::ServiceStamp& stamp);
  void SeeTime(std::int64_t now_ns);
  void TimeEvent(const v1::CollisionEvent& event);
  void PrintEvents(Wall now);
  void Print(const Event& event);
  void PrintProgress(bool final);
  void ClearProgress();
  std::string NameOf(const AgentId& id) const;

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
  std::map<AgentId, std::string> names_;
  PendingNames pending_names_;
  std::map<ContactKey, v1::EventStatus> statuses_;
  std::map<v1::EventStatus, std::size_t> counts_;
  std::map<std::uint64_t, std::deque<std::pair<std::int64_t, Wall>>>
      states_;  // newest stamp, received
  std::optional<std::int64_t> now_ns_;
  std::optional<std::uint32_t> epoch_;       ///< Of the scene.
  std::optional<Wall> began_at_, ended_at_;  // the run, as now_ns_ shows
  std::vector<double> latencies_;
  std::vector<std::string> rejections_;
  MessageMonitor monitor_;  // last: its callbacks use the rest
};

}  // namespace collision::client
