// The pairs that may meet soon, or touch.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "collision_core/detection/contact_tracker.h"

namespace collision {

/// One tracked pair. `lower` and `higher` are agent indices, in the order of the agents' ids.
struct PairRecord {
  std::uint32_t lower;
  std::uint32_t higher;
  ContactTracker tracker;  ///< Judged as far as both owners' states reach.
  Instant clear_until;     ///< No contact begins before; the past while undecided.
  /// The canonical earliest intersection from `now` on, as of step `asked`.
  Instant earliest = Instant::Never();
  std::uint64_t asked = 0;
  /// When shapes were last asked how long they stay apart.
  Instant looked_ahead = Instant::Always();
  bool in_contact = false;
  bool announced = false;  ///< `event` is open and was published.
  bool doubted = false;    ///< It tells of a doubt that lies before its contact, and apart from it.
  bool broken = false;     ///< A bound was broken since it was opened: what it told may be void.
  /// A contact, or a doubt, that is heard of but lies after `now`: [from, until].
  Instant ahead_from = Instant::Never();
  Instant ahead_until = Instant::Never();
  CollisionEvent event{};  ///< The last revision published.
  std::uint64_t work = 0;  ///< Segments and instants judged since the contact's number was given.
};

/// Slots are reused in the order in which they were freed, and only after others have been freed
/// since, so that a slot's last sample on the wire stays readable for a while.
class PairTable {
 public:
  /// Freed slots that rest before one of them is reused.
  static constexpr std::size_t kSlotsResting = 1024;

  explicit PairTable(std::uint32_t pairs_max) : pairs_max_(pairs_max) {}

  /// nullopt: `pairs_max` are in use.
  std::optional<std::uint32_t> Add(const PairRecord& pair);
  void Remove(std::uint32_t slot);

  /// The slots in use, in increasing order.
  const std::set<std::uint32_t>& slots() const { return used_; }
  PairRecord& operator[](std::uint32_t slot) { return *pairs_[slot]; }
  const PairRecord& operator[](std::uint32_t slot) const { return *pairs_[slot]; }
  std::size_t size() const { return used_.size(); }

  /// The number of the pair's next contact, from 1; it goes on after the pair was no longer
  /// tracked.
  std::uint32_t NextContact(std::uint32_t lower, std::uint32_t higher);
  /// Forgets the numbers of all pairs of an agent that has left.
  void Forget(std::uint32_t agent);

 private:
  std::uint32_t pairs_max_;
  std::set<std::uint32_t> used_;
  std::vector<std::optional<PairRecord>> pairs_;
  std::deque<std::uint32_t> free_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> contacts_;
};

}  // namespace collision
