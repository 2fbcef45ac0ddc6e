// What a monitor sees of a run: kept for the checker, printed as it comes, timed.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "client/monitor.h"
#include "client/simulators/checker/evidence.h"

namespace collision::client {

/// An ordinary, read-only subscriber. One thread.
class Observer {
 public:
  /// `origin_ns`: times are printed since it. Throws std::runtime_error if DDS is not to be had.
  Observer(const std::string& world, std::uint32_t domain, std::int64_t origin_ns);

  /// Takes what arrives within `timeout`; prints a line for every event that changes its status, and from
  /// time to time a line of progress. Returns the number of samples.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// Prints the last line of progress for good.
  void FinishProgress();

  const checker::Observations& observations() const { return observations_; }

  /// The service's latest time; nullopt before it has told any.
  std::optional<std::int64_t> now_ns() const { return now_ns_; }

  /// Update -> event [s]: from when this monitor received the newest states that the event can follow from (of
  /// both agents' owners, stamped not later than its now; the later of the two) to when it received the event.
  /// One for every event that changed its status.
  const std::vector<double>& latencies() const { return latencies_; }

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
  void PrintProgress(bool final);
  void ClearProgress();
  std::string NameOf(const v1::AgentId& id) const;

  std::int64_t origin_ns_;
  bool terminal_;
  bool progress_shown_ = false;
  Wall progress_at_;
  checker::Observations observations_;
  std::map<std::string, std::string> names_;           // by the serialised id
  std::map<ContactKey, v1::EventStatus> statuses_;
  std::map<v1::EventStatus, std::size_t> counts_;
  std::map<std::uint64_t, std::deque<std::pair<std::int64_t, Wall>>> states_;  // newest stamp, received
  std::optional<std::int64_t> now_ns_;
  std::vector<double> latencies_;
  std::vector<std::string> rejections_;
  Monitor monitor_;  // last: its callbacks use the rest
};

}  // namespace collision::client
