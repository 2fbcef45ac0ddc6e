#include "server/world/contenders.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

TEST(Contenders, EachIsToldOnce) {
  Contenders contenders;
  EXPECT_TRUE(contenders.empty());
  EXPECT_TRUE(contenders.Add(1));
  EXPECT_FALSE(contenders.Add(1));
  EXPECT_TRUE(contenders.Add(2));
  contenders.Drop(1);
  EXPECT_FALSE(contenders.empty());
  EXPECT_TRUE(contenders.Add(1)) << "another program of this sender";
  contenders.Clear();
  EXPECT_TRUE(contenders.empty());
}

TEST(Contenders, BeyondTheLimitNoneIsRemembered) {
  Contenders contenders;
  for (std::uint64_t sender = 1; sender <= kContendersMax; ++sender) contenders.Add(sender);
  EXPECT_FALSE(contenders.Add(kContendersMax));
  EXPECT_TRUE(contenders.Add(kContendersMax + 1));
  EXPECT_TRUE(contenders.Add(kContendersMax + 1));
}

}  // namespace
}  // namespace collision::server
