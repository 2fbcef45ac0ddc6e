// Goal:   the walk of a table's free indices finds one that is listed twice, held, lost or foreign.
// Method: a table of four indices, of which two are held; lists by hand.
#include "collision_core/base/free_list.h"

#include <gtest/gtest.h>

namespace collision {
namespace {

/// Of the indices 0 to 3 the first and the third are held; entries count from 1.
void Walk(const std::vector<std::size_t>& free) {
  ValidateFreeList(
      free, 4, [](std::size_t entry) { return entry - 1; },
      [](std::size_t k) { return k % 2 == 0; });
}

TEST(FreeList, HoldsWhatIsNotHeldInAnyOrder) {
  EXPECT_NO_THROW(Walk({2, 4}));
  EXPECT_NO_THROW(Walk({4, 2}));
}

TEST(FreeList, TellsAnIndexThatIsListedTwice) { EXPECT_THROW(Walk({2, 4, 2}), CheckFailure); }

TEST(FreeList, TellsAnIndexThatIsLost) {
  EXPECT_THROW(Walk({2}), CheckFailure);
  EXPECT_THROW(Walk({2, 2}), CheckFailure) << "as many as are free";
}

TEST(FreeList, TellsAnIndexThatIsHeld) { EXPECT_THROW(Walk({2, 4, 1}), CheckFailure); }

TEST(FreeList, TellsAnIndexBeyondTheTable) {
  EXPECT_THROW(Walk({2, 4, 5}), CheckFailure);
  EXPECT_THROW(Walk({2, 4, 0}), CheckFailure);
}

}  // namespace
}  // namespace collision
