// Whom the world's time waits for, as the service tells it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/library/notices/notices.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// The names in the extension `waiting_for` of the service's status, and who is behind. One thread.
class WaitingList {
 public:
  /// `simulator_id`: whose list it is.
  explicit WaitingList(std::uint64_t simulator_id) : simulator_id_(simulator_id) {}

  void Take(const v1::ServiceStatus& status);

  /// Whether the list has changed since the last call; it begins empty.
  bool TakeChange();

  /// In the order of the service. Of a list too long for the status: those that it names.
  const std::vector<std::string>& names() const { return names_; }

  /// Of the other simulators in the status, the one whose clock is furthest behind.
  const std::optional<Laggard>& laggard() const { return laggard_; }

 private:
  void TakeLaggard(const v1::ServiceStatus& status);

  const std::uint64_t simulator_id_;
  std::optional<Laggard> laggard_;
  std::vector<std::string> names_;
  std::vector<std::string> told_;
};

}  // namespace collision::client
