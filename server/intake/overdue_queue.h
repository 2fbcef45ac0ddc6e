// Things that are missing, and when to report them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "idl/limits.h"

namespace collision::server {

/// As many as one simulator has slots, so that no simulator alone can fill the queue.
inline constexpr std::size_t kOverdueMax = std::size_t{wire::kSlotMax} + 1;

/// A bounded queue in which every item falls due after the same time, so that the first one in is
/// the first one due. Times are nanoseconds of the monotonic clock. One thread.
template <typename Item>
class OverdueQueue {
 public:
  explicit OverdueQueue(std::int64_t due_after_ns) : due_after_ns_(due_after_ns) {}

  std::size_t size() const { return items_.size(); }

  /// If it is full, the caller reports the item at once.
  bool full() const { return items_.size() >= kOverdueMax; }

  void Add(std::int64_t now_ns, Item item) {
    items_.push_back({now_ns + due_after_ns_, std::move(item)});
  }

  /// Removes and returns the first item that is due; nullopt: none is.
  [[nodiscard]] std::optional<Item> TakeDue(std::int64_t now_ns) {
    if (items_.empty() || items_.front().due_ns > now_ns) return std::nullopt;
    Item item = std::move(items_.front().item);
    items_.pop_front();
    return item;
  }

  /// When the next item falls due; nullopt: the queue is empty.
  std::optional<std::int64_t> next_ns() const {
    return items_.empty() ? std::nullopt : std::optional(items_.front().due_ns);
  }

 private:
  struct Waiting {
    std::int64_t due_ns;
    Item item;
  };

  const std::int64_t due_after_ns_;
  std::deque<Waiting> items_;
};

}  // namespace collision::server
