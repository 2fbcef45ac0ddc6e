#include "server/intake/followed_rounds.h"

#include <algorithm>
#include <utility>

namespace collision::server {
namespace {

/// The latest time of which a message tells; Always(): of none.
Instant ToldBy(const v1::Input& input) {
  if (input.has_simulator_clock()) {
    return Instant::FromNanoseconds(input.simulator_clock().clock_ns());
  }
  Instant latest = Instant::Always();
  for (const v1::AgentState& state : input.agent_states().states()) {
    latest = std::max(latest, Instant::FromNanoseconds(state.stamp_ns()));
  }
  return latest;
}

/// Of a message that may be kept; 0: it may not.
std::uint64_t SimulatorOf(const v1::Input& input) {
  switch (input.message_case()) {
    case v1::Input::kAgentStates:
      return input.agent_states().simulator_id();
    case v1::Input::kSimulatorClock:
      return input.simulator_clock().simulator_id();
    case v1::Input::kAgentDescription:
      return input.agent_description().simulator_id();
    case v1::Input::kAgentRemoval:
      return input.agent_removal().simulator_id();
    default:
      return 0;
  }
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

/// A description or a removal is of the time of the last message that was kept before it.
Instant FollowedRounds::TimeOf(const v1::Input& input) const {
  if (!input.has_agent_description() && !input.has_agent_removal()) return ToldBy(input);
  const auto kept = kept_.find(SimulatorOf(input));
  return kept == kept_.end() ? Instant::Always() : kept->second.inputs.back().time;
}

void FollowedRounds::Apply(const v1::Input& input) {
  const Instant time = TimeOf(input);
  Simulator* const simulator = time > RoundEnd() ? FindFollower(input) : nullptr;
  if (simulator == nullptr || !Keep(simulator->id(), time, input)) return intake_.Apply(input);
  if (!input.has_simulator_clock()) return;
  const v1::SimulatorClock& clock = input.simulator_clock();
  const bool tells_next = clock.next_ns() > clock.clock_ns();
  const Instant next = Instant::FromNanoseconds(clock.next_ns());
  world_.HearClock(simulator, time,
                   ToldUntil(time, tells_next ? std::optional(next) : std::nullopt));
  intake_.NoteFollower(clock);
}

/// The simulator in lock-step of which this program speaks; null: there is none. Others have no
/// grant that could be waited for.
Simulator* FollowedRounds::FindFollower(const v1::Input& input) {
  Simulator* const simulator = world_.Find(SimulatorOf(input));
  const bool follows = simulator != nullptr && simulator->sender() == input.sender() &&
                       simulator->holds_time() && simulator->time().clock() &&
                       simulator->time().lock_step();
  return follows ? simulator : nullptr;
}

bool FollowedRounds::Keep(std::uint64_t simulator, Instant time, const v1::Input& input) {
  const std::size_t bytes = input.ByteSizeLong();
  if (count_ >= kKeptMax || bytes_ + bytes > kKeptBytesMax) return false;
  const auto found = kept_.find(simulator);
  if (found != kept_.end() && (found->second.inputs.size() >= kKeptOfOneMax ||
                               found->second.bytes + bytes > kKeptBytesOfOneMax)) {
    return false;
  }
  Kept& kept = kept_[simulator];
  kept.inputs.push_back({time, input});
  kept.bytes += bytes;
  kept.first = std::min(kept.first, time);
  ++count_;
  bytes_ += bytes;
  return true;
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

bool FollowedRounds::SucceedsLast(const v1::Input& input) {
  if (!intake_.SucceedsLast(input)) return false;
  intake_.TakeClocks();
  ApplyKept();
  return intake_.SucceedsLast(input);
}

void FollowedRounds::TakeRound() {
  const Instant end = RoundEnd();
  for (auto& [id, kept] : kept_) {
    if (kept.first > end) continue;
    Take(&kept, [end](const KeptInput& one) { return one.time <= end; });
  }
  std::erase_if(kept_, [](const auto& of_one) { return of_one.second.inputs.empty(); });
}

/// Applies what was kept of the simulator up to and with its first clock.
void FollowedRounds::TakeToClock(std::uint64_t simulator) {
  const auto found = kept_.find(simulator);
  if (found == kept_.end()) return;
  const std::deque<KeptInput>& inputs = found->second.inputs;
  const auto clock = std::find_if(inputs.begin(), inputs.end(), [](const KeptInput& one) {
    return one.input.has_simulator_clock();
  });
  if (clock == inputs.end()) return;
  std::ptrdiff_t left = clock - inputs.begin() + 1;
  Take(&found->second, [&left](const KeptInput&) { return left-- > 0; });
  if (found->second.inputs.empty()) kept_.erase(found);
}

/// Applies those for which `is_taken` is true, asked once of each in their order.
template <typename Predicate>
void FollowedRounds::Take(Kept* kept, const Predicate& is_taken) {
  count_ -= kept->inputs.size();
  bytes_ -= kept->bytes;
  Kept left;
  for (KeptInput& one : kept->inputs) {
    if (is_taken(one)) {
      intake_.Apply(one.input);
      continue;
    }
    left.bytes += one.input.ByteSizeLong();
    left.first = std::min(left.first, one.time);
    left.inputs.push_back(std::move(one));
  }
  *kept = std::move(left);
  count_ += kept->inputs.size();
  bytes_ += kept->bytes;
}

void FollowedRounds::Clear() {
  kept_.clear();
  count_ = bytes_ = 0;
}

}  // namespace collision::server
