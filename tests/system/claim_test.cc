// Goal:   a world has one service, whoever starts how many, and what a restarted one must remember
//         it does.
// Method: several daemons with one configuration, with and without a common state folder.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

constexpr int kOccupied = 75;

TEST(Claim, BesideALiveServiceASecondOneEndsAndSaysWhy) {
  TestWorld world(71, "simulators_awaited: 2", "claim_wait_s: 5\n");
  const auto daemon = world.StartDaemon();
  world.SetStateFolder("");
  const auto second = world.LaunchDaemon();
  EXPECT_EQ(second->WaitForExit(), kOccupied);
  EXPECT_TRUE(Contains(second->err(), "term 1 serves this world")) << second->err();
  // The first one has noticed nothing: both simulators fly to their end.
  const auto left = world.StartSimulator(kLeft);
  const auto right = world.StartSimulator(kRight);
  EXPECT_EQ(left->WaitForExit(), 0) << left->err() << daemon->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon->err();
}

TEST(Claim, WithTheStateFolderInUseItEndsAtOnce) {
  const TestWorld world(72);
  const auto daemon = world.StartDaemon();
  const auto second = world.LaunchDaemon();
  EXPECT_EQ(second->WaitForExit(), kOccupied);
  EXPECT_TRUE(Contains(second->err(), ".72.journal: in use: another collisiond serves this world"))
      << second->err();
}

TEST(Claim, OfThreeThatStartTogetherOneServes) {
  TestWorld world(73, "simulators_awaited: 2", "claim_wait_s: 5\n");
  world.SetStateFolder("");
  std::unique_ptr<Process> daemons[3];
  for (auto& daemon : daemons) daemon = world.LaunchDaemon();
  int serving = 0;
  for (const auto& daemon : daemons) {
    // Either it serves, or it ends.
    if (daemon->WaitForOutput("serves world \"")) {
      ++serving;
    } else {
      EXPECT_EQ(daemon->WaitForExit(), kOccupied) << daemon->err();
    }
  }
  EXPECT_EQ(serving, 1);
}

TEST(Claim, ATermIsHigherThanTheOneBeforeTheCrash) {
  const TestWorld world(74);
  for (int term = 1; term <= 3; ++term) {
    const auto daemon = world.StartDaemon();
    EXPECT_TRUE(Contains(daemon->err(), "in term " + std::to_string(term))) << daemon->err();
    daemon->Signal(SIGKILL);
    ASSERT_EQ(daemon->WaitForExit(), 128 + SIGKILL);
  }
}

TEST(Claim, AStateFolderThatCannotBeUsedIsTold) {
  TestWorld world(75);
  world.SetStateFolder(world.folder().Write("notes", "somebody's") + "/state");
  const auto daemon = world.StartDaemon();
  EXPECT_TRUE(Contains(daemon->err(), "/notes/state: cannot be made: ")) << daemon->err();
  EXPECT_TRUE(Contains(daemon->err(), "nothing is kept for the next start"));
}

}  // namespace
}  // namespace collision::system_test
