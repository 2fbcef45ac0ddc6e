// Goal:   a service waits for each simulator of the one before it, whichever comes first, takes
//         none for another, and can be told not to wait.
// Method: rosters written by hand.
#include "server/world/silence/roster.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

std::vector<JournalledSimulator> Two() {
  return {{.id = 1, .run = 5, .name = "alpha", .granted = Instant::FromNanoseconds(70)},
          {.id = 2, .run = 1, .name = "beta", .granted = {}}};
}

TEST(Roster, NobodyBeforeIsComplete) {
  const Roster roster({});
  EXPECT_TRUE(roster.complete());
  EXPECT_EQ(roster.greatest_grant(), Instant::Always());
}

TEST(Roster, IsCompleteOnceEachIsBackUnderItsRunOrAHigherOne) {
  Roster roster(Two());
  EXPECT_EQ(roster.missing(), (std::vector<std::string>{"alpha", "beta"}));
  roster.Arrive(2, 9);
  roster.Arrive(3, 9);
  EXPECT_EQ(roster.missing(), std::vector<std::string>{"alpha"});
  roster.Arrive(1, 4);
  EXPECT_FALSE(roster.complete()) << "an older run is another program";
  roster.Arrive(1, 5);
  EXPECT_TRUE(roster.complete());
  EXPECT_EQ(roster.greatest_grant(), Instant::FromNanoseconds(70)) << "also once all are back";
}

TEST(Roster, ALowerRunIsRefusedInWordsUntilTheSimulatorIsBack) {
  Roster roster(Two());
  EXPECT_EQ(roster.Refusal(1, 4),
            "run 4; the service before this one served run 5; allowed: run 5 or a higher one");
  EXPECT_EQ(roster.Refusal(1, 5), std::nullopt);
  EXPECT_EQ(roster.Refusal(3, 0), std::nullopt);
  roster.Arrive(1, 5);
  EXPECT_EQ(roster.Refusal(1, 4), std::nullopt) << "from here on its simulator decides";
}

TEST(Roster, GivingUpEndsTheWaiting) {
  Roster roster(Two());
  EXPECT_FALSE(roster.GiveUp("gamma"));
  EXPECT_TRUE(roster.GiveUp("beta"));
  EXPECT_FALSE(roster.GiveUp("beta"));
  EXPECT_EQ(roster.GiveUpAll(), std::vector<std::string>{"alpha"});
  EXPECT_TRUE(roster.complete());
  EXPECT_EQ(roster.greatest_grant(), Instant::FromNanoseconds(70));
  roster.Forget();
  EXPECT_EQ(roster.greatest_grant(), Instant::Always());
}

}  // namespace
}  // namespace collision::server
