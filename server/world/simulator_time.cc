#include "server/world/simulator_time.h"

#include <algorithm>

namespace collision::server {

Instant ToldUntil(Instant clock, const std::optional<Instant>& next) {
  if (!next || next->is_never()) return next.value_or(clock);
  return Instant::FromNanoseconds(next->nanoseconds() - 1);
}

SimulatorTime SimulatorTime::After(const SimulatorTime& former, const PendingClock& stands_at) {
  SimulatorTime time;
  time.former_ = {.clock = stands_at.clock, .next = stands_at.next};
  time.Hear(former.heard_, former.heard_until_);
  return time;
}

void SimulatorTime::ForgetFormer() {
  if (newest_ == Instant::Always()) heard_ = heard_until_ = Instant::Always();
  former_.reset();
}

void SimulatorTime::RecordStates(std::uint64_t sequence) {
  states_seen_ = std::max(states_seen_, sequence);
}

void SimulatorTime::RecordDescriptions(std::uint64_t sequence) {
  descriptions_seen_ = std::max(descriptions_seen_, sequence);
}

void SimulatorTime::TakeCensus(std::uint64_t described, std::uint64_t refused) {
  const bool counted = described <= offered_.agents && offered_.agents <= described + refused;
  if (counted && offered_.descriptions_sequence == descriptions_seen_) {
    descriptions_arrived_ = descriptions_seen_;
  }
}

void SimulatorTime::Join(Instant at, bool finishes) {
  Offer({.clock = at, .next = finishes ? Instant::Never() : at, .lock_step = true});
  Grant(at);
  joined_ = awaits_own_clock_ = true;
}

void SimulatorTime::TellPresence(std::uint64_t descriptions_sequence, std::uint32_t agents) {
  offered_.descriptions_sequence = descriptions_sequence;
  offered_.agents = agents;
}

void SimulatorTime::Offer(const PendingClock& offered) {
  awaits_own_clock_ = false;
  offered_ = offered;
  newest_ = std::max(newest_, offered.clock);
  Hear(offered.clock, ToldUntil(offered.clock, offered.next));
  lock_step_ = offered.lock_step;
  other_kind_ = false;
  if (pending_.size() == kPendingClocksMax) pending_.pop_back();
  pending_.push_back(offered);
}

bool SimulatorTime::Take() {
  bool taken = false;
  while (!pending_.empty() && pending_.front().states_sequence <= states_seen_ &&
         pending_.front().descriptions_sequence <= descriptions_seen_) {
    clock_ = pending_.front().clock;
    next_ = pending_.front().next;
    descriptions_told_ = pending_.front().descriptions_sequence;
    pending_.pop_front();
    taken = true;
  }
  if (taken && !first_clock_) first_clock_ = clock_;
  if (taken && !awaits_own_clock_) ForgetFormer();
  return taken;
}

Instant SimulatorTime::told_until() const {
  if (clock_) return ToldUntil(*clock_, next_);
  return former_ ? ToldUntil(former_->clock, former_->next) : Instant::Always();
}

std::optional<Instant> SimulatorTime::stands_at() const {
  if (clock_) return clock_;
  return former_ ? std::optional(former_->clock) : std::nullopt;
}

PendingClock SimulatorTime::standing() const {
  return clock_ ? PendingClock{.clock = *clock_, .next = next_} : *former_;
}

bool SimulatorTime::tells_next() const {
  if (clock_) return next_.has_value();
  return former_ && former_->next.has_value();
}

void SimulatorTime::Restart() {
  newest_ = heard_ = heard_until_ = Instant::Always();
  pending_.clear();
  former_.reset();
  first_clock_.reset();
  clock_.reset();
  next_.reset();
  granted_.reset();
  joined_ = awaits_own_clock_ = false;
}

bool SimulatorTime::Grant(Instant until) {
  const Instant grant = std::max(granted_.value_or(Instant::Always()), until);
  if (granted_ == grant) return false;
  granted_ = grant;
  return true;
}

}  // namespace collision::server
