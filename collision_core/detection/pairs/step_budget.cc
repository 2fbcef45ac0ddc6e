#include "collision_core/detection/pairs/step_budget.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "collision_core/base/check.h"

namespace collision::detection {

void StepBudget::Start(const std::vector<PairClaim>& claims) {
  CORE_CHECK(is_limited(), "only a limited budget is shared out");
  const std::uint64_t total = std::min(per_step_, WorkShares::kTotalMax);
  claims_ = claims;
  next_ = 0;
  given_.assign(claims.size(), 0);
  std::map<OwnerId, std::vector<std::size_t>> pairs_of;
  for (std::size_t i = 0; i < claims.size(); ++i) pairs_of[claims[i].payer].push_back(i);
  std::vector<WorkClaim> of_owners;
  for (const auto& [owner, pairs] : pairs_of) {
    WorkClaim& claim = of_owners.emplace_back();
    for (const std::size_t i : pairs) {
      claim.wanted = std::min(total, claim.wanted + std::min(total, claims[i].work.wanted));
    }
  }
  const std::vector<std::uint64_t> owner_shares = shares_.Of(of_owners, total);
  auto share = owner_shares.begin();
  for (const auto& [owner, pairs] : pairs_of) {
    std::vector<WorkClaim> of_pairs;
    for (const std::size_t i : pairs) of_pairs.push_back(claims[i].work);
    const std::vector<std::uint64_t>& given = shares_.Of(of_pairs, *share++);
    for (std::size_t k = 0; k < pairs.size(); ++k) given_[pairs[k]] = given[k];
  }
  left_ = total - std::accumulate(given_.begin(), given_.end(), std::uint64_t{0});
}

std::uint64_t StepBudget::Allowed() {
  CORE_CHECK(next_ < claims_.size(), "each evaluation has a claim", next_, claims_.size());
  if (claims_nothing()) return per_evaluation_;
  left_ += given_[next_];
  return std::min(per_evaluation_, left_);
}

void StepBudget::Spent(std::uint64_t units) {
  if (!claims_nothing()) left_ -= std::min(left_, units);
  ++next_;
}

}  // namespace collision::detection
