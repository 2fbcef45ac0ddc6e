#include "server/state_demand.h"

#include <algorithm>
#include <numeric>

namespace collision::server {
namespace {

/// Clear for so many temporal resolutions or less: at every step.
constexpr double kStepsBeforeContact = 2;

/// Who announces a meeting T ahead from states aged a reckons with ½M (T + a)² instead of ½M T²: up
/// to this share of announce_within, 27 % more, no newer one is asked for.
constexpr double kFreshShare = 0.125;

}  // namespace

Instant StateDemand::WantedAt(const detection::AgentClearance& clearance, Instant stamp,
                              Instant now) const {
  const Instant clear = clearance.clear_until;
  if (clearance.in_contact || clearance.saturated) return now;
  if (stamp < clearance.unsettled_until) return now;
  if (clear <= numeric::AddRoundedDown(now, kStepsBeforeContact * temporal_resolution_)) return now;
  if (clear > numeric::AddRoundedDown(now, announce_within_)) return Announcing(clear);
  const Instant fresh_until = numeric::AddRoundedDown(stamp, kFreshShare * announce_within_);
  return std::min(Instant::FromNanoseconds(std::midpoint(stamp.nanoseconds(), clear.nanoseconds())),
                  std::max(Announcing(clearance.unannounced_until), fresh_until));
}

Instant StateDemand::Announcing(Instant meeting) const {
  return meeting.is_never() ? meeting : numeric::AddRoundedDown(meeting, -announce_within_);
}

}  // namespace collision::server
