#include "server/world/contenders.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

TEST(Contenders, EachIsToldOnce) {
  Contenders contenders;
  EXPECT_TRUE(contenders.empty());
  EXPECT_TRUE(contenders.Add(1, true));
  EXPECT_FALSE(contenders.Add(1, true));
  EXPECT_TRUE(contenders.Add(2, true));
  contenders.Drop(1);
  EXPECT_FALSE(contenders.empty());
  EXPECT_TRUE(contenders.Add(1, true)) << "another program of this sender";
  contenders.Clear();
  EXPECT_TRUE(contenders.empty());
}

TEST(Contenders, BeyondTheLimitNoneIsRemembered) {
  Contenders contenders;
  for (std::uint64_t sender = 1; sender <= kContendersMax; ++sender) contenders.Add(sender, true);
  EXPECT_FALSE(contenders.Add(kContendersMax, true));
  EXPECT_TRUE(contenders.Add(kContendersMax + 1, true));
  EXPECT_TRUE(contenders.Add(kContendersMax + 1, true));
}

TEST(Contenders, OnlyAHigherRunSucceeds) {
  Contenders contenders;
  EXPECT_TRUE(contenders.Add(1, false));
  EXPECT_FALSE(contenders.has_successor());
  EXPECT_FALSE(contenders.Add(1, true)) << "it has been told";
  EXPECT_TRUE(contenders.has_successor());
  contenders.Drop(1);
  EXPECT_FALSE(contenders.has_successor());
}

}  // namespace
}  // namespace collision::server
