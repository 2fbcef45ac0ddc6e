// Programs that claim the id of a simulator whose owner lives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace collision::server {

/// Contenders of one simulator that are remembered; each of the others is refused anew with every
/// message, within the limit of rejections per second.
inline constexpr std::size_t kContendersMax = 16;

/// What they write is refused. Each is told so once, since the report of the simulator names the
/// owner as long as that lives; then it writes everything again. One thread.
class Contenders {
 public:
  /// A message of `sender` was refused; `succeeds`: its run is higher than the one in force.
  /// Returns whether the sender must be told.
  bool Add(std::uint64_t sender, bool succeeds) {
    const auto known = senders_.find(sender);
    if (known != senders_.end()) {
      known->second = succeeds;
      return false;
    }
    if (senders_.size() < kContendersMax) senders_.emplace(sender, succeeds);
    return true;
  }

  /// The program has ended.
  void Drop(std::uint64_t sender) { senders_.erase(sender); }

  /// The id has another owner.
  void Clear() { senders_.clear(); }

  bool empty() const { return senders_.empty(); }

  /// One of them takes the id once its owner is gone; others have been replaced, and go on.
  bool has_successor() const {
    return std::any_of(senders_.begin(), senders_.end(),
                       [](const auto& one) { return one.second; });
  }

 private:
  std::map<std::uint64_t, bool> senders_;  ///< Whether each succeeds.
};

}  // namespace collision::server
