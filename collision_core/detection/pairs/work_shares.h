// One step's work, shared out among the pairs that are evaluated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace collision::detection {

/// What a pair would use, and its weight relative to the others.
struct WorkClaim {
  std::uint64_t wanted = 0;
  std::uint32_t weight = 1;  ///< 1 to WorkShares::kWeightMax.
};

/// Shares of `total`, one for each claim. No claim gets more than it wants; one that wants more
/// than its share by weight gets at least that share, plus a part of what smaller claims leave. So
/// no pair starves, however much others want. The sum of the shares is at most `total`; if more is
/// wanted, it is `total` less what rounding down loses. Exact and deterministic; O(n log n).
class WorkShares {
 public:
  static constexpr std::uint64_t kTotalMax = std::uint64_t{1} << 40;
  static constexpr std::uint32_t kWeightMax = 255;
  static constexpr std::size_t kClaimsMax = std::size_t{1} << 24;

  /// Requires total <= kTotalMax, weights of 1 to kWeightMax, fewer than kClaimsMax claims: then no
  /// product overflows. The result is valid until the next call.
  const std::vector<std::uint64_t>& Of(const std::vector<WorkClaim>& claims, std::uint64_t total);

 private:
  std::vector<std::uint64_t> shares_;
  std::vector<std::uint32_t> order_;
};

}  // namespace collision::detection
