#include "server/state_demand.h"

#include <numeric>

namespace collision::server {
namespace {

/// Clear for so many temporal resolutions or less: at every step.
constexpr double kStepsBeforeContact = 2;

}  // namespace

Instant StateDemand::WantedAt(const AgentClearance& clearance, Instant stamp, Instant now) const {
  const Instant clear = clearance.clear_until;
  if (clearance.in_contact || clearance.saturated) return now;
  if (clear.is_never()) return Instant::Never();
  if (clear <= AddRoundedDown(now, kStepsBeforeContact * temporal_resolution_)) return now;
  if (clear > AddRoundedDown(now, announce_within_)) {
    return AddRoundedDown(clear, -announce_within_);
  }
  return Instant::FromNanoseconds(std::midpoint(stamp.nanoseconds(), clear.nanoseconds()));
}

}  // namespace collision::server
