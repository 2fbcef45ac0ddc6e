// The next crossing of neighbouring faces.
#pragma once

#include <cstdint>
#include <vector>

namespace collision::broad_phase {

/// A binary heap of events, at most one per place, ordered by tick, then place. It knows where each
/// place's event is, so a new event replaces the old one.
class CrossingQueue {
 public:
  /// Empties it and makes room for `places` places.
  void Reset(std::uint32_t places);

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  std::uint32_t tick() const { return static_cast<std::uint32_t>(heap_.front() >> 32); }
  std::uint32_t place() const { return PlaceOf(heap_.front()); }

  /// Sets or moves the event of `place` to `tick`.
  void Set(std::uint32_t place, std::uint32_t tick);
  /// Removes the event of `place`, if there is one.
  void Clear(std::uint32_t place);

 private:
  using Event = std::uint64_t;  // The tick above, the place below.
  static constexpr std::uint32_t kAbsent = ~0u;

  static std::uint32_t PlaceOf(Event event) { return static_cast<std::uint32_t>(event); }
  void Store(std::uint32_t at, Event event) {
    heap_[at] = event;
    where_[PlaceOf(event)] = at;
  }
  void Rise(std::uint32_t at, Event event);
  void Sink(std::uint32_t at, Event event);

  std::vector<Event> heap_;
  std::vector<std::uint32_t> where_;  // By place: its index in the heap, or kAbsent.
};

}  // namespace collision::broad_phase
