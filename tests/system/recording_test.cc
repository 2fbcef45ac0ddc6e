// Goal:   what --record wrote, --replay repeats: the same event log.
// Method: two simulators meet head-on over DDS; the line that sums up the event log must be the
// same twice.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

TEST(Recording, ReplayGivesTheSameEventLog) {
  const TestWorld world(61);
  const std::string recording = world.folder().Path("run.rec");
  const auto daemon = world.StartDaemon({"--record", recording});
  const auto left = world.StartSimulator(kLeft);
  const auto right = world.StartSimulator(kRight);
  ASSERT_EQ(left->WaitForExit(), 0) << left->err();
  ASSERT_EQ(right->WaitForExit(), 0) << right->err();
  daemon->Signal(SIGTERM);
  ASSERT_EQ(daemon->WaitForExit(), 0) << daemon->err();
  const std::string said = EventLogLine(daemon->err());
  ASSERT_NE(said, "") << daemon->err();

  const Outcome replay = RunToEnd({Program("collisiond"), "--replay", recording});
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(EventLogLine(replay.err), said);
  for (const char* status : {"EVENT_POSSIBLE", "EVENT_CONFIRMED", "EVENT_ENDED"}) {
    EXPECT_NE(replay.out.find(status), std::string::npos) << status << "\n" << replay.out;
  }
}

TEST(Recording, WhatCannotBeReplayedIsOneClearLine) {
  const Folder folder;
  const std::string garbage = folder.Write("garbage.rec", "this is no recording");
  for (const std::string& file : {garbage, folder.Path("none.rec")}) {
    const Outcome replay = RunToEnd({Program("collisiond"), "--replay", file});
    EXPECT_EQ(replay.status, 74) << file;
    EXPECT_NE(replay.err.find(file), std::string::npos) << replay.err;
  }
}

}  // namespace
}  // namespace collision::system_test
