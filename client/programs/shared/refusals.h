// Prints what the service refused.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "client/api/types.h"

namespace collision::client {

/// The service refused this simulator's agents, and repeating them does not help.
class RefusedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Prints the first refusal of each reason and counts the others.
class Refusals {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// Each line begins with `simulator`.
  explicit Refusals(std::string simulator) : simulator_(std::move(simulator)) {}

  void Add(const std::vector<Rejection>& rejections, Wall now);

  /// The service has granted more time, so this simulator owns its name now.
  void Granted() { owned_at_.reset(); }

  /// The numbers of refusals by reason; empty without any.
  std::string Summary() const;

  /// The reason why the agents were refused for good: no room, another run or owner, a clock of the
  /// other kind, values out of range. A late or lost sample is no such reason; nor is another owner
  /// if time was granted since: the simulator's own predecessor may still have counted as alive.
  std::optional<std::string> fatal(Wall now) const;

 private:
  std::string simulator_;
  std::map<std::string, std::size_t> reasons_;  ///< Number of refusals received, by reason.
  std::optional<Wall> owned_at_;  ///< When the service last said that the name belongs to another.
  std::uint64_t count_ = 0;       ///< As the service counts; it does not report all.
};

}  // namespace collision::client
