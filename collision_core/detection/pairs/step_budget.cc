#include "collision_core/detection/pairs/step_budget.h"

#include <algorithm>
#include <numeric>

#include "collision_core/base/check.h"

namespace collision::detection {

void StepBudget::Start(const std::vector<WorkClaim>& claims) {
  CORE_CHECK(is_limited(), "only a limited budget is shared out");
  claims_ = claims;
  next_ = 0;
  left_ = 0;
  const std::uint64_t total = std::min(per_step_, WorkShares::kTotalMax);
  given_ = shares_.Of(claims_, total);
  const std::uint64_t rest =
      total - std::accumulate(given_.begin(), given_.end(), std::uint64_t{0});
  const auto sharing = static_cast<std::uint64_t>(std::count_if(
      claims_.begin(), claims_.end(), [](const WorkClaim& claim) { return claim.wanted > 0; }));
  for (std::size_t i = 0; i < claims_.size(); ++i) {
    if (claims_[i].wanted > 0) given_[i] += rest / sharing;
  }
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
