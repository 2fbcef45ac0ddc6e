// What the service refused, told to people.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "client/types.h"

namespace collision::client {

/// The service did not take this simulator's agents, and repeating does not help.
class RefusedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Prints the first refusal of each reason and counts the others.
class Refusals {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `simulator` begins each line.
  explicit Refusals(std::string simulator) : simulator_(std::move(simulator)) {}

  void Hear(const std::vector<Rejection>& rejections, Wall now);

  /// The service has granted us more time: we are the owner now.
  void Granted() { owned_at_.reset(); }

  /// How many there were; empty if there were none.
  std::string Summary() const;

  /// The reason why agents were refused for good: no room, another run or owner, a clock of the
  /// other kind, values out of range. A late or lost sample is none; an owner is none either if we
  /// have been heard since: our own predecessor may still have counted as alive.
  std::optional<std::string> fatal(Wall now) const;

 private:
  std::string simulator_;
  std::map<std::string, std::size_t> reasons_;  ///< How often each was heard.
  std::optional<Wall> owned_at_;  ///< When we last heard that our name belongs to another.
  std::uint64_t count_ = 0;       ///< As the service counts; it does not tell all.
};

}  // namespace collision::client
