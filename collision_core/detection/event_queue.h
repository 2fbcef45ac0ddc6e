// Agents ordered by the time at which they must be asked again.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/motion/instant.h"

namespace collision {

/// A binary heap of (key, agent), with each agent's place known so that its key can change in O(log
/// n). Equal keys come in the order of the agents' indices, so that the order never depends on
/// history.
class EventQueue {
 public:
  /// Adds the agent, or moves it to its new key.
  void Set(std::uint32_t agent, Instant key);
  void Remove(std::uint32_t agent);

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  std::uint32_t top() const { return heap_.front().agent; }
  Instant top_key() const { return heap_.front().key; }

 private:
  struct Entry {
    Instant key;
    std::uint32_t agent;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  static constexpr std::uint32_t kAbsent = ~0u;

  void Place(std::size_t at, const Entry& entry);
  void SiftUp(std::size_t at);
  void SiftDown(std::size_t at);

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // by agent
};

}  // namespace collision
