// Until when an agent is certified clear of its partners.
#pragma once

#include <algorithm>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/base/instant.h"
#include "collision_core/detection/clearance/keys/acceleration_tiers.h"

namespace collision::detection {

/// The clearance keys of one agent. A *clearance key* is the time until which the agent is
/// certified clear of all partners that are not tracked: one for each band of its partners
/// (AccelerationTiers::BandOf). The key of the comparable partners holds for each tier that has no
/// earlier one. The keys of a saturated agent promise nothing. O(tiers that have an earlier key).
class ClearanceKeys {
 public:
  /// The earliest of all keys.
  Instant earliest() const { return earliest_; }
  /// The key of the comparable partners; no band has a later one.
  Instant comparable() const { return comparable_; }
  /// The key of one band of partners.
  Instant Of(int band) const {
    for (const TierKey& one : earlier_) {
      if (one.tier == band) return std::min(one.key, comparable_);
    }
    return comparable_;
  }

  /// One key for all bands.
  void SetAll(Instant key) {
    earlier_.clear();
    comparable_ = earliest_ = key;
  }
  /// Sets the key of a tier that is a band of its own; a key later than comparable() counts as
  /// comparable(). Requires a tier other than kComparable.
  void SetTier(int tier, Instant key) {
    CORE_CHECK(tier != AccelerationTiers::kComparable, "a tier is a band of its own", tier);
    std::erase_if(earlier_, [=](const TierKey& one) { return one.tier == tier; });
    if (key < comparable_) earlier_.push_back({key, tier});
    UpdateEarliest();
  }
  /// Lowers the band's key to `key` if it is later.
  void Lower(int band, Instant key) {
    if (band != AccelerationTiers::kComparable) return SetTier(band, std::min(Of(band), key));
    comparable_ = std::min(comparable_, key);
    UpdateEarliest();
  }

  /// Appends the tiers whose own keys are not later than `until`.
  void TiersUpTo(Instant until, std::vector<int>* tiers) const {
    for (const TierKey& one : earlier_) {
      if (one.key <= until) tiers->push_back(one.tier);
    }
  }

  void Validate() const {
    Instant earliest = comparable_;
    for (const TierKey& one : earlier_) earliest = std::min(earliest, one.key);
    CORE_CHECK(earliest == earliest_, "the earliest key is known", earliest.nanoseconds());
  }

 private:
  struct TierKey {
    Instant key;
    int tier;
  };

  void UpdateEarliest() {
    earliest_ = comparable_;
    for (const TierKey& one : earlier_) earliest_ = std::min(earliest_, one.key);
  }

  Instant comparable_ = Instant::Always();
  Instant earliest_ = Instant::Always();
  std::vector<TierKey> earlier_;  // earlier than comparable_ when they were set
};

}  // namespace collision::detection
