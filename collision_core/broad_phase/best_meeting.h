// The first meeting found so far, and what can still better it.
#pragma once

#include <optional>

#include "collision_core/broad_phase/broad_phase.h"
#include "collision_core/broad_phase/horn_table.h"

namespace collision {

/// Takes pairs in any order, asks the canonical routine only of those that a filter does not rule
/// out, and keeps the first meeting: the answer does not depend on the order.
class BestMeeting {
 public:
  BestMeeting(const HornTable& table, const BroadQuery& query, BroadPhaseWork* work);

  /// An agent is no partner of its own.
  void Offer(std::uint32_t a, std::uint32_t b);

  /// Seconds after `query.from`: later meetings do not count. Shrinks as better ones are found.
  double limit() const { return limit_; }
  const std::optional<PairMeeting>& best() const { return best_; }

 private:
  bool Betters(std::uint32_t lower, std::uint32_t higher) const;
  void Limit(Instant until);

  const HornTable& table_;
  BroadQuery query_;
  BroadPhaseWork* work_;
  std::optional<PairMeeting> best_;
  Instant when_ = Instant::Never();  ///< Of best_.
  double limit_ = kInfinity;
};

/// Whether the filters leave it open that the two meet within `limit` seconds after `from`.
bool MayMeet(const HornTable& table, std::uint32_t a, std::uint32_t b, Instant from, double limit,
             BroadPhaseWork* work);

/// Whether two rows can meet at all: masks, and one of them can move.
inline bool CanMeet(const HornRow& a, const HornRow& b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0 && !(a.still && b.still);
}

}  // namespace collision
