// Goal:   what --record wrote, --replay repeats: the same event log.
// Method: two simulators meet head-on over DDS; the line that sums up the event log must be the
// same twice.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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
  EXPECT_NE(replay.out.find(R"("extensions":[{"key":"told_utc","value":"20)"), std::string::npos)
      << replay.out;
  for (const char* status : {"EVENT_POSSIBLE", "EVENT_CONFIRMED", "EVENT_ENDED"}) {
    EXPECT_NE(replay.out.find(status), std::string::npos) << status << "\n" << replay.out;
  }
  const Outcome bounds = RunToEnd({Program("collisionctl"), "suggest-bounds", recording});
  EXPECT_EQ(bounds.status, 0) << bounds.err;
  EXPECT_TRUE(Contains(bounds.out, "left-sim/left ")) << bounds.out;
  EXPECT_TRUE(Contains(bounds.out, "right-sim/right ")) << bounds.out;
}

// Goal:   what the owner of a hypothetical agent was told is told again, and nothing else of it.
TEST(Recording, ReplayScreensHypotheticalAgentsAgain) {
  const TestWorld world(84, "simulators_awaited: 2 grant_ahead_max_s: 0.1");
  const std::string recording = world.folder().Path("run.rec");
  const auto daemon = world.StartDaemon({"--record", recording});
  const auto real = world.StartSimulator(kLeft);
  const auto plan = world.StartSimulator(kRight, {"--hypothetical"});
  ASSERT_EQ(real->WaitForExit(), 0) << real->err();
  ASSERT_EQ(plan->WaitForExit(), 0) << plan->err();
  daemon->Signal(SIGTERM);
  ASSERT_EQ(daemon->WaitForExit(), 0) << daemon->err();
  EXPECT_TRUE(Contains(plan->out(), "confirmed  left × right")) << plan->out();
  EXPECT_TRUE(Contains(plan->out(), "hypothetical")) << plan->out();
  const std::string screened = LogLine("screening log:", daemon->err());
  ASSERT_NE(screened, "") << daemon->err();

  const Outcome replay = RunToEnd({Program("collisiond"), "--replay", recording});
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(LogLine("screening log:", replay.err), screened);
  EXPECT_EQ(EventLogLine(replay.err), "event log: 0 events, hash cbf29ce484222325");
  for (const char* status : {"EVENT_POSSIBLE", "EVENT_CONFIRMED", "EVENT_ENDED"}) {
    EXPECT_NE(replay.out.find(status), std::string::npos) << status << "\n" << replay.out;
  }
  std::istringstream lines(replay.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.starts_with("{\"simulator_id\":")) << line;
  }
}

TEST(Recording, WhatCannotBeReplayedIsOneClearLine) {
  const Folder folder;
  const std::string garbage = folder.Write("garbage.rec", "this is no recording");
  // An entry of four bytes, a header with a format and no more: no field of the configuration is
  // set.
  const std::string unconfigured =
      folder.Write("unconfigured.rec", std::string("\x04\x0a\x02\x08\x03", 5));
  for (const std::string& file : {garbage, unconfigured, folder.Path("none.rec")}) {
    const Outcome replay = RunToEnd({Program("collisiond"), "--replay", file});
    EXPECT_EQ(replay.status, 74) << file;
    EXPECT_EQ(replay.err.rfind("collisiond: " + file + ": ", 0), 0u) << replay.err;
    EXPECT_EQ(replay.err.find('\n'), replay.err.size() - 1) << replay.err;
    EXPECT_EQ(replay.err.find(": byte 0: the configuration is missing") != std::string::npos,
              file == unconfigured)
        << replay.err;
  }
}

// Goal:   a recording of an earlier format is refused by all who read one, with both formats.
TEST(Recording, OneOfAnEarlierFormatIsRefusedWithASentence) {
  const Folder folder;
  const std::string old = folder.Write("old.rec", std::string("\x08\x0a\x06\x08\x02\x12\x02"
                                                              "0.",
                                                              9));
  const std::vector<std::string> readers[] = {{Program("collisiond"), "--replay", old},
                                              {Program("collisionctl"), "suggest-bounds", old}};
  for (const std::vector<std::string>& reader : readers) {
    const Outcome outcome = RunToEnd(reader);
    EXPECT_NE(outcome.status, 0) << reader[0];
    EXPECT_TRUE(Contains(outcome.err, old + ": ")) << outcome.err;
    EXPECT_TRUE(Contains(outcome.err,
                         "format 2, written by version \"0.\"; this program reads "
                         "format 3 only"))
        << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }
}

// Goal:   a recording that is cut off is replayed as far as it goes, without a network; then one
// line says so.
TEST(Recording, WhatIsCutOffIsReplayedAsFarAsItGoes) {
  const TestWorld world(70);
  const std::string recording = world.folder().Path("run.rec");
  const auto daemon = world.StartDaemon({"--record", recording});
  daemon->Signal(SIGTERM);
  ASSERT_EQ(daemon->WaitForExit(), 0) << daemon->err();
  // The length of an entry that never came.
  std::ofstream(recording, std::ios::binary | std::ios::app) << '\x05';
  const Outcome replay =
      RunToEnd({Program("collisiond"), "--replay", recording, "--log-level", "error"},
               {"CYCLONEDDS_URI=no configuration"});
  EXPECT_EQ(replay.status, 74);
  EXPECT_EQ(EventLogLine(replay.err), "event log: 0 events, hash cbf29ce484222325");
  EXPECT_TRUE(replay.err.ends_with(": cut off\n")) << replay.err;
}

// Goal:   a service that is refused the world, and may be started again and again, replaces nothing
//         of what earlier ones have kept.
TEST(Recording, AServiceThatIsRefusedReplacesNothing) {
  TestWorld world(135);
  const auto daemon = world.StartDaemon();
  const std::string file = world.folder().Write("run.rec", "of earlier");
  world.SetStateFolder(world.folder().Path("other"));
  EXPECT_EQ(world.LaunchDaemon({"--record", file})->WaitForExit(), 75);
  std::string kept;
  std::getline(std::ifstream(file), kept);
  EXPECT_EQ(kept, "of earlier");
  for (const char* after : {".1", ".new"}) EXPECT_FALSE(std::filesystem::exists(file + after));
  for (const char* folder : {"other/recordings", "other/contacts"})
    EXPECT_FALSE(std::filesystem::exists(world.folder().Path(folder))) << folder;
}

}  // namespace
}  // namespace collision::system_test
