// One step's work, shared out among the pairs whose turn it is.
#pragma once

#include <cstdint>
#include <vector>

namespace collision::detection {

/// What a pair would use, and how much it matters beside the others.
struct WorkClaim {
  std::uint64_t wanted = 0;
  std::uint32_t weight = 1;  ///< >= 1
};

/// Shares of `total`, one for each claim: nobody gets more than wanted; who wants more than a share
/// by weight gets at least that, and what the modest leave. So nobody starves, however much others
/// want. Together at most `total`; all of it but for rounding down where more is wanted. Exact and
/// deterministic. Requires total <= kTotalMax, weights < 2^8, and fewer than 2^24 claims.
class WorkShares {
 public:
  static constexpr std::uint64_t kTotalMax = std::uint64_t{1} << 40;

  const std::vector<std::uint64_t>& Of(const std::vector<WorkClaim>& claims, std::uint64_t total);

 private:
  std::vector<std::uint64_t> shares_;
  std::vector<std::uint32_t> order_;
};

}  // namespace collision::detection
