#include "client/library/world/arrival.h"

#include <algorithm>
#include <limits>

namespace collision::client {
namespace {

/// An agent has a shape that has not arrived.
bool LacksShape(const v1::StandingRefusal& refusal) { return refusal.field() == "shape_hash"; }

/// A refusal that is over as soon as everything has been sent again.
bool IsMissing(const v1::StandingRefusal& refusal) {
  return refusal.reason() == v1::REJECTED_NOT_DESCRIBED || LacksShape(refusal);
}

}  // namespace

void Arrival::Wrote(const v1::SimulatorClock& clock, std::uint32_t stated, Time now) {
  written_ = {clock.descriptions_sequence(), clock.states_sequence(), stated, now};
  if (reached_) Await(*written_, now);
}

void Arrival::Await(const Written& written, Time now) {
  awaited_ = written;
  awaited_.at = now;
  reached_ = !IsBehind();
}

bool Arrival::IsBehind() const {
  if (!own_) return true;
  const bool all_described = own_->descriptions_sequence() >= awaited_.descriptions;
  const bool all_stated = own_->states_sequence() >= awaited_.states;
  // Of newer agents the report does not say how many have sent a state.
  const bool same_agents = own_->descriptions_sequence() == awaited_.descriptions;
  if (!all_described || !all_stated) return true;
  if (same_agents && own_->agents_stated() < awaited_.stated) return true;
  return SomethingIsMissing();
}

bool Arrival::SomethingIsMissing() const {
  return own_ && std::any_of(own_->refusals().begin(), own_->refusals().end(), IsMissing);
}

void Arrival::Hear(const v1::SimulatorReport& report, Time now) {
  // A program that does not tell its incarnation is known by its run alone.
  const bool is_own = report.incarnation() == incarnation_ || report.incarnation() == 0;
  if (is_own && report.run() == run_) {
    due_ |= waits();  // What it wrote meanwhile was refused.
    other_.reset();
    own_ = report;
    if (report.ended() == v1::RUN_SILENT) return TakeRunAfter(run_);
    const bool behind = IsBehind();
    if (behind && !reached_) return;
    if (!behind) {
      resend_after_ = kResendAfter;
      refused_ = false;
    }
    if (written_) Await(*written_, now);
  } else if (report.incarnation() != incarnation_) {
    HearOfOther(report);
  }
}

void Arrival::HearOfOther(const v1::SimulatorReport& report) {
  const bool waited = waits();
  other_ = report;
  own_.reset();
  reached_ = false;
  if (report.alive()) return;
  if (report.run() >= run_) TakeRunAfter(report.run());
  due_ |= waited;
}

void Arrival::TakeRunAfter(std::uint32_t run) {
  if (run == std::numeric_limits<std::uint32_t>::max()) return;
  run_ = run + 1;
  due_ = true;
  reached_ = false;
  own_.reset();
}

bool Arrival::TakeDue(Time now) {
  const std::chrono::seconds patience =
      SomethingIsMissing() || refused_ ? resend_after_ : std::max(resend_after_, least_);
  const bool behind = written_ && !reached_ && !waits() && now - awaited_.at >= patience;
  if (!due_ && !behind) return false;
  with_shapes_ =
      due_ || (own_ && std::any_of(own_->refusals().begin(), own_->refusals().end(), LacksShape));
  if (!due_) resend_after_ = std::min(2 * resend_after_, kResendAfterMax);
  due_ = false;
  if (written_) Await(*written_, now);
  return true;
}

std::string OtherText(const std::string& simulator, const Arrival& arrival) {
  if (!arrival.other()) return "";
  if (!arrival.waits()) {
    if (arrival.run() > arrival.other()->run()) return "";
    return "the name \"" + simulator + "\" was used with the highest run there is, " +
           std::to_string(arrival.other()->run()) + ": choose another name";
  }
  return "another program named \"" + simulator + "\" is alive and has the name, in run " +
         std::to_string(arrival.other()->run()) +
         "; this one waits until it has ended: end it, or choose another name";
}

std::string EndText(const std::string& simulator, const Arrival& arrival) {
  switch (arrival.ended()) {
    case v1::RUN_EVICTED:
      return "an operator has evicted \"" + simulator + "\": start it again to come back";
    case v1::RUN_RESTARTED:
      return "an operator has restarted the world's time: start \"" + simulator +
             "\" again to be in it";
    case v1::RUN_REFUSED:
      return "the service refuses \"" + simulator +
             "\": its clock kind, frame or version does not "
             "fit; the refusal says which";
    default:
      return "";
  }
}

}  // namespace collision::client
