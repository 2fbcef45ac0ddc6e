// A monitor on the faulty network: the real client library, which reads only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "client/library/network/message_monitor.h"
#include "tests/faults/ends.h"

namespace collision::faults {

/// An event as the monitor was told of it.
struct MonitoredEvent {
  std::int64_t at_ns;  ///< Virtual time.
  v1::CollisionEvent event;
};

class MonitorProgram {
 public:
  explicit MonitorProgram(Network* network);

  void Start();
  /// It reads no more, although its process lives; or again.
  void Stop() { reads_ = false; }
  void GoOn();

  Network::Id id() const { return end_->id(); }
  const std::vector<MonitoredEvent>& heard() const { return heard_; }
  std::uint64_t contacts_missed() const { return monitor_->contacts_missed(); }
  /// Contacts that it did not hand on, since a service that took over has told them once more.
  std::uint64_t contacts_repeated() const { return monitor_->contacts_repeated(); }
  /// The numbers of the contacts heard, by service.
  const std::map<std::uint64_t, std::set<std::uint64_t>>& contacts() const { return contacts_; }
  /// Numbers that came again, or after a higher one.
  std::uint64_t out_of_order() const { return out_of_order_; }
  const std::optional<v1::ServiceStatus>& status() const { return status_; }
  /// The services that were in force, in this order.
  const std::vector<std::uint64_t>& services() const { return services_; }

 private:
  void Wake(std::int64_t at_ns);
  void Hear(const v1::CollisionEvent& event);

  Network& network_;
  ClientEnd* end_ = nullptr;
  std::optional<client::MessageMonitor> monitor_;
  bool reads_ = true, awaits_ = false;
  std::vector<MonitoredEvent> heard_;
  std::map<std::uint64_t, std::set<std::uint64_t>> contacts_;
  std::uint64_t out_of_order_ = 0;
  std::optional<v1::ServiceStatus> status_;
  std::vector<std::uint64_t> services_;
};

}  // namespace collision::faults
