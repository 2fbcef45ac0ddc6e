// The owners of tracked pairs, and their pairs that wait to be evaluated.
#pragma once

#include <cstdint>
#include <deque>
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
/// Each simulator also has a credit of at most one step's work, which grows by its share of one
/// step's work in each temporal resolution of `now`, and out of which its runs pay. So one that
/// wants little is served in whatever step it wants something, and one that always wants more than
/// its share gets that and no more, however fast steps follow each other. A debt stays when all its
/// pairs are gone: a simulator that leaves and comes back has no fresh credit.
///
/// An owner of which some pairs have waited since an earlier step is *held*. It spends no more than
/// a slice in one step, or what one pair costs, and saves up no more than two slices. It also gives
/// way: in a step with other work, news or another owner's pairs that want their turn, it has no
/// turn, unless its last slice lies back by kGivesWay times the time in which it may have one. So
/// it always gets at least that part of its share.
///
/// Of the two owners of a pair the one with more tracked pairs pays, or the one with the lower id:
/// a simulator that puts many agents in the way of another one's pays for all these pairs itself.
///
/// Single-threaded and deterministic. All operations are O(log owners), but for Take().
class OwnerQueues {
 public:
  /// How long an owner that is held gives way, in slices.
  static constexpr int kGivesWay = 8;
  /// Simulators without pairs whose debts are remembered; beyond, the oldest debt is forgotten.
  static constexpr std::size_t kDebtorsMax = 4096;

  /// Δt [s], and the units of a slice; 0: slices are not limited.
  OwnerQueues(double temporal_resolution, std::uint64_t slice)
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
  /// each, and at least one if any owner has credit and does not give way. `news`: the step also
  /// works on what has arrived. O(t log(owners) + t log t) for t turns.
  std::vector<PairTurn> Take(std::uint64_t units,
                             const std::function<std::uint64_t(PairSlot)>& cost, Instant now,
                             bool news = false);

  /// The pair was evaluated, which took `units`.
  void RecordEvaluation(const PairTurn& turn, std::uint64_t units);

  /// The credit out of which the payer of a pair may have it evaluated without a turn, in a step of
  /// `units`; and what it spent. Requires that the owner has a pair; Charge(): that it had one when
  /// the step began.
  std::uint64_t CreditOf(const OwnerId& payer, std::uint64_t units, Instant now);
  void Charge(const OwnerId& payer, std::uint64_t units);

  /// Who pays for a pair: see above.
  OwnerId PayerOf(PairSlot slot) const;

  /// Of all owners that have tracked pairs, in the order of their ids.
  std::vector<OwnerWork> work() const;

  /// Simulators without pairs whose credit is not full.
  std::size_t debtors() const { return debtors_.size(); }

  /// Walks all queues: each waiting pair stands in that of one of its owners.
  void Validate() const;

 private:
  /// Of one simulator.
  struct Account {
    std::uint32_t owners = 0;  // its runs that have tracked pairs
    double credit = 0;         // [units]; < 0: debt
    Instant credited_at = Instant::Always();
  };
  struct Queue {
    OwnerWork work;
    Account* account = nullptr;
    std::uint32_t pairs = 0;                // tracked, of any payer
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
  double CreditMax(const Queue& owner, std::uint64_t units) const;
  void GrowCredit(double units, double owners, double most, Instant now, Account* account) const;
  void ForgetSettled(double units, Instant now);
  void Unlink(PairSlot slot);
  void Leave(Queue* owner);

  const double temporal_resolution_;
  const std::uint64_t slice_;
  std::map<std::uint64_t, Account> accounts_;  // by simulator
  std::deque<std::uint64_t> debtors_;          // that have lost their last pair, in this order
  std::map<OwnerId, Queue> owners_;            // with at least one tracked pair
  std::map<OwnerId, Queue*> waiting_owners_;   // with at least one waiting pair
  IndexedVector<PairSlot, Entry> entries_;
  std::size_t waiting_ = 0;
  OwnerId last_turn_{};  // among equals the next owner comes first
};

}  // namespace collision::detection
