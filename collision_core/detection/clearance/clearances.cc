#include "collision_core/detection/clearance/clearances.h"

namespace collision::detection {

Clearances::Clearances(const DetectorOptions& options, const DetectorContext& context,
                       TrackedPairs* pairs)
    : context_(context),
      pairs_(pairs),
      broad_phase_(options.broad_phase),
      former_(std::make_unique<broad_phase::AdaptiveBroadPhase>(), options.agents_max),
      filter_(options.skew),
      coverage_(context),
      reported_(context, *pairs, coverage_),
      queries_(context,
               {.coverage = &coverage_,
                .reported = &reported_,
                .pairs = pairs,
                .broad_phase = &broad_phase_,
                .former = &former_},
               filter_) {}

void Clearances::AddAgent(AgentIndex agent) {
  coverage_.AddAgent(agent);
  reported_.AddAgent(agent);
}

void Clearances::Renew(AgentIndex agent, const Renewal& renewal) {
  const AgentRecord& record = context_.agents[agent];
  if (record.is_half_space()) {
    const bool held = broad_phase_.SetHalfSpace(agent.value(), HalfSpaceOf(record));
    CORE_CHECK(held, "there is room for each half-space that was admitted", agent.value());
    filter_.SetEndless(agent);
  } else {
    const broad_phase::AgentBound wide = record.wide_bound();
    broad_phase_.Set(agent.value(), wide);
    filter_.Set(agent, wide.bound);
  }
  coverage_.Renew(agent, renewal.from, renewal.cause);
  reported_.SetEffectiveFrom(agent, renewal.effective_from);
  reported_.RecordRenewal(agent);
}

void Clearances::NotifyPartners(AgentIndex agent) {
  for (const PairSlot slot : pairs_->table().Of(agent)) {
    reported_.NotifyPartner(pairs_->table()[slot].PartnerOf(agent), agent);
  }
}

void Clearances::Tighten(AgentIndex agent) {
  if (context_.agents[agent].is_half_space()) return;
  const broad_phase::AgentBound wide = context_.agents[agent].wide_bound();
  broad_phase_.Tighten(agent.value(), wide);
  filter_.Set(agent, wide.bound);
}

void Clearances::Remove(AgentIndex agent) {
  broad_phase_.Remove(agent.value());
  coverage_.Remove(agent);
  context_.clearances_dirty->Insert(agent);
}

void Clearances::QueryDueAgents() {
  queries_.QueryDueAgents();
  UpdateCounters();
}

void Clearances::Cover(const std::vector<ReleasedPair>& pairs) {
  for (const ReleasedPair& pair : pairs) {
    coverage_.LowerKey(pair.lower, pair.higher, pair.clear_until);
    coverage_.LowerKey(pair.higher, pair.lower, pair.clear_until);
    coverage_.voided()->Insert(pair.lower);
    coverage_.voided()->Insert(pair.higher);
  }
}

void Clearances::Validate() const {
  coverage_.Validate();
  former_.Validate();
  broad_phase_.Validate();
  std::size_t held = 0;
  for (std::size_t k = 0; k < context_.agents.index_end(); ++k) {
    const AgentIndex agent(k);
    const bool counts = context_.agents.Contains(agent) && !context_.agents[agent].expired;
    const bool endless = broad_phase_.half_spaces().Find(agent.value()) != nullptr;
    CORE_CHECK((broad_phase_.Contains(agent.value()) || endless) == counts,
               "the broad phase holds an agent until it expires", k);
    CORE_CHECK(!counts || endless == context_.agents[agent].is_half_space(),
               "the broad phase holds a half-space as one", k);
    held += counts && !endless;
  }
  CORE_CHECK(broad_phase_.agents() == held, "the broad phase holds no agent that is not there",
             broad_phase_.agents(), held);
}

void Clearances::UpdateCounters() {
  const broad_phase::BroadPhaseWork work = broad_phase_.work();
  DetectorCounters& counters = *context_.counters;
  counters.pair_queries += work.pair_queries - pair_queries_seen_;
  counters.filter_tests = work.filter_tests + queries_.examined();
  counters.broad_units = static_cast<std::uint64_t>(broad_phase_.units());
  counters.method_changes = broad_phase_.changes();
  pair_queries_seen_ = work.pair_queries;
}

}  // namespace collision::detection
