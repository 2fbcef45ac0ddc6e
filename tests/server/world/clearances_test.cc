// Goal:   samples that a simulator has not taken in are published again, and no others.
// Method: publications and acknowledgements at chosen times.
#include "server/world/clearances.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

using Chunks = std::set<std::uint32_t>;
using Repeats = std::map<std::uint32_t, Instant>;

TEST(Clearances, WhatIsNotTakenInIsPublishedAgainAsItWasNowAndThen) {
  Clearances clearances;
  clearances.Set(130, {});
  EXPECT_EQ(clearances.TakeChanged(), Chunks{2});
  std::int64_t now_ns = 0;
  const Instant first = Instant::FromNanoseconds(500), second = Instant::FromNanoseconds(600);
  const Repeats both = {{0, first}, {2, second}};
  clearances.Publish(0, 6, now_ns, first);
  clearances.Publish(2, 7, now_ns, first);
  // Something newer does not put it off.
  clearances.Publish(2, 8, now_ns += kRepeatAfterNs - 1, second);
  clearances.Acknowledge(0, now_ns);
  EXPECT_EQ(clearances.TakeRepeated(), Repeats{});
  clearances.Acknowledge(0, ++now_ns);
  EXPECT_EQ(clearances.TakeRepeated(), both);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
  clearances.Acknowledge(0, now_ns + kRepeatAfterNs - 1);
  EXPECT_EQ(clearances.TakeRepeated(), Repeats{}) << "once a second";
  clearances.Publish(2, 9, now_ns, second);
  clearances.Acknowledge(8, now_ns += kRepeatAfterNs);  // it is slow, but takes in
  EXPECT_EQ(clearances.TakeRepeated(), Repeats{});
  clearances.Acknowledge(9, now_ns);
  clearances.Acknowledge(9, now_ns += kRepeatAfterNs);
  EXPECT_EQ(clearances.TakeRepeated(), Repeats{}) << "it has everything";
}

}  // namespace
}  // namespace collision::server
