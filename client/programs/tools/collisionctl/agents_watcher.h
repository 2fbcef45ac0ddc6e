// Asks simulators for fresh states while somebody looks.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "client/library/network/transport.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Watches all agents of a world while it lives, and repeats that before its lease is over. One
/// thread.
class AgentsWatcher {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// A program that dies is heeded this long.
  static constexpr std::chrono::seconds kLease{5};
  static constexpr std::chrono::seconds kRepeatPeriod{1};

  /// `period`: as idl/limits.h allows.
  AgentsWatcher(std::unique_ptr<Transport> transport, std::chrono::nanoseconds period);

  /// Says that nobody looks any more.
  ~AgentsWatcher();
  AgentsWatcher(const AgentsWatcher&) = delete;
  AgentsWatcher& operator=(const AgentsWatcher&) = delete;

  /// Writes the watch if it is due. To be called at least once in kRepeatPeriod.
  void Repeat(Time now);

 private:
  void Write(std::chrono::nanoseconds lease);

  const std::unique_ptr<Transport> transport_;
  v1::Watch watch_;
  std::optional<Time> written_;
};

}  // namespace collision::client
