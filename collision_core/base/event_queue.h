// Indices ordered by the time at which something must be done about them.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/base/ids.h"
#include "collision_core/base/instant.h"

namespace collision {

/// A binary heap of (key, index). It knows each index's place, so that a key changes in O(log n).
/// Equal keys come in the order of the indices: the order never depends on history. `IndexType` is
/// an Index<Tag>; memory is O(greatest index ever set).
template <typename IndexType>
class EventQueue {
 public:
  /// Adds the index, or changes its key. O(1) if the key is the same.
  void Set(IndexType index, Instant key);
  /// Removes the index, if it is there.
  void Remove(IndexType index);

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  bool Contains(IndexType index) const {
    return index.value() < place_.size() && place_[index.value()] != kAbsent;
  }
  /// The index with the least (key, index), and its key. Requires !empty().
  IndexType top() const { return Head().index; }
  Instant top_key() const { return Head().key; }
  /// Requires Contains(index).
  Instant KeyOf(IndexType index) const {
    CORE_CHECK(Contains(index), "a queue knows the key of an index that it holds", index.value());
    return heap_[place_[index.value()]].key;
  }

  /// Appends all indices whose key is not later than `last`, in no particular order; O(their
  /// number) whatever the size.
  void UpTo(Instant last, std::vector<IndexType>* indices) const;

  /// Walks the whole queue: no entry comes before its parent, and each index's place is right.
  void Validate() const;

 private:
  struct Entry {
    Instant key;
    IndexType index;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  static constexpr std::uint32_t kAbsent = ~0u;

  const Entry& Head() const {
    CORE_CHECK(!heap_.empty(), "only a queue that is not empty has a head");
    return heap_.front();
  }
  void Place(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[entry.index.value()] = static_cast<std::uint32_t>(at);
  }
  void SiftUp(std::size_t at);
  void SiftDown(std::size_t at);

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // by index
};

template <typename IndexType>
void EventQueue<IndexType>::Set(IndexType index, Instant key) {
  CORE_CHECK(!index.is_none(), "a queue holds indices of a table");
  if (place_.size() <= index.value()) place_.resize(index.value() + 1, kAbsent);
  std::uint32_t& place = place_[index.value()];
  if (place == kAbsent) {
    heap_.push_back({key, index});
    place = static_cast<std::uint32_t>(heap_.size() - 1);
  } else {
    if (heap_[place].key == key) return;
    heap_[place].key = key;
  }
  SiftUp(place_[index.value()]);
  SiftDown(place_[index.value()]);
}

template <typename IndexType>
void EventQueue<IndexType>::Remove(IndexType index) {
  if (!Contains(index)) return;
  const std::size_t at = place_[index.value()];
  const Entry last = heap_.back();
  heap_.pop_back();
  place_[index.value()] = kAbsent;
  if (at == heap_.size()) return;
  Place(at, last);
  SiftUp(at);
  SiftDown(place_[last.index.value()]);
}

// No entry comes before its parent, so that a walk need not go below an entry that is later than
// `last`. The children of place k are 2k + 1 and 2k + 2: depth first, left child first.
template <typename IndexType>
void EventQueue<IndexType>::UpTo(Instant last, std::vector<IndexType>* indices) const {
  std::size_t at = 0;
  const auto due = [&](std::size_t place) {
    return place < heap_.size() && !(last < heap_[place].key);
  };
  if (!due(0)) return;
  for (;;) {
    indices->push_back(heap_[at].index);
    if (due(2 * at + 1)) {
      at = 2 * at + 1;
      continue;
    }
    if (due(2 * at + 2)) {
      at = 2 * at + 2;
      continue;
    }
    // Up to the first ancestor whose right sibling is still to be visited.
    while (at > 0 && (at % 2 == 0 || !due(at + 1))) at = (at - 1) / 2;
    if (at == 0) return;
    ++at;
  }
}

template <typename IndexType>
void EventQueue<IndexType>::SiftUp(std::size_t at) {
  const Entry entry = heap_[at];
  for (; at > 0 && entry < heap_[(at - 1) / 2]; at = (at - 1) / 2) Place(at, heap_[(at - 1) / 2]);
  Place(at, entry);
}

template <typename IndexType>
void EventQueue<IndexType>::SiftDown(std::size_t at) {
  const Entry entry = heap_[at];
  for (std::size_t child; (child = 2 * at + 1) < heap_.size(); at = child) {
    if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
    if (!(heap_[child] < entry)) break;
    Place(at, heap_[child]);
  }
  Place(at, entry);
}

template <typename IndexType>
void EventQueue<IndexType>::Validate() const {
  for (std::size_t at = 0; at < heap_.size(); ++at) {
    const std::size_t index = heap_[at].index.value();
    CORE_CHECK(index < place_.size() && place_[index] == at, "an entry's place is recorded", at,
               index);
    CORE_CHECK(at == 0 || !(heap_[at] < heap_[(at - 1) / 2]), "no entry comes before its parent",
               at);
  }
  std::size_t placed = 0;
  for (const std::uint32_t place : place_) placed += place != kAbsent;
  CORE_CHECK(placed == heap_.size(), "each recorded place is an entry", placed, heap_.size());
}

}  // namespace collision
