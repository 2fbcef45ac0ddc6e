// The pairs that may meet soon, or touch.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "collision_core/detection/contact_tracker.h"

namespace collision::detection {

/// More work than any turn may spend.
inline constexpr std::uint64_t kAllWanted = ~std::uint64_t{0};

/// One tracked pair. `lower` and `higher` are agent indices, in the order of the agents' ids.
struct PairRecord {
  std::uint32_t lower;
  std::uint32_t higher;
  ContactTracker tracker;  ///< Judged as far as both owners' states reach.
  Instant clear_until;     ///< No contact begins before; the past while undecided.
  /// The canonical earliest intersection from `now` on, as of step `asked`.
  Instant earliest = Instant::Never();
  std::uint64_t asked = 0;
  std::uint64_t turned = 0;  ///< The step in which it was last judged.
  /// What it can add to the earliest intersection is not earlier; Always(): not computed.
  Instant not_before = Instant::Always();
  /// When shapes were last asked how long they stay apart.
  Instant looked_ahead = Instant::Always();
  /// When nothing is waited for any more that could tell of a contact that has ended.
  Instant settles = Instant::Never();
  /// The end of the last contact, or doubt, that was heard of and is not settled; Always(): none.
  Instant unsettled_until = Instant::Always();
  bool in_contact = false;
  Instant rests_until = Instant::Always();  ///< In contact: without news it goes on until then.
  bool announced = false;                   ///< `event` is open and was published.
  bool doubted = false;  ///< It tells of a doubt that lies before its contact, and apart from it.
  bool broken = false;   ///< A bound was broken since it was opened: what it told may be void.
  /// A contact, or a doubt, that is heard of but lies after `now`: [from, until].
  Instant ahead_from = Instant::Never();
  Instant ahead_until = Instant::Never();
  CollisionEvent event{};            ///< The last revision published.
  std::uint64_t spent = kAllWanted;  ///< In its last turn, if that was enough.
  std::uint64_t work = 0;  ///< Segments and instants judged since the contact's number was given.
};

/// Slots are reused in the order in which they were freed, and only after others have been freed
/// since, so that a slot's last sample on the wire stays readable for a while.
class PairTable {
 public:
  /// Freed slots that rest before one of them is reused.
  static constexpr std::size_t kSlotsResting = 1024;
  /// Partners per agent whose contact numbers are kept one by one.
  static constexpr std::size_t kNumbersPerAgentMax = 1024;

  explicit PairTable(std::uint32_t pairs_max) : pairs_max_(pairs_max) {}

  /// nullopt: `pairs_max` are in use.
  std::optional<std::uint32_t> Add(const PairRecord& pair);
  void Remove(std::uint32_t slot);

  bool Contains(std::uint32_t slot) const {
    return slot < pairs_.size() && pairs_[slot].has_value();
  }
  PairRecord& operator[](std::uint32_t slot) { return *pairs_[slot]; }
  const PairRecord& operator[](std::uint32_t slot) const { return *pairs_[slot]; }
  std::size_t size() const { return size_; }
  std::size_t room() const { return pairs_max_ - size_; }

  /// The number of the pair's next contact, from 1; it goes on after the pair was no longer
  /// tracked. Beyond kNumbersPerAgentMax partners the number of the one longest without a contact is
  /// given up: that pair goes on above every number given up so far, so that none comes twice.
  std::uint32_t NextContact(std::uint32_t lower, std::uint32_t higher);
  /// Forgets the numbers of all pairs of an agent that has left.
  void Forget(std::uint32_t agent);

 private:
  struct Number {
    std::uint32_t partner;
    std::uint32_t last;
  };
  /// The numbers of one agent's pairs, each kept with both agents; the latest contact stands last.
  struct Numbers {
    std::vector<Number> known;
    std::uint32_t given_up = 0;  ///< No number given up was higher.
  };

  std::uint32_t TakeNumber(std::uint32_t agent, std::uint32_t partner);
  void KeepNumber(std::uint32_t agent, std::uint32_t partner, std::uint32_t number);

  std::uint32_t pairs_max_;
  std::vector<std::optional<PairRecord>> pairs_;
  std::size_t size_ = 0;
  std::deque<std::uint32_t> free_;
  std::vector<Numbers> numbers_;  // by agent
};

}  // namespace collision::detection
