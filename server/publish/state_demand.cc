#include "server/publish/state_demand.h"

#include <algorithm>
#include <numeric>

#include "collision_core/numeric/seconds.h"

namespace collision::server {
namespace {

/// An agent that is clear for so many temporal resolutions or less is wanted at every step.
constexpr double kStepsBeforeContact = 2;

/// An intersection T ahead is computed from states of age a with ½M (T + a)² instead of ½M T². Up
/// to this share of announce_within, which makes that 27 % more, no newer state is wanted.
constexpr double kFreshShare = 0.125;

}  // namespace

Instant StateDemand::WantedAt(const detection::AgentClearance& clearance, Instant stamp,
                              Instant now) const {
  const Instant clear = clearance.clear_until;
  if (clearance.in_contact || clearance.saturated) return now;
  if (stamp < clearance.unsettled_until) return now;
  if (clear <= numeric::AddRoundedDown(now, kStepsBeforeContact * temporal_resolution_)) return now;
  const Instant fresh_until = numeric::AddRoundedDown(stamp, kFreshShare * announce_within_);
  if (clear > numeric::AddRoundedDown(now, announce_within_)) {
    return std::max(AnnouncedAt(clear), fresh_until);
  }
  return std::min(Instant::FromNanoseconds(std::midpoint(stamp.nanoseconds(), clear.nanoseconds())),
                  std::max(AnnouncedAt(clearance.unannounced_until), fresh_until));
}

Instant StateDemand::AnnouncedAt(Instant intersection) const {
  return intersection.is_never() ? intersection
                                 : numeric::AddRoundedDown(intersection, -announce_within_);
}

}  // namespace collision::server
