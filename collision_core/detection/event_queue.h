// Indices ordered by the time at which something must be done about them.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/base/instant.h"

namespace collision::detection {

/// A binary heap of (key, index), with each index's place known so that its key can change in O(log
/// n). Equal keys come in the order of the indices, so that the order never depends on history.
class EventQueue {
 public:
  /// Adds the index, or moves it to its new key. O(1) if the key is the one it has.
  void Set(std::uint32_t index, Instant key);
  void Remove(std::uint32_t index);

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  std::uint32_t top() const { return heap_.front().index; }
  Instant top_key() const { return heap_.front().key; }
  bool Contains(std::uint32_t index) const {
    return index < place_.size() && place_[index] != kAbsent;
  }

  /// Appends all indices whose key is not later than `last`, in no order that counts; O(their
  /// number) whatever the size.
  void UpTo(Instant last, std::vector<std::uint32_t>* indices) const;

 private:
  struct Entry {
    Instant key;
    std::uint32_t index;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  static constexpr std::uint32_t kAbsent = ~0u;

  void Place(std::size_t at, const Entry& entry);
  void SiftUp(std::size_t at);
  void SiftDown(std::size_t at);

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // by index
};

}  // namespace collision::detection
