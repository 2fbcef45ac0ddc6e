// The owners of tracked pairs, and their pairs that wait to be evaluated.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/detection/pairs/owner_work.h"

namespace collision::detection {

/// A pair whose turn has come, and the owner that pays for its evaluation.
struct PairTurn {
  PairSlot slot;
  OwnerId payer;
  std::uint64_t cost = 0;  ///< As it was expected.
  /// What all pairs of the payer together may spend in this step.
  std::uint64_t payer_units = 0;

  friend auto operator<=>(const PairTurn&, const PairTurn&) = default;
};

/// Gives pairs their turns: first each owner gets its share, then of its pairs those that have
/// waited longest. An owner takes the next turn when it has had less work in this step than any
/// other; so one with thousands of pairs leaves every other its share, and what an owner does not
/// want in a step goes to the others. A pair is evaluated again only after all that its payer had
/// waiting before it: none starves.
///
/// Each owner also has a credit of at most one step's work, which grows by its share of one step's
/// work in each temporal resolution of `now`, and out of which it pays. So one that wants little is
/// served in whatever step it wants something, and one that always wants more than its share gets
/// that and no more, however fast steps follow each other.
///
/// An owner of which some pairs have waited since an earlier step is *held*. It spends no more than
/// a slice in one step, and gives way to the others: in a step in which another owner's pairs want
/// their turn it has none, unless its last slice lies back by twice the time in which it may have
/// one.
///
/// Of the two owners of a pair the one with more tracked pairs pays, or the one with the lower id:
/// a simulator that puts many agents in the way of another one's pays for all these pairs itself.
///
/// Single-threaded and deterministic. All operations are O(log owners), but for Take().
class OwnerQueues {
 public:
  /// Δt [s], and the units of a slice; 0: slices are not limited.
  explicit OwnerQueues(double temporal_resolution, std::uint64_t slice = 0)
      : temporal_resolution_(temporal_resolution), slice_(slice) {}

  /// A pair of agents of these owners is tracked from now on, or no longer. Requires that the slot
  /// is free, or taken.
  void AddPair(PairSlot slot, const OwnerId& a, const OwnerId& b);
  void RemovePair(PairSlot slot);

  /// The pair asks for an evaluation: it waits behind all others of its payer. False: it waits
  /// already, where it was.
  bool Wait(PairSlot slot);
  bool IsWaiting(PairSlot slot) const;
  std::size_t waiting() const { return waiting_; }

  /// Takes the pairs whose turn it is in this step, by slot: as many as `units` pay for at `cost`
  /// each, and at least one if any owner has credit. O(t log(owners) + t log t) for t turns.
  std::vector<PairTurn> Take(std::uint64_t units,
                             const std::function<std::uint64_t(PairSlot)>& cost, Instant now);

  /// The pair was evaluated, which took `units`.
  void RecordEvaluation(const PairTurn& turn, std::uint64_t units);

  /// Who pays for a pair: see above.
  OwnerId PayerOf(PairSlot slot) const;

  /// Of all owners that have tracked pairs, in the order of their ids.
  std::vector<OwnerWork> work() const;

  /// Walks all queues: each waiting pair stands in that of one of its owners.
  void Validate() const;

 private:
  struct Queue {
    OwnerWork work;
    std::uint32_t pairs = 0;  // tracked, of any payer
    double credit = 0;        // [units]; < 0: debt
    Instant credited_at = Instant::Always();
    Instant sliced_at = Instant::Always();  // its last turn while it was held
    PairSlot first = PairSlot::None(), last = PairSlot::None();
  };
  /// A tracked pair; linked into the queue of its payer while it waits.
  struct Entry {
    Queue* a = nullptr;
    Queue* b = nullptr;  // may be the same; null: the slot is free
    Queue* waits_in = nullptr;
    PairSlot previous = PairSlot::None(), next = PairSlot::None();
  };

  Queue* PayerOf(const Entry& entry) const;
  bool IsHeld(const Queue& owner) const { return slice_ > 0 && !owner.work.held_since.is_never(); }
  bool GivesWay(const Queue& owner, std::uint64_t units, Instant now) const;
  void GrowCredit(double units, double owners, Instant now, Queue* owner) const;
  void Unlink(PairSlot slot);
  void Leave(Queue* owner);

  const double temporal_resolution_;
  const std::uint64_t slice_;
  std::map<OwnerId, Queue> owners_;           // with at least one tracked pair
  std::map<OwnerId, Queue*> waiting_owners_;  // with at least one waiting pair
  IndexedVector<PairSlot, Entry> entries_;
  std::size_t waiting_ = 0;
  OwnerId last_turn_{};  // among equals the next owner comes first
};

}  // namespace collision::detection
