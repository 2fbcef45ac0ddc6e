// Whom the world's time waits for, as the service tells it.
#pragma once

#include <string>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// The names in the extension `waiting_for` of the service's status. One thread.
class WaitingList {
 public:
  void Take(const v1::ServiceStatus& status);

  /// Whether the list has changed since the last call; it begins empty.
  bool TakeChange();

  /// In the order of the service. Of a list too long for the status: those that it names.
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::string> told_;
};

}  // namespace collision::client
