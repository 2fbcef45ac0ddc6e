// Tells senders what was refused, and counts it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/refusal.h"
#include "server/world.h"

namespace collision::server {

/// Every refusal is counted per reason and per simulator; at most `per_second_max` in one second of
/// the monotonic clock are told, so that a broken simulator cannot flood the network.
class Rejections {
 public:
  explicit Rejections(std::uint32_t per_second_max) : per_second_max_(per_second_max) {}

  /// `simulator` is the one the refusal names; null if the service does not know it.
  void Add(const Refusal& refusal, Simulator* simulator, const World& world);

  /// What is to be told since the last call, without stamps.
  std::vector<v1::Rejection> Take();

  std::uint64_t count(v1::RejectionReason reason) const { return counts_[reason]; }
  std::uint64_t untold() const { return untold_; }

 private:
  const std::uint32_t per_second_max_;
  std::array<std::uint64_t, v1::RejectionReason_ARRAYSIZE> counts_{};
  std::uint64_t of_unknown_ = 0;
  std::uint64_t untold_ = 0;
  std::int64_t second_ = -1;
  std::uint32_t told_in_second_ = 0;
  std::vector<v1::Rejection> pending_;
};

}  // namespace collision::server
