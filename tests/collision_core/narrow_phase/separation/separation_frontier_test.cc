// Goal:   a frontier gives its pairs in the order it was made for, however many there are.
// Method: pairs with known bounds, in batches as a search writes them, beyond the room in place.
#include "collision_core/narrow_phase/separation/separation_frontier.h"

#include <gtest/gtest.h>

#include <vector>

#include "collision_core/base/check.h"

namespace collision::narrow_phase {
namespace {

void TakeBatch(const std::vector<float>& lowers, Frontier* frontier) {
  BallPair* const pairs = frontier->Room(lowers.size());
  for (std::size_t i = 0; i < lowers.size(); ++i) pairs[i] = {lowers[i], 0, 0, 0};
  frontier->Take(lowers.size());
}

TEST(Frontier, NearestFirstIsAscendingWhateverTheBatches) {
  Frontier frontier(FrontierOrder::kNearestFirst);
  TakeBatch({5, 1, 4}, &frontier);
  frontier.Push({3, 0, 0, 0});
  TakeBatch({2, 6}, &frontier);
  EXPECT_EQ(frontier.Least(), 1);
  for (float lower = 1; lower <= 6; ++lower) EXPECT_EQ(frontier.Pop().lower, lower);
  EXPECT_TRUE(frontier.empty());
}

TEST(Frontier, NewestFirstGivesTheNearestOfTheLastBatchNext) {
  Frontier frontier(FrontierOrder::kNewestFirst);
  TakeBatch({1, 9}, &frontier);
  TakeBatch({7, 5, 8}, &frontier);
  EXPECT_EQ(frontier.Least(), 1);
  EXPECT_EQ(frontier.Pop().lower, 5);
  frontier.Pop();
  frontier.Pop();
  EXPECT_EQ(frontier.Pop().lower, 1) << "the batch before waits for its turn";
}

TEST(Frontier, OfEqualBoundsTheFirstBallsComeFirst) {
  Frontier frontier(FrontierOrder::kNearestFirst);
  for (const sphere_tree::BallRef a : {3u, 1u, 2u}) frontier.Push({1, a, 0, 0});
  for (const sphere_tree::BallRef a : {1u, 2u, 3u}) EXPECT_EQ(frontier.Pop().a, a);
}

TEST(Frontier, GrowsBeyondItsRoomInPlace) {
  for (const FrontierOrder order : {FrontierOrder::kNearestFirst, FrontierOrder::kNewestFirst}) {
    Frontier frontier(order);
    constexpr int kPairs = 1000;
    for (int i = 0; i < kPairs; ++i) frontier.Push({static_cast<float>(i), 0, 0, 0});
    EXPECT_EQ(frontier.Least(), 0);
    for (int i = 0; i < kPairs; ++i) {
      const int expected = order == FrontierOrder::kNearestFirst ? i : kPairs - 1 - i;
      ASSERT_EQ(frontier.Pop().lower, static_cast<float>(expected));
    }
    EXPECT_TRUE(frontier.empty());
  }
}

TEST(Frontier, AnEmptyOneHasNothingToPop) {
  Frontier frontier(FrontierOrder::kNearestFirst);
  EXPECT_THROW(frontier.Pop(), CheckFailure);
}

}  // namespace
}  // namespace collision::narrow_phase
