#include "collision_core/detection/clearance/keys/coverage_table.h"

#include <algorithm>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// A saturated agent is queried again after at most this share of announce_within, each agent after
/// another part of the share's second half, so that a crowd is not queried in one step.
constexpr double kSaturatedShare = 0.125;
constexpr std::uint32_t kSaturatedTimes = 64;

/// Beyond announce_until by this much [s], so that it is not due before that time has passed.
constexpr double kAfterShare = 1e-9;

/// What an agent may do beyond what is known of it, a second after a state [m/s²].
double UnknownAcceleration(const motion::MotionLimits& limits) {
  constexpr double kSecond = 1;
  return limits.acceleration_max + limits.jerk_max * kSecond;
}

}  // namespace

void CoverageTable::AddAgent(AgentIndex agent) {
  if (!agents_.contains(agent)) agents_.resize(agent.value() + 1);
  agents_[agent] = AgentCoverage();
  agents_[agent].keys.SetAll(Instant::Never());
}

// An agent whose state lies beyond its key is queried at once.
Instant CoverageTable::DueAt(AgentIndex agent) const {
  const Instant key = (*this)[agent].keys.earliest();
  return key < context_.agents[agent].stamp() ? Instant::Always() : key;
}

void CoverageTable::KeysChanged(AgentIndex agent) {
  const AgentCoverage& record = (*this)[agent];
  if (IsSaturated(agent)) {
    due_.Set(agent,
             context_.clock.announce_until());  // something has changed: queried in the next step
    return;
  }
  const bool queried = record.queried_step == context_.clock.step;
  due_.Set(agent, queried ? record.keys.earliest() : DueAt(agent));
  if (lowerable_.Contains(agent)) lowerable_.Set(agent, Reversed(record.keys.comparable()));
  context_.clearances_dirty->Insert(agent);
}

void CoverageTable::LowerKey(AgentIndex agent, AgentIndex partner, Instant when) {
  if (!IsSaturated(agent)) (*this)[agent].keys.Lower(tiers_.BandOf(partner, agent), when);
  KeysChanged(agent);
}

void CoverageTable::Renew(AgentIndex agent, Instant from, ClearanceCause cause) {
  AgentCoverage& record = (*this)[agent];
  if (!record.renewed_from) renewed_.Insert(agent);
  record.renewed_from = std::min(record.renewed_from.value_or(from), from);
  if (record.renewed_cause != ClearanceCause::kBreach) record.renewed_cause = cause;
  lowerable_.Remove(agent);
  voided_.Insert(agent);
  tiers_.Set(agent, UnknownAcceleration(context_.agents[agent].bound().limits));
  if (!IsSaturated(agent)) record.keys.SetAll(std::min(record.keys.earliest(), from));
  KeysChanged(agent);
}

void CoverageTable::StateAdvanced(AgentIndex agent) {
  AgentCoverage& record = (*this)[agent];
  if (record.keys.earliest() >= context_.agents[agent].stamp() || IsSaturated(agent)) return;
  record.queried_step = AgentCoverage::kNeverQueried;
  voided_.Insert(agent);
  due_.Set(agent, DueAt(agent));
}

void CoverageTable::Remove(AgentIndex agent) {
  (*this)[agent].renewed_from.reset();
  due_.Remove(agent);
  lowerable_.Remove(agent);
  voided_.Insert(agent);
  tiers_.Remove(agent);
}

void CoverageTable::Saturate(AgentIndex agent, AgentIndex partner) {
  AgentCoverage& record = (*this)[agent];
  record.crowded_with = partner;
  last_saturated_ = agent;
  last_untracked_ = partner;
  record.keys.SetAll(std::max(context_.clock.now, context_.agents[agent].stamp()));
  lowerable_.Remove(agent);
  context_.clearances_dirty->Insert(agent);
  const double part = static_cast<double>(agent.value() % kSaturatedTimes) / kSaturatedTimes;
  const double rest = kSaturatedShare * context_.clock.announce_within * (1 + part) / 2;
  due_.Set(agent, numeric::AddRoundedUp(
                      numeric::AddRoundedDown(context_.clock.announce_until(), rest), kAfterShare));
  if (saturated_.Insert(agent)) ++context_.counters->saturations;
}

void CoverageTable::MarkLowerable(AgentIndex agent) {
  lowerable_.Set(agent, Reversed((*this)[agent].keys.comparable()));
}

void CoverageTable::ValidateAgent(AgentIndex agent) const {
  const AgentCoverage& record = (*this)[agent];
  const std::uint32_t index = agent.value();
  record.keys.Validate();
  CORE_CHECK(due_.Contains(agent) != context_.agents[agent].expired,
             "an agent is queued for a query unless it has expired", index);
  CORE_CHECK(record.renewed_from.has_value() <= renewed_.Contains(agent),
             "a renewed agent is listed", index);
  if (lowerable_.Contains(agent)) {
    CORE_CHECK(lowerable_.KeyOf(agent) == Reversed(record.keys.comparable()),
               "a settled agent stands at its key", index);
    CORE_CHECK(!record.renewed_from && !IsSaturated(agent), "a settled agent relies on its key",
               index);
  }
  const bool promises =
      !context_.agents[agent].expired && !record.renewed_from && !IsSaturated(agent);
  const Instant key = record.keys.earliest();
  CORE_CHECK(!promises || key > context_.clock.announce_until() || key.is_never(),
             "a key is later than what is announced", index, key.nanoseconds());
}

void CoverageTable::Validate() const {
  due_.Validate();
  lowerable_.Validate();
  renewed_.Validate();
  saturated_.Validate();
  voided_.Validate();
  tiers_.Validate();
  for (AgentIndex agent; agents_.contains(agent); agent = AgentIndex(agent.value() + 1)) {
    if (context_.agents.Contains(agent)) {
      ValidateAgent(agent);
      continue;
    }
    CORE_CHECK(!due_.Contains(agent) && !lowerable_.Contains(agent) && !saturated_.Contains(agent),
               "an agent that has left is in no queue", agent.value());
  }
}

}  // namespace collision::detection
