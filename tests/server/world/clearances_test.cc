// Goal:   samples that a simulator has not taken in are published again, and no others.
// Method: publications and acknowledgements at chosen times.
#include "server/world/clearances.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

using Chunks = std::set<std::uint32_t>;

TEST(Clearances, WhatIsNotTakenInIsPublishedAgainNowAndThen) {
  Clearances clearances;
  clearances.Set(130, {});
  EXPECT_EQ(clearances.TakeChanged(), Chunks{2});
  std::int64_t now_ns = 0;
  clearances.Publish(2, 7, now_ns);
  clearances.Publish(2, 8, now_ns += kRepeatAfterNs - 1);  // something newer does not put it off
  clearances.Acknowledge(0, now_ns, true);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
  clearances.Acknowledge(0, ++now_ns, false);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{}) << "nobody can have overwritten it";
  clearances.Acknowledge(0, now_ns, true);
  EXPECT_EQ(clearances.TakeChanged(), (Chunks{0, 2})) << "the grant, too";
  clearances.Acknowledge(0, now_ns + kRepeatAfterNs - 1, true);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{}) << "once a second";
  clearances.Publish(2, 9, now_ns);
  clearances.Acknowledge(8, now_ns += kRepeatAfterNs, true);  // it is slow, but takes in
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
  clearances.Acknowledge(9, now_ns, true);
  clearances.Acknowledge(9, now_ns += kRepeatAfterNs, true);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{}) << "it has everything";
}

}  // namespace
}  // namespace collision::server
