// Goal:   what still comes of a run that the service has ended is refused in words, a higher run is
//         not; the memory is bounded.
// Method: runs ended by hand, up to the limit and one beyond.
#include "server/world/silence/ended_runs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace collision::server {
namespace {

TEST(EndedRuns, ARunAndTheLowerOnesAreRefusedAndAHigherOneIsWelcome) {
  EndedRuns ended;
  EXPECT_EQ(ended.Refusal(1, 5), std::nullopt);
  ended.Add(1, 5, EndCause::kSilent);
  EXPECT_EQ(ended.Refusal(1, 4),
            "run 4; run 5 was removed as silent; allowed: a higher run, which is welcome");
  EXPECT_NE(ended.Refusal(1, 5), std::nullopt);
  EXPECT_EQ(ended.Refusal(1, 6), std::nullopt);
  EXPECT_EQ(ended.Refusal(2, 5), std::nullopt);
}

TEST(EndedRuns, EachCauseHasItsNameAndItsCount) {
  EndedRuns ended;
  ended.Add(1, 5, EndCause::kSilent);
  ended.Add(1, 6, EndCause::kEvicted);
  ended.Add(2, 1, EndCause::kRestarted);
  EXPECT_EQ(ended.Find(1, 5), std::nullopt) << "a higher run was ended since";
  EXPECT_EQ(ended.Find(1, 6), EndCause::kEvicted);
  EXPECT_STREQ(NameOf(EndCause::kSilent), "silent");
  EXPECT_STREQ(NameOf(EndCause::kEvicted), "evicted");
  EXPECT_STREQ(NameOf(EndCause::kRestarted), "restarted");
  EXPECT_EQ(ended.count(EndCause::kSilent), 1u);
  EXPECT_EQ(ended.size(), 2u);
}

TEST(EndedRuns, BeyondTheLimitTheOneEndedFirstIsForgotten) {
  EndedRuns ended;
  for (std::uint64_t id = 0; id < kEndedRunsMax; ++id) ended.Add(id, 1, EndCause::kSilent);
  ended.Add(0, 2, EndCause::kSilent);
  EXPECT_EQ(ended.size(), kEndedRunsMax);
  ended.Add(kEndedRunsMax, 1, EndCause::kSilent);
  EXPECT_EQ(ended.size(), kEndedRunsMax);
  EXPECT_NE(ended.Refusal(0, 2), std::nullopt) << "ended again since";
  EXPECT_EQ(ended.Refusal(1, 1), std::nullopt);
  EXPECT_NE(ended.Refusal(2, 1), std::nullopt);
}

// Goal:   a reader that listens for long enough knows them all, whatever fits into one text.
TEST(EndedRuns, InTurnAllAreTold) {
  EndedRuns ended;
  EXPECT_EQ(ended.TakeTurn(256), "");
  std::vector<EndedRun> all;
  for (std::uint64_t id = 0; id < 20; ++id) {
    all.push_back({.simulator = ~id, .run = 4'000'000'000u, .cause = EndCause(id % 3)});
    ended.Add(all.back().simulator, all.back().run, all.back().cause);
  }
  std::vector<EndedRun> heard;
  while (heard.size() < all.size()) {
    const std::string text = ended.TakeTurn(256);
    ASSERT_LE(text.size(), 256u);
    const std::vector<EndedRun> some = EndedRunsIn(text);
    ASSERT_FALSE(some.empty());
    heard.insert(heard.end(), some.begin(), some.end());
  }
  heard.resize(all.size());
  EXPECT_EQ(heard, all);
  EXPECT_LE(EndedRunsIn(ended.TakeTurn(10'000)).size(), all.size()) << "none twice in one text";
}

TEST(EndedRuns, WhatIsNoEndedRunIsLeftOut) {
  const EndedRun ended{.simulator = 0xab, .run = 7, .cause = EndCause::kEvicted};
  EXPECT_EQ(EndedRunsIn(", x, :, ab, ab:, ab:7, ab:7:, ab:7:eaten, ab:-1:silent, ab:7:silent2,"
                        "ab:7:silent, 00000000000000ab:7:evicted, ab:4294967296:evicted, ab:7"),
            std::vector<EndedRun>{ended});
}

}  // namespace
}  // namespace collision::server
