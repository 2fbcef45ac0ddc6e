#include "collision_core/broad_phase/face_sweep/crossing_queue.h"

namespace collision::broad_phase {

void CrossingQueue::Reset(std::uint32_t places) {
  heap_.clear();
  where_.assign(places, kAbsent);
}

void CrossingQueue::Set(std::uint32_t place, std::uint32_t tick) {
  const Event event = static_cast<Event>(tick) << 32 | place;
  const std::uint32_t at = where_[place];
  if (at == kAbsent) {
    heap_.push_back(event);
    Rise(static_cast<std::uint32_t>(heap_.size()) - 1, event);
  } else if (event < heap_[at]) {
    Rise(at, event);
  } else {
    Sink(at, event);
  }
}

void CrossingQueue::Clear(std::uint32_t place) {
  const std::uint32_t at = where_[place];
  if (at == kAbsent) return;
  where_[place] = kAbsent;
  const Event last = heap_.back();
  heap_.pop_back();
  if (at == heap_.size()) return;
  if (at > 0 && last < heap_[(at - 1) / 2]) {
    Rise(at, last);
  } else {
    Sink(at, last);
  }
}

void CrossingQueue::Rise(std::uint32_t at, Event event) {
  while (at > 0) {
    const std::uint32_t parent = (at - 1) / 2;
    if (heap_[parent] <= event) break;
    Store(at, heap_[parent]);
    at = parent;
  }
  Store(at, event);
}

void CrossingQueue::Sink(std::uint32_t at, Event event) {
  for (std::size_t child; (child = 2 * static_cast<std::size_t>(at) + 1) < heap_.size();) {
    if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
    if (event <= heap_[child]) break;
    Store(at, heap_[child]);
    at = static_cast<std::uint32_t>(child);
  }
  Store(at, event);
}

}  // namespace collision::broad_phase
