// Goal:   a simulator waits for a grant as long as there is a reason, and no longer.
// Method: a clock by hand.
#include "client/programs/shared/grant_patience.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

using std::chrono::seconds;

constexpr GrantPatience::Wall kStart{};

TEST(GrantPatience, EndsWithoutAGrantOrAReason) {
  GrantPatience patience(0, kStart);
  EXPECT_TRUE(patience.Lasts(0, false, kStart + kGrantTimeout));
  EXPECT_FALSE(patience.Lasts(0, false, kStart + kGrantTimeout + seconds(1)));
}

TEST(GrantPatience, BeginsAnewWithAGrant) {
  GrantPatience patience(0, kStart);
  EXPECT_TRUE(patience.Lasts(1, false, kStart + seconds(100)));
  EXPECT_TRUE(patience.Lasts(1, false, kStart + seconds(220)));
  EXPECT_FALSE(patience.Lasts(1, false, kStart + seconds(221)));
}

TEST(GrantPatience, LastsWhileTheServiceNamesAReason) {
  GrantPatience patience(0, kStart);
  EXPECT_TRUE(patience.Lasts(0, true, kStart + seconds(3600)));
  EXPECT_TRUE(patience.Lasts(0, false, kStart + seconds(3720)));
  EXPECT_FALSE(patience.Lasts(0, false, kStart + seconds(3721)));
}

}  // namespace
}  // namespace collision::client
