#include "collision_core/detection/event_queue.h"

#include <algorithm>

namespace collision {

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

// No entry comes before its parent: the next in order is always a child of one that was taken.
void EventQueue::First(std::size_t count, std::vector<std::uint32_t>* first) const {
  first->clear();
  frontier_.clear();
  const auto later = [this](std::uint32_t a, std::uint32_t b) { return heap_[b] < heap_[a]; };
  if (!heap_.empty()) frontier_.push_back(0);
  while (first->size() < count && !frontier_.empty()) {
    std::pop_heap(frontier_.begin(), frontier_.end(), later);
    const std::uint32_t at = frontier_.back();
    frontier_.pop_back();
    first->push_back(heap_[at].index);
    for (std::size_t child = 2 * std::size_t{at} + 1; child <= 2 * std::size_t{at} + 2; ++child) {
      if (child >= heap_.size()) continue;
      frontier_.push_back(static_cast<std::uint32_t>(child));
      std::push_heap(frontier_.begin(), frontier_.end(), later);
    }
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

}  // namespace collision
