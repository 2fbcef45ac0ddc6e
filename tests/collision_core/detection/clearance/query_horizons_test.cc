// Goal:   horizons lie farther and farther ahead, the last has no limit; the first horizon of a
//         query follows the answers of its own tier and band, one step at a time.
// Method: announce_within is 2 s, so that the first horizons are exact: 2, 2.5 and 3.125 s ahead.
#include "collision_core/detection/clearance/search/query_horizons.h"

#include <gtest/gtest.h>

#include "collision_core/detection/clearance/search/clearance_query.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

class QueryHorizonsTest : public testing::Test {
 protected:
  static constexpr int kTier = 5;

  int Begin() const { return horizons_.Begin(kTier, kEveryBand); }
  void Record(double when) { horizons_.Record(kTier, kEveryBand, At(when)); }

  StepClock clock_{.now = At(7), .announce_within = 2};
  QueryHorizons horizons_{clock_};
};

TEST_F(QueryHorizonsTest, EachLiesAQuarterFartherAheadOfNow) {
  EXPECT_EQ(horizons_.At(0), At(9));
  EXPECT_EQ(horizons_.At(1), At(9.5));
  EXPECT_EQ(horizons_.At(2), At(10.125));
  clock_.now = At(8);
  EXPECT_EQ(horizons_.At(1), At(10.5));
}

TEST_F(QueryHorizonsTest, TheLastHasALimitAndNoneBeyondIt) {
  EXPECT_GT(horizons_.At(QueryHorizons::kLast), horizons_.At(QueryHorizons::kLast - 1));
  EXPECT_FALSE(horizons_.At(QueryHorizons::kLast).is_never());
  EXPECT_TRUE(horizons_.At(QueryHorizons::kLast + 1).is_never());
}

TEST_F(QueryHorizonsTest, AQueryBeginsOneStepNearerToEachAnswer) {
  ASSERT_EQ(Begin(), 1);
  Record(1000);
  EXPECT_EQ(Begin(), 2);
  Record(1000);
  EXPECT_EQ(Begin(), 3);
  Record(9.5);
  EXPECT_EQ(Begin(), 2);
}

// An answer between the horizon before and this one needs no other.
TEST_F(QueryHorizonsTest, AnAnswerWithinTheFirstHorizonAloneMovesNothing) {
  Record(1000);
  ASSERT_EQ(Begin(), 2);
  Record(10.125);
  EXPECT_EQ(Begin(), 2);
  Record(9.51);
  EXPECT_EQ(Begin(), 2);
}

TEST_F(QueryHorizonsTest, AQueryBeginsNeitherBeforeTheFirstNorBeyondTheLast) {
  Record(7.1);
  Record(7.1);
  EXPECT_EQ(Begin(), 1);
  for (int k = 0; k < 2 * QueryHorizons::kLast; ++k) {
    horizons_.Record(kTier, kEveryBand, Instant::Never());
  }
  EXPECT_EQ(Begin(), QueryHorizons::kLast);
}

// Queries about all partners, or about the comparable ones, are of one kind.
TEST_F(QueryHorizonsTest, EachTierAndBandFollowsItsOwnAnswers) {
  Record(1000);
  EXPECT_EQ(horizons_.Begin(kTier, AccelerationTiers::kComparable), 2);
  EXPECT_EQ(horizons_.Begin(kTier, kTier + 2), 1);
  EXPECT_EQ(horizons_.Begin(kTier + 1, kEveryBand), 1);
  horizons_.Record(kTier, kTier + 2, At(1000));
  horizons_.Record(kTier, kTier + 2, At(1000));
  EXPECT_EQ(horizons_.Begin(kTier, kTier + 2), 3);
  EXPECT_EQ(Begin(), 2);
}

}  // namespace
}  // namespace collision::detection
