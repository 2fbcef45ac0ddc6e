#include "collision_core/detection/clearance/keys/reported_clearances.h"

#include <algorithm>

namespace collision::detection {
namespace {

bool Same(const AgentClearance& a, const AgentClearance& b) {
  return a.clear_until == b.clear_until && a.not_clear == b.not_clear &&
         a.in_contact == b.in_contact && a.saturated == b.saturated &&
         a.unannounced_until == b.unannounced_until && a.unsettled_until == b.unsettled_until &&
         a.effective_from == b.effective_from;
}

}  // namespace

void ReportedClearances::AddAgent(AgentIndex agent) {
  if (!reports_.contains(agent)) reports_.resize(agent.value() + 1);
  reports_[agent] = Report();
}

void ReportedClearances::SetEffectiveFrom(AgentIndex agent, Instant effective_from) {
  Report& report = reports_.at(agent);
  report.effective_from = std::max(report.effective_from, effective_from);
}

// Records `cause`, `cause_agent` and `void_from` of the argument, unless a breach that voids
// earlier promises is recorded already.
void ReportedClearances::RecordCause(const AgentClearance& cause, Report* report) const {
  if (cause.void_from > report->void_from) return;
  report->cause = cause.cause;
  report->cause_agent = cause.cause_agent;
  report->void_from = cause.void_from;
}

void ReportedClearances::RecordBreach(AgentIndex agent, Instant from) {
  RecordCause({.cause = ClearanceCause::kBreach,
               .cause_agent = context_.agents[agent].id,
               .void_from = from},
              &reports_.at(agent));
}

void ReportedClearances::RecordVoid(AgentIndex agent, AgentIndex culprit, Instant from) {
  RecordCause({.cause = ClearanceCause::kSkew,
               .cause_agent = context_.agents[culprit].id,
               .void_from = from},
              &reports_.at(agent));
  context_.clearances_dirty->Insert(agent);
}

void ReportedClearances::RecordRenewal(AgentIndex agent) {
  const ClearanceCause cause = coverage_[agent].renewed_cause;
  if (cause == ClearanceCause::kBreach) return;
  RecordCause({.cause = cause, .cause_agent = context_.agents[agent].id}, &reports_.at(agent));
}

void ReportedClearances::NotifyPartner(AgentIndex agent, AgentIndex cause) {
  const ClearanceCause why = coverage_[cause].renewed_cause;
  const bool breach = why == ClearanceCause::kBreach;
  RecordCause({.cause = why,
               .cause_agent = context_.agents[cause].id,
               .void_from = breach ? reports_.at(cause).void_from : Instant::Never()},
              &reports_.at(agent));
  context_.clearances_dirty->Insert(agent);
}

AgentClearance ReportedClearances::Of(AgentIndex agent) const {
  const AgentRecord& record = context_.agents[agent];
  const Instant now = context_.clock.now;
  AgentClearance clearance;
  clearance.agent = record.id;
  clearance.effective_from = reports_.at(agent).effective_from;
  clearance.saturated = coverage_.IsSaturated(agent);
  const Instant key = coverage_[agent].keys.earliest();
  const PairExtremes& pairs = pairs_.ExtremesOf(agent);
  clearance.clear_until = std::min(key, pairs.clear_until);
  clearance.unannounced_until = std::min(key, pairs.unannounced_until);
  clearance.unsettled_until = pairs.unsettled_until;
  clearance.in_contact = pairs.contacts > 0;
  if (record.expired) clearance.clear_until = record.bound().state.expiry;
  if (clearance.saturated) clearance.clear_until = std::min(clearance.clear_until, now);
  clearance.not_clear = clearance.clear_until <= now;
  return clearance;
}

std::optional<AgentClearance> ReportedClearances::TakeChange(AgentIndex agent) {
  Report& report = reports_.at(agent);
  AgentClearance clearance = Of(agent);
  const bool lowered = report.last && clearance.clear_until < report.last->clear_until;
  const bool voided = !report.void_from.is_never();
  const bool changed = !report.last || !Same(clearance, *report.last) || voided;
  if (changed) {
    if (!report.last || lowered || voided || report.cause_agent == clearance.agent) {
      clearance.cause = report.cause;
      clearance.cause_agent = report.cause_agent;
      clearance.void_from = report.void_from;
    }
    report.last = clearance;
  }
  report.cause = ClearanceCause::kNone;
  report.cause_agent = AgentId{};
  report.void_from = Instant::Never();
  return changed ? std::optional(clearance) : std::nullopt;
}

// Only agents whose key, pairs or contacts have changed can have another clearance, and the
// saturated ones, whose clearance is always now.
std::vector<AgentClearance> ReportedClearances::TakeChanged() {
  for (const AgentIndex agent : coverage_.saturated()) context_.clearances_dirty->Insert(agent);
  std::vector<AgentIndex> agents;
  for (const AgentIndex agent : *context_.clearances_dirty) {
    if (context_.agents.Contains(agent) && context_.agents[agent].removal == 0) {
      agents.push_back(agent);
    }
  }
  context_.clearances_dirty->Clear();
  std::sort(agents.begin(), agents.end(), [this](AgentIndex a, AgentIndex b) {
    return context_.agents[a].id < context_.agents[b].id;
  });
  std::vector<AgentClearance> changed;
  for (const AgentIndex agent : agents) {
    if (const auto change = TakeChange(agent)) changed.push_back(*change);
  }
  return changed;
}

}  // namespace collision::detection
