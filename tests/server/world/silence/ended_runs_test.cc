// Goal:   what still comes of a run that the service has ended is refused in words, a higher run is
//         not; the memory is bounded.
// Method: runs ended by hand, up to the limit and one beyond.
#include "server/world/silence/ended_runs.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace collision::server
