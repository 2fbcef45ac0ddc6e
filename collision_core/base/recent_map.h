// A map that forgets what was not touched for long.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

namespace collision {

/// Remembers at least the `keys_min` keys touched last, and at most twice as many. Two generations:
/// when the newer one is full it takes the place of the earlier one, which is forgotten. O(log n).
/// Deterministic. One thread.
template <class Key, class Value>
class RecentMap {
 public:
  explicit RecentMap(std::size_t keys_min) : keys_min_(keys_min) {}

  /// Null if the key is not remembered. Valid until the next call of another function.
  Value* Find(const Key& key) {
    if (const auto found = newer_.find(key); found != newer_.end()) return &found->second;
    const auto found = earlier_.find(key);
    return found != earlier_.end() ? &found->second : nullptr;
  }

  /// What is remembered under the key, or else a new Value(), which is remembered from now on. The
  /// key counts as touched. Valid as with Find().
  Value& Touch(const Key& key) {
    if (const auto found = newer_.find(key); found != newer_.end()) return found->second;
    auto node = earlier_.extract(key);
    if (newer_.size() >= keys_min_) earlier_ = std::exchange(newer_, {});
    if (!node) return newer_.try_emplace(key).first->second;
    return newer_.insert(std::move(node)).position->second;
  }

  /// Calls `call(const Key&, Value&)` for each, of the earlier generation first and by key.
  template <typename Call>
  void ForEach(const Call& call) {
    for (auto* generation : {&earlier_, &newer_}) {
      for (auto& [key, value] : *generation) call(key, value);
    }
  }

  void Clear() {
    newer_.clear();
    earlier_.clear();
  }

 private:
  std::size_t keys_min_;
  std::map<Key, Value> newer_, earlier_;
};

}  // namespace collision
