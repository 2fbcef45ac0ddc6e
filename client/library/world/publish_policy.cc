#include "client/library/world/publish_policy.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace collision::client {
namespace {

/// An hour [ns]: an agent with a longer period counts as one whose next state comes in an hour.
constexpr std::uint64_t kPeriodMax = 3'600'000'000'000;

/// The clock waits at a jump this long [ns] for the first acknowledgement of an agent.
constexpr std::uint64_t kAnsweredWithin = 1'000'000'000;

/// The difference of two stamps, which fits only in an unsigned number.
std::uint64_t Between(std::int64_t earlier_ns, std::int64_t later_ns) {
  return static_cast<std::uint64_t>(later_ns) - static_cast<std::uint64_t>(earlier_ns);
}

}  // namespace

void OutgoingStates::Stage(const State& state, const MotionBounds& bounds,
                           const PublishPolicy& policy) {
  if (sent_ && state.stamp_ns < sent_->stamp_ns) {
    if (policy.wall_clock) return;
    throw std::invalid_argument("stamp_ns: " + std::to_string(state.stamp_ns) +
                                ", allowed: >= " + std::to_string(sent_->stamp_ns) +
                                ", the stamp of the agent's last state");
  }
  const std::optional<State>& before = staged_ ? staged_ : sent_;
  if (before && state.stamp_ns > before->stamp_ns) {
    period_ns_ =
        static_cast<std::int64_t>(std::min(kPeriodMax, Between(before->stamp_ns, state.stamp_ns)));
  }
  // Of an agent that nobody knows yet only the newest state counts, and of one stamp the last.
  const bool corrects = staged_ && (!sent_ || staged_->stamp_ns >= state.stamp_ns);
  const bool breaks =
      before && !corrects && !state.discontinuity && !MayFollow(bounds, *before, state);
  bool jumps = state.discontinuity;
  if (staged_ && !corrects && (staged_counts_ || breaks)) {
    staged_before_.push_back(*staged_);
    if (staged_before_.size() > kCarriedMax) staged_before_.erase(staged_before_.begin());
  } else if (staged_) {
    jumps = jumps || staged_->discontinuity;
  } else {
    sent_counts_ = sent_counts_ || breaks;
  }
  staged_ = state;
  staged_->discontinuity = jumps;
  staged_counts_ = breaks || (corrects && staged_counts_);
  stands_in_ = policy.on_demand && sent_ && StandsIn(bounds, *sent_, *staged_);
}

void OutgoingStates::StageLast(std::int64_t clock_ns) {
  std::vector<State> reached = std::exchange(staged_before_, {});
  if (staged_) reached.push_back(*staged_);
  std::erase_if(reached, [&](const State& state) { return state.stamp_ns > clock_ns; });
  if (reached.empty()) {
    reached.push_back(*sent_);
    reached.back().discontinuity = false;  // It has been told.
  }
  staged_ = reached.back();
  staged_->expiry_ns = std::min(staged_->expiry_ns.value_or(clock_ns), clock_ns);
  reached.pop_back();
  staged_before_ = std::move(reached);
  stands_in_ = false;
}

bool OutgoingStates::StagedJumps() const {
  return staged_->discontinuity || std::any_of(staged_before_.begin(), staged_before_.end(),
                                               [](const State& one) { return one.discontinuity; });
}

bool OutgoingStates::IsDue(std::int64_t clock_ns, std::uint32_t revision,
                           const PublishPolicy& policy) const {
  const std::int64_t stamp_ns = staged_->stamp_ns;
  if (stamp_ns > clock_ns) return false;
  const bool unacknowledged = must_sequence_ > acknowledged_;
  if (MustBeSent(revision) || unacknowledged || wanted_always_) return true;
  // This is the last chance to send it in time: the next state comes a period later, if at all.
  const std::int64_t next_ns = std::max(clock_ns, stamp_ns + period_ns_);
  std::int64_t wanted_ns = clearance_.state_wanted_ns;
  // The state that was wanted is on its way, and the answer to it tells when the next one is
  // wanted. A simulator that runs ahead of the answer halves its distance to the end of the
  // clearance, as the service would ask it to: the clearance is no earlier than it was.
  if (acknowledged_ < sent_sequence_) {
    wanted_ns = std::midpoint(sent_->stamp_ns, clearance_.clear_until_ns);
  }
  return wanted_ns - policy.lead_ns < next_ns;
}

bool OutgoingStates::MustBeSent(std::uint32_t revision) const {
  return !stands_in_ || !staged_before_.empty() || sent_revision_ != revision;
}

void OutgoingStates::MarkSent(std::uint64_t* sequence, std::uint32_t revision) {
  const bool must_be_sent = MustBeSent(revision);
  // An agent that nobody knows yet may be put elsewhere.
  const bool corrects = sent_ && acknowledged_ == 0 && carried_.empty() && staged_before_.empty() &&
                        staged_->stamp_ns == sent_->stamp_ns;
  const bool is_first = !sent_ || corrects;
  const bool carries = sent_ && !corrects && sent_counts_ && sent_sequence_ > acknowledged_;
  if (carries) Carry(*sent_, sent_sequence_);
  for (const State& state : std::exchange(staged_before_, {})) Carry(state, ++*sequence);
  sent_ = std::exchange(staged_, std::nullopt);
  sent_counts_ = std::exchange(staged_counts_, false) || is_first || sent_->discontinuity;
  sent_sequence_ = ++*sequence;
  sent_revision_ = revision;
  if (must_be_sent) must_sequence_ = sent_sequence_;
}

void OutgoingStates::Carry(const State& state, std::uint64_t sequence) {
  carried_.push_back({state, sequence});
  if (carried_.size() <= kCarriedMax) return;
  // An agent of which nothing is acknowledged begins with its first state.
  const auto oldest = carried_.begin() + (acknowledged_ == 0 ? 1 : 0);
  carried_.erase(oldest)->state.discontinuity = false;
}

std::optional<std::int64_t> OutgoingStates::JumpOnItsWay(std::int64_t clock_ns) const {
  const auto counts = [&](const State& jump) {
    return answered_ || jump.stamp_ns >= clock_ns ||
           Between(jump.stamp_ns, clock_ns) < kAnsweredWithin;
  };
  for (const Carried& carried : carried_) {
    const State& state = carried.state;
    if (state.discontinuity && counts(state)) return state.stamp_ns;
  }
  const bool newest = sent_ && sent_->discontinuity && sent_sequence_ > acknowledged_;
  return newest && counts(*sent_) ? std::optional(sent_->stamp_ns) : std::nullopt;
}

void OutgoingStates::ForgetSent() {
  const std::optional<State> staged = staged_;
  *this = OutgoingStates();
  staged_ = staged;
}

void OutgoingStates::SetClearance(const Clearance& clearance, std::uint64_t acknowledged,
                                  std::int64_t now_ns) {
  clearance_ = clearance;
  wanted_always_ = clearance.state_wanted_ns <= now_ns;
  answered_ = acknowledged > 0;
  acknowledged_ = acknowledged;
  std::erase_if(carried_, [&](const Carried& one) { return one.sequence <= acknowledged; });
}

}  // namespace collision::client
