// Programs that claim the id of a simulator whose owner lives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>

namespace collision::server {

/// Contenders of one simulator that are remembered; each of the others is refused anew with every
/// message, within the limit of rejections per second.
inline constexpr std::size_t kContendersMax = 16;

/// What they write is refused. Each is told so once, since the report of the simulator names the
/// owner as long as that lives; then it writes everything again. One thread.
class Contenders {
 public:
  /// A message of `sender` was refused. Returns whether the sender must be told.
  bool Add(std::uint64_t sender) {
    if (senders_.contains(sender)) return false;
    if (senders_.size() < kContendersMax) senders_.insert(sender);
    return true;
  }

  /// The program has ended.
  void Drop(std::uint64_t sender) { senders_.erase(sender); }

  /// The id has another owner.
  void Clear() { senders_.clear(); }

  bool empty() const { return senders_.empty(); }

 private:
  std::set<std::uint64_t> senders_;
};

}  // namespace collision::server
