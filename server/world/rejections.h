// Refused input: counted, logged, and reported to its sender.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "server/codec/refusal.h"
#include "server/world/world.h"

namespace collision::server {

/// Counts every refusal, per reason and per simulator, notes those that stand (StandingRefusals),
/// and keeps the messages to the senders: at most `per_second_max` in one second of the monotonic
/// clock, so that a broken simulator cannot flood the network, and no more of one simulator than
/// its quota, so that it does not silence what is told to others. The log has at most one line
/// about the refusals of one simulator per second. One thread.
class Rejections {
 public:
  /// `world` outlives this: it knows the simulators and the time.
  Rejections(std::uint32_t per_second_max, World* world)
      : per_second_max_(per_second_max), world_(*world) {}

  void Add(const Refusal& refusal);

  /// Counts a refusal of which its sender knows.
  void Count(const Refusal& refusal);

  /// The messages since the last call, without stamps.
  [[nodiscard]] std::vector<v1::Rejection> Take();

  std::uint64_t count(v1::RejectionReason reason) const {
    return counts_[static_cast<std::size_t>(reason)];
  }

  /// Refusals beyond `per_second_max`, and those that were only counted.
  std::uint64_t suppressed() const { return suppressed_; }

 private:
  /// Whether one more may be told to this simulator in this second; it then counts as told.
  bool MayTell(std::uint64_t simulator_id);

  /// The refusals of this simulator so far.
  std::uint64_t CountOne(const Refusal& refusal);

  const std::uint32_t per_second_max_;
  World& world_;
  std::array<std::uint64_t, v1::RejectionReason_ARRAYSIZE> counts_{};
  std::uint64_t of_unknown_ = 0;  ///< Refusals that name a simulator which is not in the world.
  std::uint64_t suppressed_ = 0;
  std::int64_t second_ = -1;
  std::uint32_t told_in_second_ = 0;
  std::map<std::uint64_t, std::uint64_t> told_to_;  ///< In this second, by simulator.
  std::vector<v1::Rejection> pending_;
};

}  // namespace collision::server
