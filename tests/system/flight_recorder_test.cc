// Goal:   a service with a folder of its own keeps recordings and contacts through kill -9, and
//         people get at them while it runs and afterwards.
// Method: two simulators meet head-on over DDS; the service is killed in the middle of it, and
//         started again.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

/// Their paths, in their order.
std::vector<std::string> SegmentsOf(const TestWorld& world) {
  std::vector<std::string> paths;
  const std::filesystem::path folder = world.folder().Path("state") + "/recordings";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Outcome Replay(const std::vector<std::string>& words) {
  std::vector<std::string> command = {Program("collisiond"), "--replay"};
  command.insert(command.end(), words.begin(), words.end());
  return RunToEnd(command);
}

TEST(FlightRecorder, WhatAKilledServiceSawIsReplayedAndWhatItToldIsListed) {
  const TestWorld world(114, "simulators_awaited: 2", "recorder_segment_s: 1");
  const std::string state = world.folder().Path("state");
  auto daemon = world.StartDaemon();
  const auto left = world.StartSimulator(kLeft, {"--speed", "2"});
  const auto right = world.StartSimulator(kRight, {"--speed", "2"});

  // While it runs; words that are no time are refused with those that are.
  const std::vector<std::string> today = {"events", "--since", "2h", "--state-dir", state};
  ASSERT_TRUE(world.MonitorComesToSay(today, "confirmed  left × right"));
  const Outcome refused = world.Monitor({"events", "--since", "lately"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(Contains(refused.err, "\"lately\", allowed: ")) << refused.err;

  daemon->Signal(SIGKILL);
  ASSERT_EQ(daemon->WaitForExit(), 128 + SIGKILL);
  const auto segments = SegmentsOf(world);
  ASSERT_GE(segments.size(), 1u);
  // As a kill within a write leaves it.
  std::filesystem::resize_file(segments.back(), std::filesystem::file_size(segments.back()) - 3);
  daemon = world.StartDaemon();
  EXPECT_TRUE(daemon->WaitForOutput("flight recorder: "));
  EXPECT_GT(SegmentsOf(world).size(), segments.size()) << "a start begins a segment";

  // Both starts are replayed, though the first one's last segment is cut, and one file holds
  // nothing.
  const std::string empty = state + "/recordings/" + world.name() + ".114.20990101T000000.000Z.rec";
  std::ofstream{empty};
  const Outcome replay = Replay({state});
  EXPECT_EQ(replay.status, 74) << replay.err;
  EXPECT_TRUE(Contains(replay.out, "EVENT_CONFIRMED")) << replay.err;
  const std::string ends = ".rec: here the replay of this start of the service ends";
  const std::size_t first =
      replay.err.find(segments.back().substr(0, segments.back().size() - 4) + ends);
  ASSERT_NE(first, std::string::npos) << replay.err;
  EXPECT_NE(replay.err.find(ends, first + segments.back().size()), std::string::npos) << replay.err;
  EXPECT_TRUE(Contains(replay.err, empty + ": byte 0: ")) << replay.err;
  std::filesystem::remove(empty);
  std::string contacts;
  for (const std::string& segment : segments) {
    const Outcome alone = Replay({segment});
    const bool is_cut = segment == segments.back();
    EXPECT_EQ(alone.status, is_cut ? 74 : 0) << alone.err;
    EXPECT_EQ(Contains(alone.err, segment + ": byte "), is_cut) << alone.err;
    contacts += alone.out;
  }
  EXPECT_TRUE(Contains(contacts, "EVENT_CONFIRMED"));

  const Outcome listed = world.Monitor({"recordings", state});
  EXPECT_EQ(listed.status, 0) << listed.err;
  EXPECT_TRUE(Contains(listed.out, "damaged: " + segments.back() + ": byte ")) << listed.out;
  EXPECT_TRUE(Contains(listed.out, "(is being written)")) << listed.out;
  EXPECT_TRUE(Contains(world.Monitor(today).out, "confirmed  left × right"));
  EXPECT_EQ(world.Monitor({"events", "--since", "2h", "--until", "1h", "--state-dir", state}).out,
            "");
  daemon->Signal(SIGTERM);
  EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
}

// Goal:   a folder that cannot be written, or none, changes nothing but a line in the log.
TEST(FlightRecorder, ItNeverEndsTheService) {
  TestWorld world(115, "", "on_recording_failure: END");
  std::filesystem::create_directories(world.folder().Path("state"));
  std::ofstream(world.folder().Path("state") + "/recordings") << "in the way";
  std::ofstream(world.folder().Path("state") + "/contacts") << "in the way";
  const auto daemon = world.StartDaemon();
  EXPECT_TRUE(daemon->WaitForOutput("flight recorder: "));
  EXPECT_TRUE(Contains(daemon->err(), "state/recordings: cannot be written: ")) << daemon->err();
  EXPECT_TRUE(Contains(daemon->err(), "state/contacts: cannot be written: ")) << daemon->err();
  for (const char* what : {"to keep the flight recorder", "to keep its contacts"})
    EXPECT_TRUE(world.MonitorComesToSay({"status"}, what)) << what;
  daemon->Signal(SIGTERM);
  EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
}

}  // namespace
}  // namespace collision::system_test
