#include "client/library/identity/region_least.h"

#include <algorithm>
#include <limits>

namespace collision::client {
namespace {

const v1::AgentClearance* Find(const v1::Clearance& chunk, const v1::AgentClearance& agent) {
  for (const v1::AgentClearance& other : chunk.agents()) {
    if (other.slot() == agent.slot() && other.generation() == agent.generation()) return &other;
  }
  return nullptr;
}

void TakeLeast(const v1::AgentClearance& other, v1::AgentClearance* least) {
  const auto lower = [least](auto get, auto set, auto value) {
    if (value < (least->*get)()) (least->*set)(value);
  };
  using A = v1::AgentClearance;
  lower(&A::clear_until_ns, &A::set_clear_until_ns, other.clear_until_ns());
  lower(&A::acknowledged_sequence, &A::set_acknowledged_sequence, other.acknowledged_sequence());
  lower(&A::acknowledged_revision, &A::set_acknowledged_revision, other.acknowledged_revision());
  lower(&A::void_from_ns, &A::set_void_from_ns, other.void_from_ns());
  lower(&A::state_wanted_ns, &A::set_state_wanted_ns, other.state_wanted_ns());
  least->set_effective_from_ns(std::max(least->effective_from_ns(), other.effective_from_ns()));
  least->set_not_clear(least->not_clear() || other.not_clear());
  least->set_saturated(least->saturated() || other.saturated());
  least->set_lowerings(least->lowerings() + other.lowerings());
}

}  // namespace

const v1::Clearance& RegionLeast::Take(const v1::Clearance& told,
                                       const std::vector<std::uint32_t>& regions) {
  if (regions.size() <= 1) return told;
  ByRegion& chunk = chunks_[told.chunk()];
  chunk[told.region()] = told;
  least_ = told;
  for (const std::uint32_t region : regions) {
    if (region == told.region()) continue;
    const v1::Clearance& other = chunk[region];
    const bool has_spoken = other.simulator_id() != 0;
    const std::int64_t granted_ns =
        has_spoken ? other.granted_until_ns() : std::numeric_limits<std::int64_t>::min();
    least_.set_granted_until_ns(std::min(least_.granted_until_ns(), granted_ns));
    auto* agents = least_.mutable_agents();
    for (int i = agents->size() - 1; i >= 0; --i) {
      const v1::AgentClearance* of_other = Find(other, agents->Get(i));
      if (of_other != nullptr) {
        TakeLeast(*of_other, agents->Mutable(i));
      } else {
        agents->DeleteSubrange(i, 1);
      }
    }
  }
  return least_;
}

}  // namespace collision::client
