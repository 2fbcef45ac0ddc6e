#include "collision_core/detection/pairs/work_shares.h"

#include <algorithm>
#include <numeric>

#include "collision_core/base/check.h"

namespace collision::detection {

// Progressive filling: claims in the order of wanted / weight, each given what it wants or its
// share of what is left by weight. Products stay below 2^48, since claims are cut to the total.
const std::vector<std::uint64_t>& WorkShares::Of(const std::vector<WorkClaim>& claims,
                                                 std::uint64_t total) {
  CORE_CHECK(total <= kTotalMax, "the products of shares fit", static_cast<double>(total));
  CORE_CHECK(claims.size() < kClaimsMax, "the sum of weights fits", claims.size());
  for (const WorkClaim& claim : claims) {
    CORE_CHECK(claim.weight >= 1 && claim.weight <= kWeightMax, "a claim has a weight",
               claim.weight);
  }
  const auto wanted = [&](std::uint32_t i) { return std::min(claims[i].wanted, total); };
  shares_.assign(claims.size(), 0);
  order_.resize(claims.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t of_a = wanted(a) * claims[b].weight, of_b = wanted(b) * claims[a].weight;
    return of_a != of_b ? of_a < of_b : a < b;
  });
  std::uint64_t left = total, weights = 0;
  for (const WorkClaim& claim : claims) weights += claim.weight;
  for (const std::uint32_t i : order_) {
    shares_[i] = std::min(wanted(i), left * claims[i].weight / weights);
    left -= shares_[i];
    weights -= claims[i].weight;
  }
  return shares_;
}

}  // namespace collision::detection
