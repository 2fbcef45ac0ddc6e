#include "collision_core/detection/event_queue.h"

namespace collision {

void EventQueue::Set(std::uint32_t agent, Instant key) {
  if (place_.size() <= agent) place_.resize(agent + 1, kAbsent);
  if (place_[agent] == kAbsent) {
    heap_.push_back({key, agent});
    place_[agent] = static_cast<std::uint32_t>(heap_.size() - 1);
  } else {
    heap_[place_[agent]].key = key;
  }
  SiftUp(place_[agent]);
  SiftDown(place_[agent]);
}

void EventQueue::Remove(std::uint32_t agent) {
  if (place_.size() <= agent || place_[agent] == kAbsent) return;
  const std::size_t at = place_[agent];
  const Entry last = heap_.back();
  heap_.pop_back();
  place_[agent] = kAbsent;
  if (at == heap_.size()) return;
  Place(at, last);
  SiftUp(at);
  SiftDown(place_[last.agent]);
}

void EventQueue::Place(std::size_t at, const Entry& entry) {
  heap_[at] = entry;
  place_[entry.agent] = static_cast<std::uint32_t>(at);
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
