#include "server/intake/later_rounds.h"

#include <algorithm>
#include <utility>

namespace collision::server {
namespace {

/// The latest time of which a message tells; Always(): of none.
Instant TimeOf(const v1::Input& input) {
  if (input.has_simulator_clock()) {
    return Instant::FromNanoseconds(input.simulator_clock().clock_ns());
  }
  Instant latest = Instant::Always();
  for (const v1::AgentState& state : input.agent_states().states()) {
    latest = std::max(latest, Instant::FromNanoseconds(state.stamp_ns()));
  }
  return latest;
}

}  // namespace

bool LaterRounds::Keep(const v1::Input& input, Instant end) {
  const Instant time = TimeOf(input);
  if (time <= end || kept_.size() >= kKeptMax) return false;
  if (input.has_simulator_clock()) newest_clock_ = std::max(newest_clock_, time);
  kept_.push_back(input);
  return true;
}

std::vector<v1::Input> LaterRounds::TakeToClock(std::uint64_t simulator) {
  const bool has_clock = std::any_of(kept_.begin(), kept_.end(), [&](const v1::Input& input) {
    return input.simulator_clock().simulator_id() == simulator;
  });
  std::vector<v1::Input> taken;
  if (!has_clock) return taken;
  std::deque<v1::Input> rest;
  bool done = false;
  for (v1::Input& input : kept_) {
    const bool own = input.simulator_clock().simulator_id() == simulator ||
                     input.agent_states().simulator_id() == simulator;
    const bool takes = own && !done;
    done = done || (takes && input.has_simulator_clock());
    if (takes) {
      taken.push_back(std::move(input));
    } else {
      rest.push_back(std::move(input));
    }
  }
  kept_ = std::move(rest);
  return taken;
}

std::vector<v1::Input> LaterRounds::Take(Instant end) {
  std::vector<v1::Input> taken;
  std::deque<v1::Input> rest;
  for (v1::Input& input : kept_) {
    if (TimeOf(input) <= end) {
      taken.push_back(std::move(input));
    } else {
      rest.push_back(std::move(input));
    }
  }
  kept_ = std::move(rest);
  return taken;
}

}  // namespace collision::server
