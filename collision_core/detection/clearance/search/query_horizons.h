// How far ahead a query of the broad phase looks.
#pragma once

#include <algorithm>
#include <array>

#include "collision_core/detection/clearance/keys/acceleration_tiers.h"
#include "collision_core/detection/step/step_clock.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {

/// A query for the next intersection looks up to a horizon and, if there is no intersection, up to
/// a later one: horizon k lies announce_within · kFactor^k ahead of now; beyond kLast there is no
/// limit. As a horn widens with the square of the time, the number of agents that may be met grows
/// with its sixth power, so that one look too far costs more than a few that are too short. The
/// answer is the same bits whatever the horizons.
///
/// Queries begin with the horizon within which half of the last answers lay. There is one for each
/// agent's tier and band of partners, so that queries among agents of comparable accelerations
/// cost the same whether or not a faster one is in the scene.
class QueryHorizons {
 public:
  static constexpr double kFactor = 1.25;
  static constexpr int kLast = 24;

  explicit QueryHorizons(const StepClock& clock) : clock_(clock) {
    for (auto& of_tier : begins_) of_tier.fill(1);
  }

  /// Horizon `step` >= 0; Never() beyond kLast.
  Instant At(int step) const {
    if (step > kLast) return Instant::Never();
    double ahead = clock_.announce_within;
    for (int k = 0; k < step; ++k) ahead *= kFactor;
    return numeric::AddRoundedUp(clock_.now, ahead);
  }

  /// The first horizon of a query for `band` (-1 for kEveryBand) of an agent of `tier`.
  int Begin(int tier, int band) const { return begins_.at(Row(tier)).at(Row(band)); }

  /// Records the time of an answer: moves the first horizon of later queries one step towards it.
  void Record(int tier, int band, Instant when) {
    int& begin = begins_.at(Row(tier)).at(Row(band));
    if (when > At(begin)) {
      begin = std::min(begin + 1, kLast);
    } else if (begin > 1 && when <= At(begin - 1)) {
      --begin;
    }
  }

 private:
  static std::size_t Row(int tier) { return static_cast<std::size_t>(std::max(tier, 0)); }

  const StepClock& clock_;
  std::array<std::array<int, AccelerationTiers::kTiers>, AccelerationTiers::kTiers> begins_{};
};

}  // namespace collision::detection
