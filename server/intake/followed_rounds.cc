#include "server/intake/followed_rounds.h"

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

bool IsOf(const v1::Input& input, std::uint64_t simulator) {
  return input.has_simulator_clock() ? input.simulator_clock().simulator_id() == simulator
                                     : input.agent_states().simulator_id() == simulator;
}

}  // namespace

void FollowedRounds::StandBy() {
  world_.StandBy();
  follows_ = true;
}

/// Never(): there are no rounds, or none that is followed.
Instant FollowedRounds::RoundEnd() const {
  const bool in_rounds = world_.RunsInRounds() && world_.granted() != Instant::Always();
  return follows_ && in_rounds ? world_.granted() : Instant::Never();
}

void FollowedRounds::Apply(const v1::Input& input) {
  const Instant time = TimeOf(input);
  const std::size_t bytes = input.ByteSizeLong();
  const bool full = kept_.size() >= kKeptMax || kept_bytes_ + bytes > kKeptBytesMax;
  if (time <= RoundEnd() || full || !IsOfLockStep(input)) return intake_.Apply(input);
  kept_.push_back(input);
  kept_bytes_ += bytes;
  if (!input.has_simulator_clock()) return;
  world_.HearGranted(time);
  intake_.NoteFollower(input.simulator_clock());
}

/// Others have no grant that could be waited for.
bool FollowedRounds::IsOfLockStep(const v1::Input& input) const {
  const Simulator* const simulator =
      world_.Find(input.has_simulator_clock() ? input.simulator_clock().simulator_id()
                                              : input.agent_states().simulator_id());
  return simulator != nullptr && simulator->holds_time() && simulator->time().lock_step();
}

void FollowedRounds::ApplyKept() {
  if (!follows_) return;
  TakeRound();
  intake_.TakeClocks();
  for (const auto& [id, simulator] : world_.simulators()) {
    if (simulator.holds_time() && simulator.time().told_until() < RoundEnd()) TakeToClock(id);
  }
  intake_.TakeClocks();
  follows_ = world_.stands_by() || !kept_.empty();
}

void FollowedRounds::TakeRound() {
  const Instant end = RoundEnd();
  for (v1::Input& input : std::exchange(kept_, {})) {
    if (TimeOf(input) <= end) {
      TakeOut(input);
    } else {
      kept_.push_back(std::move(input));
    }
  }
}

void FollowedRounds::TakeOut(const v1::Input& input) {
  kept_bytes_ -= input.ByteSizeLong();
  intake_.Apply(input);
}

/// Applies what was kept of the simulator up to and with its first clock.
void FollowedRounds::TakeToClock(std::uint64_t simulator) {
  const auto clock = std::find_if(kept_.begin(), kept_.end(), [&](const v1::Input& input) {
    return input.has_simulator_clock() && IsOf(input, simulator);
  });
  if (clock == kept_.end()) return;
  auto taken = static_cast<std::size_t>(clock - kept_.begin()) + 1;
  for (v1::Input& input : std::exchange(kept_, {})) {
    const bool is_before = taken > 0;
    taken -= is_before ? 1 : 0;
    if (is_before && IsOf(input, simulator)) {
      TakeOut(input);
    } else {
      kept_.push_back(std::move(input));
    }
  }
}

void FollowedRounds::Clear() {
  kept_.clear();
  kept_bytes_ = 0;
}

}  // namespace collision::server
