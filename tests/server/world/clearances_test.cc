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
  std::uint64_t sequence = 7;
  clearances.Publish(2, sequence, now_ns);
  clearances.Acknowledge(6, now_ns + kRepeatAfterNs - 1);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
  now_ns += kRepeatAfterNs;
  clearances.Acknowledge(6, now_ns);
  EXPECT_EQ(clearances.TakeChanged(), (Chunks{0, 2})) << "the grant, too";
  clearances.Acknowledge(6, now_ns + 1);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
  clearances.Publish(2, ++sequence, now_ns);
  clearances.Publish(0, ++sequence, now_ns);
  clearances.Acknowledge(sequence, now_ns + 10 * kRepeatAfterNs);
  EXPECT_EQ(clearances.TakeChanged(), Chunks{});
}

}  // namespace
}  // namespace collision::server
