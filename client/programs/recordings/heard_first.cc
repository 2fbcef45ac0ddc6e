#include "client/programs/recordings/heard_first.h"

#include <algorithm>
#include <iterator>

#include "idl/limits.h"

namespace collision::client {

void HeardFirst::Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) {
  Arrivals more;
  inner_->Receive(timeout, &more);
  hear_(more);
  std::ranges::move(more.outputs, std::back_inserter(arrivals->outputs));
  std::ranges::move(more.inputs, std::back_inserter(arrivals->inputs));
}

bool TakingTimes::AreStatesDue(const Arrivals& arrivals) {
  std::int64_t newest_ns = kNever;
  for (const v1::Input& input : arrivals.inputs) {
    for (const v1::AgentState& state : input.agent_states().states()) {
      if (state.stamp_ns() <= wire::kInstantMax) {
        newest_ns = std::max(newest_ns, state.stamp_ns());
      }
    }
  }
  if (newest_ns < -wire::kInstantMax) return false;
  newest_ns_ = std::max(newest_ns_, newest_ns);
  if (newest_ns < states_due_ns_) return false;
  states_due_ns_ = newest_ns + period_ns_;
  return true;
}

void TakingTimes::Taken(std::int64_t now_ns) {
  const std::int64_t ahead_ns = std::clamp(newest_ns_, now_ns, now_ns + kAheadMaxNs);
  due_ns_ = ahead_ns + period_ns_;
  if (newest_ns_ != kNever) states_due_ns_ = newest_ns_ + period_ns_;
}

void TakingTimes::BeginAnew() { due_ns_ = states_due_ns_ = newest_ns_ = kNever; }

}  // namespace collision::client
