#include "tests/baselines/lazy_earliest.h"

#include "collision_core/numeric/seconds.h"

namespace collision::baselines {

void LazyEarliest::Ask(std::uint32_t agent, Instant now) {
  ++asked_;
  const Instant until = numeric::AddRoundedDown(now, horizon_);
  const auto meeting = asker_->Ask(agent, now, until);
  // Without one it is asked again when the horizon asked about is over.
  const std::uint32_t partner = meeting ? meeting->partner : agent;
  entries_[agent] = {partner, renewed_[agent], renewed_[partner]};
  queue_.Set(AgentIndex(agent), meeting ? meeting->when : until);
}

std::optional<LazyEarliest::Found> LazyEarliest::Earliest(Instant now) {
  const Instant until = numeric::AddRoundedDown(now, horizon_);
  while (!queue_.empty() && queue_.top_key() <= until) {
    const std::uint32_t agent = queue_.top().value();
    const Entry& entry = entries_[agent];
    const bool fresh = entry.partner != agent && queue_.top_key() >= now &&
                       entry.renewed == renewed_[agent] &&
                       entry.partner_renewed == renewed_[entry.partner];
    if (fresh) return Found{agent, entry.partner, queue_.top_key()};
    // A query just found no partner: its key is `until`; all keys behind it are as late or later.
    if (entry.partner == agent && queue_.top_key() == until) return std::nullopt;
    Ask(agent, now);
  }
  return std::nullopt;
}

}  // namespace collision::baselines
