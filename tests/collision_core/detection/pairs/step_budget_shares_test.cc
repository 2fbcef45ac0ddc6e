// Goal:   a step's budget goes to the pairs that claim work, and what one leaves goes to the next.
// Method: claims by hand, whose shares are known.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/detection/pairs/step_budget.h"

namespace collision::detection {
namespace {

TEST(StepBudgetShares, WhatOnePairLeavesGoesToTheNext) {
  StepBudget budget(100, 90);
  ASSERT_TRUE(budget.is_limited());
  budget.Start({{{.wanted = 45}}, {{.wanted = 0}}, {{.wanted = 45}}});
  EXPECT_EQ(budget.Allowed(), 45u);
  budget.Spent(5);
  EXPECT_EQ(budget.Allowed(), 100u) << "it claims nothing: two balls";
  budget.Spent(1);
  EXPECT_EQ(budget.Allowed(), 85u);
  budget.Spent(200);
  EXPECT_THROW(budget.Allowed(), CheckFailure) << "there was no more claim";
}

TEST(StepBudgetShares, NoPairMaySpendMoreThanOneEvaluation) {
  StepBudget budget(30, 1000);
  budget.Start({{{.wanted = 500}}, {{.wanted = 10}}});
  EXPECT_EQ(budget.Allowed(), 30u);
}

// Three pairs of one owner and one of another, which all want everything.
TEST(StepBudgetShares, OwnersShareFirstThenTheirPairs) {
  StepBudget budget(1000, 120);
  const OwnerId many{7, 1}, one{3, 1};
  budget.Start({{{.wanted = 1000}, many},
                {{.wanted = 1000}, one},
                {{.wanted = 1000}, many},
                {{.wanted = 1000}, many}});
  for (const std::uint64_t share : {20u, 60u, 20u, 20u}) {
    EXPECT_EQ(budget.Allowed(), share);
    budget.Spent(share);
  }
}

TEST(StepBudgetShares, WhatOneOwnerDoesNotClaimGoesToTheOther) {
  StepBudget budget(1000, 120);
  const OwnerId many{7, 1}, one{3, 1};
  budget.Start({{{.wanted = 1000}, many}, {{.wanted = 1000}, many}, {{.wanted = 10}, one}});
  for (const std::uint64_t share : {55u, 55u, 10u}) {
    EXPECT_EQ(budget.Allowed(), share);
    budget.Spent(share);
  }
}

TEST(StepBudgetShares, WhatNobodyClaimsIsThereForWhoeverNeedsMore) {
  StepBudget budget(1000, 120);
  budget.Start({{{.wanted = 10}}, {{.wanted = 20}}});
  EXPECT_EQ(budget.Allowed(), 100u);
  budget.Spent(80);
  EXPECT_EQ(budget.Allowed(), 40u) << "what it claimed is kept for it";
}

TEST(StepBudgetShares, AnUnlimitedBudgetIsNotShared) {
  StepBudget budget(30, 0);
  EXPECT_FALSE(budget.is_limited());
  EXPECT_THROW(budget.Start({}), CheckFailure);
}

// One that may have 40 leaves the other all the rest; what it leaves of the 40 is its own.
TEST(StepBudgetShares, APayerThatIsLimitedGetsNothingOfWhatOthersLeave) {
  StepBudget budget(1000, 120);
  const OwnerId many{7, 1}, one{3, 1};
  const std::vector<PairClaim> claims = {
      {{.wanted = 1000}, many, 40}, {{.wanted = 30}, one}, {{.wanted = 1000}, many, 40}};
  budget.Start(claims);
  EXPECT_EQ(budget.Allowed(), 20u);
  budget.Spent(15);
  EXPECT_EQ(budget.Allowed(), 80u) << "its claim, and what is not claimed";
  budget.Spent(0);
  EXPECT_EQ(budget.Allowed(), 25u);
  budget.Spent(25);
}

}  // namespace
}  // namespace collision::detection
