#include "collision_core/detection/pairs/step_budget.h"

#include <algorithm>
#include <map>

#include "collision_core/base/check.h"

namespace collision::detection {

void StepBudget::Start(const std::vector<PairClaim>& claims) {
  CORE_CHECK(is_limited(), "only a limited budget is shared out");
  const std::uint64_t total = std::min(per_step_, WorkShares::kTotalMax);
  claims_ = claims;
  next_ = 0;
  given_.assign(claims.size(), 0);
  pool_.assign(claims.size(), 0);
  left_ = {total};
  std::map<OwnerId, std::vector<std::size_t>> pairs_of;
  for (std::size_t i = 0; i < claims.size(); ++i) pairs_of[claims[i].payer].push_back(i);
  std::vector<WorkClaim> of_owners;
  for (const auto& [owner, pairs] : pairs_of) {
    const std::uint64_t most = std::min(total, claims[pairs.front()].payer_max);
    WorkClaim& claim = of_owners.emplace_back();
    for (const std::size_t i : pairs) {
      claim.wanted = std::min(most, claim.wanted + std::min(most, claims[i].work.wanted));
    }
  }
  const std::vector<std::uint64_t> owner_shares = shares_.Of(of_owners, total);
  auto share = owner_shares.begin();
  for (const auto& [owner, pairs] : pairs_of) {
    std::vector<WorkClaim> of_pairs;
    for (const std::size_t i : pairs) of_pairs.push_back(claims[i].work);
    const bool limited = claims[pairs.front()].payer_max < total;
    if (limited) left_.push_back(0);
    const std::vector<std::uint64_t>& given = shares_.Of(of_pairs, *share++);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      given_[pairs[k]] = given[k];
      left_.front() -= given[k];
      if (limited) pool_[pairs[k]] = left_.size() - 1;
    }
  }
}

std::uint64_t StepBudget::Allowed() {
  CORE_CHECK(next_ < claims_.size(), "each evaluation has a claim", next_, claims_.size());
  if (claims_nothing()) return per_evaluation_;
  std::uint64_t& left = left_[pool_[next_]];
  left += given_[next_];
  return std::min(per_evaluation_, left);
}

void StepBudget::Spent(std::uint64_t units) {
  std::uint64_t& left = left_[pool_[next_]];
  if (!claims_nothing()) left -= std::min(left, units);
  ++next_;
}

}  // namespace collision::detection
