// One step of the detector.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// News may be so late, in units of announce_within, and still find what was known of the time it
/// tells about. Of what came later than that, less is certain.
constexpr double kLateness = 2;

}  // namespace

void Detector::Implementation::Advance(Instant now) {
  now_ = std::max(now_, now);
  ++step_;
  announcer_.Start(now_);
  // First: whoever leaves or expires may have met somebody since the last step.
  AskAll();
  ExpireAll();
  TurnAll();
  ForgetPast();
}

// Whoever leaves goes first, in the order of removal, then the others in the order of their ids.
void Detector::Implementation::ExpireAll() {
  candidates_.clear();
  while (!expiries_.empty() && expiries_.top_key() <= now_) {
    candidates_.push_back(expiries_.top());
    expiries_.Remove(candidates_.back());
  }
  std::sort(candidates_.begin(), candidates_.end(), [this](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t leaving_a = At(a).leaving, leaving_b = At(b).leaving;
    if (leaving_a != leaving_b) return leaving_a - 1 < leaving_b - 1;  // 0 comes last
    return At(a).id < At(b).id;
  });
  for (const std::uint32_t agent : candidates_) {
    if (At(agent).leaving != 0) {
      Leave(agent);
    } else if (!At(agent).expired) {
      Expire(agent, false);
    }
  }
}

// Promises exclude the agent from here on. What is known of its pairs is judged a last time.
void Detector::Implementation::Expire(std::uint32_t agent, bool gone) {
  AgentRecord& record = At(agent);
  const std::vector<std::uint32_t> slots = record.pairs;
  for (const std::uint32_t slot : slots) {
    Turn(slot, options_.work_units_per_turn, true);
    if (pairs_.Contains(slot)) Drop(slot, gone);
  }
  record.expired = true;
  record.renewed_from.reset();
  broad_phase_.Remove(agent);
  queue_.Remove(agent);
  latest_.Remove(agent);
  restlessness_.Remove(agent);
  Touch(agent);
}

void Detector::Implementation::Leave(std::uint32_t agent) {
  if (!At(agent).expired) Expire(agent, true);
  if (At(agent).saturated) Unsaturate(agent);
  pairs_.Forget(agent);
  agents_[agent].reset();
  free_.push_back(agent);
}

// Keeps what is still needed: for pairs that are not judged up to the newest state, and for news
// that may come late, from the agent whose newest state is the oldest.
void Detector::Implementation::ForgetPast() {
  extremes_.Look(changed_.size(), agents_.size(), [this](std::size_t agent) {
    const AgentRecord* record = agents_[agent].get();
    const bool counts = record != nullptr && !record->expired && record->leaving == 0;
    return counts ? &record->bound() : nullptr;
  });
  const Instant late = numeric::AddRoundedDown(now_, -kLateness * options_.announce_within);
  const Instant since = std::max(late, std::min(now_, extremes_.bounds().oldest));
  former_.Forget(numeric::AddRoundedDown(since, -options_.skew));
  for (const std::uint32_t agent : changed_) {
    if (agents_[agent] == nullptr) continue;
    AgentRecord& record = At(agent);
    record.changed = false;
    Instant needed = since;
    for (const std::uint32_t slot : record.pairs) {
      needed = std::min(needed, pairs_[slot].tracker.at());
    }
    record.history.Trim(needed);
  }
  changed_.clear();
}

}  // namespace collision::detection
