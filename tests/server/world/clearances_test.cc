// Goal:   samples that a simulator has not taken in are published again, and no others; only what a
//         simulator may go without for a while waits.
// Method: clearances, publications and acknowledgements at chosen times.
#include "server/world/clearances.h"

#include <gtest/gtest.h>

#include <vector>

namespace collision::server {
namespace {

using Chunks = std::set<std::uint32_t>;

TEST(Clearances, WhatIsNotTakenInIsPublishedAgainNowAndThen) {
  Clearances clearances;
  clearances.Set(130, {}, false);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{2});
  std::int64_t now_ns = 0;
  clearances.Publish(2, 7, now_ns);
  clearances.Publish(2, 8, now_ns += kRepeatAfterNs - 1);  // something newer does not put it off
  clearances.Acknowledge(0, now_ns, true);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{});
  clearances.Acknowledge(0, ++now_ns, false);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{}) << "nobody can have overwritten it";
  clearances.Acknowledge(0, now_ns, true);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), (Chunks{0, 2})) << "the grant, too";
  clearances.Acknowledge(0, now_ns + kRepeatAfterNs - 1, true);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{}) << "once a second";
  clearances.Publish(2, 9, now_ns);
  clearances.Acknowledge(8, now_ns += kRepeatAfterNs, true);  // it is slow, but takes in
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{});
  clearances.Acknowledge(9, now_ns, true);
  clearances.Acknowledge(9, now_ns += kRepeatAfterNs, true);
  EXPECT_EQ(clearances.TakeChanged(0, 0, {}), Chunks{}) << "it has everything";
}

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

constexpr std::int64_t kWait = 10;
constexpr Instant kSoon = Instant::FromNanoseconds(4);

/// With one clearance, which was published.
Clearances Known(const detection::AgentClearance& clearance) {
  Clearances clearances;
  clearances.Set(5, clearance, false);
  EXPECT_EQ(clearances.TakeChanged(0, kWait, kSoon), Chunks{0}) << "a new one does not wait";
  return clearances;
}

TEST(Clearances, OneThatOnlyRisesWaitsForOthersOfItsChunk) {
  Clearances clearances = Known({.clear_until = At(5)});
  clearances.Set(5, {.clear_until = At(6)}, false);
  EXPECT_EQ(clearances.TakeChanged(100, kWait, kSoon), Chunks{});
  clearances.Set(5, {.clear_until = At(7)}, false);
  EXPECT_EQ(clearances.TakeChanged(109, kWait, kSoon), Chunks{});
  EXPECT_EQ(clearances.TakeChanged(110, kWait, kSoon), Chunks{0})
      << "the first has waited long enough";
  EXPECT_EQ(clearances.TakeChanged(200, kWait, kSoon), Chunks{});
  clearances.Set(5, {.clear_until = At(8)}, false);
  EXPECT_EQ(clearances.TakeChanged(200, 0, kSoon), Chunks{0});
  clearances.Set(5, {.clear_until = At(9)}, false);
  clearances.MarkChanged(6);
  EXPECT_EQ(clearances.TakeChanged(300, kWait, kSoon), Chunks{0});
  EXPECT_EQ(clearances.TakeChanged(400, kWait, kSoon), Chunks{}) << "it went with the other";
}

TEST(Clearances, WhatReadersMustKnowDoesNotWait) {
  const detection::AgentClearance before{
      .clear_until = At(5), .unannounced_until = At(6), .effective_from = At(1)};
  std::vector<detection::AgentClearance> changes(8, before);
  changes[0].clear_until = At(4);
  changes[1].not_clear = true;
  changes[2].in_contact = true;
  changes[3].saturated = true;
  changes[4].unannounced_until = At(5);
  changes[5].effective_from = At(2);
  changes[6].cause = detection::ClearanceCause::kSkew;
  changes[7].unsettled_until = At(9);
  for (detection::AgentClearance& change : changes) {
    Clearances clearances = Known(before);
    clearances.Set(5, change, false);
    EXPECT_EQ(clearances.TakeChanged(0, kWait, kSoon), Chunks{0}) << &change - changes.data();
  }
}

TEST(Clearances, OneThatReadersTakeForExpiringSoonDoesNotWait) {
  for (const bool expires : {false, true}) {
    Clearances clearances = Known({.clear_until = expires ? kSoon : At(5)});
    clearances.Set(5, {.clear_until = At(90)}, false);
    clearances.Set(5, {.clear_until = At(91)}, false);
    EXPECT_EQ(clearances.TakeChanged(0, kWait, kSoon).size(), expires ? 1u : 0u);
  }
  Clearances clearances = Known({.clear_until = At(1), .not_clear = true});
  clearances.Set(5, {.clear_until = At(2), .not_clear = true}, false);
  EXPECT_EQ(clearances.TakeChanged(0, kWait, kSoon), Chunks{}) << "it is not clear all the same";
}

}  // namespace
}  // namespace collision::server
