// What a program that follows a world says of the service itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "idl/messages.pb.h"

namespace collision::client {

/// Says once that the service is gone, that it is back, or that another one speaks in its place.
/// A service that still claims the world is present too, so the service counts as back with its
/// next status, not before. One thread.
class ServiceNotes {
 public:
  /// `present`: a service is on the network; `status`: the newest one of the service in force.
  /// What is to be said now, without a newline; nullopt: nothing.
  std::optional<std::string> Take(bool present, const std::optional<v1::ServiceStatus>& status);

 private:
  using Sample = std::tuple<std::uint64_t, std::uint32_t, std::uint64_t>;  ///< Id, term, sequence.

  std::optional<Sample> heard_;  ///< The newest status.
  bool gone_ = false;            ///< It was said.
};

}  // namespace collision::client
