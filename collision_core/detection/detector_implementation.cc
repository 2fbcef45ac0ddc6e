#include "collision_core/detection/detector_implementation.h"

#include <algorithm>

#include "collision_core/detection/agents/declaration_change.h"
#include "collision_core/detection/agents/pair_queries.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// A state may arrive this late, in units of announce_within, and still find everything that was
/// known about the time of its stamp. For later ones, less is certain.
constexpr double kLateness = 2;

/// A half-space stays where it is, whatever its states say.
motion::MotionState AsDeclared(const AgentDeclaration& declaration,
                               const motion::MotionState& told) {
  if (!declaration.half_space) return told;
  return {.stamp = told.stamp, .expiry = told.expiry};
}

}  // namespace

Detector::Implementation::Implementation(const DetectorOptions& options)
    : clock_{.announce_within = options.announce_within},
      agents_({.agents_max = options.agents_max,
               .history_max = options.history_max,
               .skew = options.skew}),
      pairs_(options, {clock_, agents_, &counters_, &clearances_dirty_}),
      clearances_(options, {clock_, agents_, &counters_, &clearances_dirty_}, &pairs_),
      earliest_({clock_, agents_, &counters_, &clearances_dirty_}, &pairs_, &clearances_) {}

bool Detector::Implementation::Admit(const AgentId& id, const AgentDeclaration& declaration,
                                     const motion::MotionState& state, Instant effective_from) {
  const AgentIndex agent = agents_.Admit(id, declaration, state.stamp);
  if (agent.is_none()) return false;
  pairs_.AddAgent(agent);
  clearances_.AddAgent(agent);
  agents_.Store(agent, AsDeclared(declaration, state), Link::kJumped);
  Renew(agent, {state.stamp, ClearanceCause::kAdmission, effective_from});
  return true;
}

UpdateOutcome Detector::Implementation::Update(const AgentId& id, const motion::MotionState& told,
                                               Instant effective_from) {
  const AgentIndex agent = agents_.Find(id);
  if (agent.is_none()) return UpdateOutcome::kUnknown;
  const AgentRecord& record = agents_[agent];
  const motion::MotionState state = AsDeclared(record.declaration, told);
  if (state.stamp < record.stamp()) return UpdateOutcome::kOlder;
  const NextState next{agent, state, effective_from};
  if (record.expired) return Return(next);
  if (state.discontinuity) return Jump(next);
  const auto orientation = record.history.newest().has_shape() ? motion::OrientationUse::kMatters
                                                               : motion::OrientationUse::kIgnored;
  const motion::ContractCheck check = CheckContract(record.bound(), state, orientation);
  switch (check.verdict) {
    case motion::ContractVerdict::kKept:
      return Keep(next, check);
    case motion::ContractVerdict::kWidened:
      ++counters_.widenings;
      agents_.Store(agent, next.state, Link::kFollows);
      Renew(agent, {next.stamp(), ClearanceCause::kWidening, effective_from});
      return UpdateOutcome::kWidened;
    case motion::ContractVerdict::kBreached:
      break;
  }
  return Breach(next, orientation);
}

// The agent had expired: it starts anew.
UpdateOutcome Detector::Implementation::Return(const NextState& next) {
  AgentRecord& record = agents_[next.agent];
  record.expired = false;
  record.admitted_from = next.stamp();
  record.history.Clear();
  clearances_.Readmit(next.agent);
  agents_.Store(next.agent, next.state, Link::kJumped);
  Renew(next.agent, {next.stamp(), ClearanceCause::kAdmission, next.effective_from});
  return UpdateOutcome::kJumped;
}

UpdateOutcome Detector::Implementation::Jump(const NextState& next) {
  ++counters_.jumps;
  const AgentRecord& record = agents_[next.agent];
  const double skew = agents_.skew();
  clearances_.RecordFormerMotion(next.agent, {record.bound(), record.declaration.filter},
                                 numeric::AddRoundedUp(next.stamp(), skew));
  agents_.Store(next.agent, next.state, Link::kJumped);
  // By our clock the jump may have come earlier by the skew.
  const Instant from = numeric::AddRoundedDown(next.stamp(), -skew);
  Renew(next.agent, {from, ClearanceCause::kTeleport, next.effective_from});
  return UpdateOutcome::kJumped;
}

UpdateOutcome Detector::Implementation::Keep(const NextState& next,
                                             const motion::ContractCheck& check) {
  ++counters_.updates_kept;
  AgentRecord& record = agents_[next.agent];
  const bool covered = record.margin.Spend(check, record.bound());
  if (IsNarrower(record.bound().limits, record.declaration.limits)) {
    clearances_.RecordFormerMotion(next.agent, {record.bound(), record.declaration.filter},
                                   next.stamp());
  }
  agents_.Store(next.agent, next.state, Link::kFollows);
  if (!covered) {
    Renew(next.agent, {next.stamp(), ClearanceCause::kWidening, next.effective_from});
    return UpdateOutcome::kKept;
  }
  Tighten(next.agent);
  clearances_.StateAdvanced(next.agent);
  return UpdateOutcome::kKept;
}

UpdateOutcome Detector::Implementation::Breach(const NextState& next,
                                               motion::OrientationUse orientation) {
  ++counters_.breaches;
  const Instant last_honest = agents_[next.agent].stamp();
  last_breach_ = {agents_[next.agent].bound(), next.state, orientation};
  agents_.Store(next.agent, next.state, Link::kBroken);
  clearances_.RecordBreach(next.agent, last_honest);
  Renew(next.agent, {next.stamp(), ClearanceCause::kBreach, next.effective_from});
  pairs_.MarkBroken(next.agent, last_honest);
  return UpdateOutcome::kBreached;
}

motion::BrokenBound Detector::Implementation::ExplainLastBreach() const {
  CORE_CHECK(last_breach_.has_value(), "only a breach is explained");
  return ExplainBreach(last_breach_->before, last_breach_->next, last_breach_->orientation);
}

bool Detector::Implementation::Redeclare(const AgentId& id, const AgentDeclaration& declaration,
                                         Instant effective_from) {
  const AgentIndex agent = agents_.Find(id);
  if (agent.is_none()) return false;
  AgentRecord& record = agents_[agent];
  const BoundChange change = ApplyDeclaration(declaration, &record);
  agents_.MarkChanged(agent);
  if (record.expired) return true;
  if (change == BoundChange::kWidened) {
    ++counters_.widenings;
    Renew(agent, {record.stamp(), ClearanceCause::kWidening, effective_from});
  } else {
    Tighten(agent);
  }
  return true;
}

// The agent stays in the table up to the time at which it has left; its pairs are evaluated up to
// then.
bool Detector::Implementation::Remove(const AgentId& id) {
  const AgentIndex agent = agents_.Find(id);
  if (agent.is_none()) return false;
  agents_.Remove(agent);
  return true;
}

const motion::MotionState* Detector::Implementation::StateOf(const AgentId& id) const {
  const AgentIndex agent = agents_.Find(id);
  if (agent.is_none() || agents_[agent].expired) return nullptr;
  return &agents_[agent].bound().state;
}

void Detector::Implementation::ForEachAgent(
    const std::function<void(const HeldAgent&)>& use) const {
  for (std::size_t k = 0; k < agents_.index_end(); ++k) {
    const AgentIndex agent(k);
    if (!agents_.Contains(agent) || agents_[agent].removal != 0) continue;
    const AgentRecord& record = agents_[agent];
    const History::Sample& newest = record.history.newest();
    AgentDeclaration in_force = record.declaration;
    in_force.limits = newest.bound.limits;
    in_force.shape = newest.shape;
    // A shape that was declared since the newest state is unknown up to the next one. From a ball
    // it is that, too; of one that was awaited it would have arrived.
    const bool is_known_later = record.shape_redeclared && record.declaration.shape != nullptr;
    in_force.shape_awaited = newest.shape_awaited && !is_known_later;
    use({record.id, in_force, record.declaration, newest.bound.state, record.heard_until()});
  }
}

// Each of the others is told of the first agent, in the order of ids, that it can meet.
void Detector::Implementation::VoidOwner(const OwnerId& owner, Instant from) {
  std::vector<AgentIndex> disbelieved, others;
  for (std::size_t k = 0; k < agents_.index_end(); ++k) {
    const AgentIndex agent(k);
    if (!agents_.Contains(agent) || agents_[agent].removal != 0 || agents_[agent].expired) continue;
    (OwnerOf(agents_[agent].id) == owner ? disbelieved : others).push_back(agent);
  }
  std::sort(disbelieved.begin(), disbelieved.end(),
            [this](AgentIndex a, AgentIndex b) { return agents_[a].id < agents_[b].id; });
  for (const AgentIndex agent : disbelieved) Disbelieve(agent, from);
  const PairQueries queries({clock_, agents_, &counters_, &clearances_dirty_});
  for (const AgentIndex agent : others) {
    const auto culprit = std::find_if(disbelieved.begin(), disbelieved.end(),
                                      [&](AgentIndex one) { return queries.MayMeet(one, agent); });
    if (culprit != disbelieved.end()) clearances_.RecordVoid(agent, *culprit, from);
  }
}

void Detector::Implementation::Disbelieve(AgentIndex agent, Instant void_from) {
  clearances_.RecordVoid(agent, agent, void_from);
  pairs_.MarkBroken(agent, agents_[agent].stamp());
  agents_.ExpireAtItsStamp(agent);
}

void Detector::Implementation::Renew(AgentIndex agent, const Renewal& renewal) {
  AgentRecord& record = agents_[agent];
  record.margin = BoundMargin(record.bound());
  agents_.MarkChanged(agent);
  agents_.RecordBound(agent);
  clearances_.Renew(agent, renewal);
  pairs_.RetractFree(agent, renewal.from);
  clearances_.NotifyPartners(agent);
}

void Detector::Implementation::Tighten(AgentIndex agent) {
  agents_.RecordBound(agent);
  clearances_.Tighten(agent);
}

// Agents that leave or expire may have met others since the last step: they are queried first and
// evaluated after that.
void Detector::Implementation::Advance(Instant now, const std::function<void()>& progress) {
  clock_.progress = progress;
  clock_.now = std::max(clock_.now, now);
  ++clock_.step;
  pairs_.StartStep();
  clearances_.QueryDueAgents();
  ExpireAgents();
  pairs_.EvaluateDuePairs();
  clearances_.Cover(pairs_.TakeReleased());
  ForgetPast();
  clock_.progress = nullptr;
#ifndef NDEBUG
  Validate();
#endif
}

void Detector::Implementation::ExpireAgents() {
  for (const AgentIndex agent : agents_.TakeExpired(clock_.now)) {
    if (agents_[agent].removal != 0) {
      Leave(agent);
    } else if (!agents_[agent].expired) {
      Expire(agent, Departure::kUnwatched);
    }
  }
}

// Promises exclude the agent from here on. What is known of its pairs is evaluated a last time.
void Detector::Implementation::Expire(AgentIndex agent, Departure departure) {
  pairs_.EvaluateLastTime(agent, departure);
  agents_.SetExpired(agent);
  clearances_.Remove(agent);
}

void Detector::Implementation::Leave(AgentIndex agent) {
  if (!agents_[agent].expired) Expire(agent, Departure::kRemoved);
  clearances_.Forget(agent);
  pairs_.ForgetAgent(agent);
  agents_.Release(agent);
}

// Keeps what is still needed: for pairs that are not settled up to the newest state, and for news
// that may come late, from the agent whose newest state is the oldest.
void Detector::Implementation::ForgetPast() {
  agents_.UpdateExtremes();
  const Instant late = numeric::AddRoundedDown(clock_.now, -kLateness * clock_.announce_within);
  const Instant since = std::max(late, std::min(clock_.now, agents_.extremes().oldest));
  clearances_.ForgetBefore(numeric::AddRoundedDown(since, -agents_.skew()));
  agents_.EndStep(
      [&](AgentIndex agent) { return std::min(since, pairs_.ExtremesOf(agent).needed_from); });
}

std::optional<AgentClearance> Detector::Implementation::ClearanceOf(const AgentId& id) const {
  const AgentIndex agent = agents_.Find(id);
  if (agent.is_none()) return std::nullopt;
  return clearances_.Of(agent);
}

EarliestAnswer Detector::Implementation::Earliest(std::size_t queries_max) {
  const EarliestAnswer answer = earliest_.Find(queries_max);
  clearances_.UpdateCounters();
  return answer;
}

Detector::Profile Detector::Implementation::DescribeScene() const {
  const broad_phase::AdaptiveBroadPhase& broad_phase = clearances_.broad_phase();
  return {.broad_phase = Name(broad_phase.method()),
          .why = broad_phase.why(),
          .left_out = agents_.profile().LeftOut()};
}

std::size_t Detector::Implementation::queued() const {
  return clearances_.coverage().due().size() + pairs_.queued() + agents_.expiries();
}

void Detector::Implementation::Validate() const {
  agents_.Validate();
  pairs_.Validate();
  clearances_.Validate();
  earliest_.Validate();
  clearances_dirty_.Validate();
}

}  // namespace collision::detection
