// One step's work budget, handed to the pairs that are evaluated.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/detection/events/agent_id.h"
#include "collision_core/detection/pairs/work_shares.h"

namespace collision::detection {

/// What a pair claims, and the owner that pays for it.
struct PairClaim {
  WorkClaim work;
  OwnerId payer{};
  /// What all claims of the payer together may get; the same in each of them.
  std::uint64_t payer_max = WorkShares::kTotalMax;
};

/// Shares out `work_units_per_step` before the first evaluation of a step: first among the owners,
/// each with the same weight, then the share of each among the pairs that it pays for. What nobody
/// claims, and what one pair does not use of its share, is there for the next; but what a pair of a
/// limited payer leaves is there for the payer's own pairs only.
///
/// A pair that claims nothing (two balls, which cost next to nothing) has no share and no limit but
/// that of one evaluation. An evaluation finishes the step that it has begun, so it may overrun its
/// allowance a little (work_budget.h).
class StepBudget {
 public:
  /// Units for one evaluation, and for a whole step (0: no limit).
  StepBudget(std::uint64_t per_evaluation, std::uint64_t per_step)
      : per_evaluation_(per_evaluation), per_step_(per_step) {}

  bool is_limited() const { return per_step_ > 0; }
  /// Units for a whole step. Requires is_limited().
  std::uint64_t per_step() const { return per_step_; }

  /// A step begins: one claim for each pair, in the order of their evaluations. Requires
  /// is_limited().
  void Start(const std::vector<PairClaim>& claims);
  /// What the next pair may spend, and what it spent. The calls alternate, one pair after the
  /// other. Requires a claim for each.
  std::uint64_t Allowed();
  void Spent(std::uint64_t units);

 private:
  bool claims_nothing() const { return claims_[next_].work.wanted == 0; }

  const std::uint64_t per_evaluation_, per_step_;
  WorkShares shares_;
  std::vector<PairClaim> claims_;
  std::vector<std::uint64_t> given_;  // by claim
  std::vector<std::size_t> pool_;     // by claim
  std::size_t next_ = 0;
  /// Of the shares of all pairs so far: first, with what was not claimed, of all payers that are
  /// not limited; then of each that is.
  std::vector<std::uint64_t> left_;
};

}  // namespace collision::detection
