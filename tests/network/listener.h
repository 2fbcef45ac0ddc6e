// A monitor on a host of its own that keeps what it hears, and when.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client/checker/evidence.h"
#include "collision/monitor.h"

namespace collision::network {

/// One status of the service in force.
struct HeardStatus {
  std::chrono::steady_clock::time_point at;  ///< When it arrived.
  std::uint64_t service = 0;
  std::uint32_t term = 0;
  bool followed = false;  ///< By simulators.
};

/// All that was heard so far.
struct Heard {
  checker::Observations observations;
  std::vector<HeardStatus> statuses;
  std::map<std::string, std::string> agents;  ///< Names, by the id of the agent as bytes.
  std::uint64_t contacts_missed = 0;
  std::int64_t now_ns = 0;  ///< The latest time of the world.
};

/// Listens on a thread that lives in a network namespace.
class Listener {
 public:
  /// `profile` is the path of a network profile of DDS. Throws std::system_error where there is no
  /// such namespace, std::runtime_error where DDS is not available.
  Listener(const std::string& network_namespace, const std::string& profile,
           const client::MonitorOptions& world);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// Waits until `condition` holds, which is asked after each arrival. Returns whether it does.
  bool WaitUntil(const std::function<bool(const Heard&)>& condition,
                 std::chrono::nanoseconds patience);

  /// A copy of what was heard.
  Heard heard() const;

 private:
  void Listen(const std::stop_token& stop, const std::string& network_namespace,
              const client::MonitorOptions& world);

  mutable std::mutex mutex_;  ///< Guards heard_, ready_ and failure_.
  std::condition_variable arrived_;
  Heard heard_;
  bool ready_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;
};

}  // namespace collision::network
