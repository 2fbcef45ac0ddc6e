// Goal:   one step's work is shared out so that no claim starves, none gets more than it wants, and
//         nothing is left over while a claim wants more.
// Method: cases with known shares; random claims against the conditions that define the shares.
#include "collision_core/detection/pairs/work_shares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/random.h"

namespace collision::detection {
namespace {

using Shares = std::vector<std::uint64_t>;

TEST(WorkShares, AreAsComputedByHand) {
  WorkShares shares;
  EXPECT_EQ(shares.Of({}, 100), Shares{});
  EXPECT_EQ(shares.Of({{70, 1}, {10, 1}}, 100), (Shares{70, 10})) << "enough for all";
  EXPECT_EQ(shares.Of({{90, 1}, {90, 1}}, 100), (Shares{50, 50}));
  EXPECT_EQ(shares.Of({{90, 1}, {10, 1}, {90, 1}}, 100), (Shares{45, 10, 45}));
  EXPECT_EQ(shares.Of({{90, 3}, {90, 1}}, 100), (Shares{75, 25}));
  EXPECT_EQ(shares.Of({{20, 3}, {90, 1}}, 100), (Shares{20, 80})) << "what one leaves";
  EXPECT_EQ(shares.Of({{90, 1}, {90, 1}}, 0), (Shares{0, 0}));
  EXPECT_EQ(shares.Of({{~std::uint64_t{0}, 1}}, 100), Shares{100});
}

// Goal:   the conditions of the header, whatever is claimed.
TEST(WorkShares, StarveNoClaimAndWasteNothing) {
  Random random(1);
  WorkShares shares;
  for (int round = 0; round < 2000; ++round) {
    std::vector<WorkClaim> claims(1 + random.Below(40));
    for (WorkClaim& claim : claims) {
      claim.wanted = random.Chance(0.2) ? 0 : random.Below(std::uint64_t{1} << random.Below(40));
      claim.weight = static_cast<std::uint32_t>(1 + random.Below(random.Chance(0.1) ? 200 : 4));
    }
    const std::uint64_t total = random.Below(std::uint64_t{1} << random.Below(40));
    const Shares& given = shares.Of(claims, total);
    std::uint64_t weights = 0, wanted = 0;
    for (const WorkClaim& claim : claims) weights += claim.weight, wanted += claim.wanted;
    const std::uint64_t sum = std::accumulate(given.begin(), given.end(), std::uint64_t{0});
    EXPECT_LE(sum, total);
    for (std::size_t i = 0; i < claims.size(); ++i) {
      EXPECT_LE(given[i], claims[i].wanted);
      EXPECT_GE(given[i], std::min(claims[i].wanted, total * claims[i].weight / weights));
    }
    EXPECT_GE(sum + claims.size() - 1, std::min(wanted, total));
    const Shares first = given;
    EXPECT_EQ(shares.Of(claims, total), first);
  }
}

}  // namespace
}  // namespace collision::detection
