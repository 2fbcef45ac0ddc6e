#include "collision_core/detection/event_queue.h"

#include <algorithm>

namespace collision::detection {

void EventQueue::Set(std::uint32_t index, Instant key) {
  if (place_.size() <= index) place_.resize(index + 1, kAbsent);
  if (place_[index] == kAbsent) {
    heap_.push_back({key, index});
    place_[index] = static_cast<std::uint32_t>(heap_.size() - 1);
  } else {
    if (heap_[place_[index]].key == key) return;
    heap_[place_[index]].key = key;
  }
  SiftUp(place_[index]);
  SiftDown(place_[index]);
}

void EventQueue::Remove(std::uint32_t index) {
  if (!Contains(index)) return;
  const std::size_t at = place_[index];
  const Entry last = heap_.back();
  heap_.pop_back();
  place_[index] = kAbsent;
  if (at == heap_.size()) return;
  Place(at, last);
  SiftUp(at);
  SiftDown(place_[last.index]);
}

// No entry comes before its parent. Places of one generation lie side by side, those of the next one
// at twice as far: depth first, leftmost first.
void EventQueue::UpTo(Instant last, std::vector<std::uint32_t>* indices) const {
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
    // Up to where a right-hand sibling is still to be looked at.
    while (at > 0 && (at % 2 == 0 || !due(at + 1))) at = (at - 1) / 2;
    if (at == 0) return;
    ++at;
  }
}

void EventQueue::Place(std::size_t at, const Entry& entry) {
  heap_[at] = entry;
  place_[entry.index] = static_cast<std::uint32_t>(at);
}

void EventQueue::SiftUp(std::size_t at) {
  const Entry entry = heap_[at];
  for (; at > 0 && entry < heap_[(at - 1) / 2]; at = (at - 1) / 2) Place(at, heap_[(at - 1) / 2]);
  Place(at, entry);
}

void EventQueue::SiftDown(std::size_t at) {
  const Entry entry = heap_[at];
  for (std::size_t child; (child = 2 * at + 1) < heap_.size(); at = child) {
    if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
    if (!(heap_[child] < entry)) break;
    Place(at, heap_[child]);
  }
  Place(at, entry);
}

}  // namespace collision::detection
