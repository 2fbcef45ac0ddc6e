// Goal:   a replay is heard step by step, as a monitor would have heard it; what cannot be replayed
//         is told; a file may be called anything.
// Method: in place of collisiond a script that writes its words and prints a transcript by hand.
#include "client/programs/recordings/replayed_world.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_path.h"

namespace collision::client {
namespace {

class ReplayedWorldTest : public testing::Test {
 protected:
  ReplayedWorldTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    if (const char* path = std::getenv("PATH")) before_ = path;
    setenv("PATH", folder_.c_str(), 1);
    std::ofstream(recording_) << "anything";
  }
  ~ReplayedWorldTest() override { setenv("PATH", before_.c_str(), 1); }

  void PutScript(const std::string& end) {
    const std::string program = folder_ + "/collisiond";
    std::ofstream(program) << "#!/bin/sh\nPATH=/usr/bin:/bin\nprintf '%s\\n' \"$@\" > '" << folder_
                           << "/words'\ncat '" << folder_ << "/transcript'\n"
                           << end << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    std::ofstream(folder_ + "/transcript", std::ios::binary) << transcript_;
  }

  void AddHeader() {
    v1::RecordingEntry entry;
    entry.mutable_header()->set_format(3);
    wire::AppendEntry(entry, &transcript_);
  }
  void AddBatch(std::int64_t monotonic_ns, const std::vector<std::uint32_t>& runs,
                bool continued = false) {
    v1::RecordingEntry entry;
    v1::RecordedBatch& batch = *entry.mutable_batch();
    batch.set_monotonic_ns(monotonic_ns);
    batch.set_wall_ns(1000 + monotonic_ns);
    batch.set_continued(continued);
    for (const std::uint32_t run : runs) {
      batch.add_inputs()->mutable_simulator_clock()->set_run(run);
    }
    wire::AppendEntry(entry, &transcript_);
  }
  void AddTold(std::int64_t now_ns, std::uint64_t service = 9) {
    v1::RecordingEntry entry;
    v1::ServiceStatus& status = *entry.mutable_told()->mutable_output()->mutable_service_status();
    status.set_now_ns(now_ns);
    status.mutable_stamp()->set_service_id(service);
    wire::AppendEntry(entry, &transcript_);
  }

  ReplayRequest Request() const { return {.file = recording_, .from_ns = {}, .until_ns = {}}; }

  const std::string folder_ = TemporaryPath("replayed_world");
  const std::string recording_ = folder_ + "/run.rec";
  std::string before_, transcript_;
};

std::string RefusalOf(const ReplayRequest& request) {
  try {
    const ReplayedWorld world(request);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(ReplayedWorldTest, EachStepComesWithWhatItTold) {
  AddHeader();
  AddTold(1);
  AddBatch(10, {1, 2});
  AddTold(2);
  AddTold(3);
  AddBatch(20, {3}, true);
  AddBatch(20, {4});
  AddTold(4);
  AddBatch(30, {});
  PutScript("exit 0");
  ReplayedWorld world(Request());
  const std::vector<std::array<std::size_t, 2>> expected = {{2, 3}, {2, 1}, {0, 0}};
  const std::vector<std::int64_t> times = {10, 20, 30};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(world.service_alive());
    Arrivals arrivals;
    world.Receive(std::chrono::hours(1), &arrivals);
    EXPECT_EQ(arrivals.inputs.size(), expected[i][0]) << i;
    EXPECT_EQ(arrivals.outputs.size(), expected[i][1]) << i;
    EXPECT_EQ(world.Now().time_since_epoch().count(), times[i]);
    EXPECT_EQ(world.wall_ns(), 1000 + times[i]);
  }
  EXPECT_TRUE(world.is_over());
  EXPECT_TRUE(world.service_alive()) << "its end is not that of the service";
  Arrivals nothing;
  world.Receive({}, &nothing);
  EXPECT_TRUE(nothing.inputs.empty() && nothing.outputs.empty());
  EXPECT_EQ(world.Finish(), 0);
}

// Goal:   behind a start of the service comes the next one: time goes on, the former has ended.
TEST_F(ReplayedWorldTest, AnotherStartOfTheServiceEndsTheFormerOne) {
  AddHeader();
  AddBatch(50, {1});
  AddTold(1, 9);
  AddHeader();
  AddBatch(10, {2});
  AddTold(2, 10);
  PutScript("exit 74");
  ReplayedWorld world(Request());
  std::vector<v1::Input> inputs;
  while (!world.is_over()) {
    Arrivals arrivals;
    world.Receive({}, &arrivals);
    for (v1::Input& input : arrivals.inputs) inputs.push_back(std::move(input));
  }
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_TRUE(inputs[1].service_heard().ended());
  EXPECT_EQ(inputs[1].service_heard().service_id(), 9u);
  EXPECT_EQ(world.Now().time_since_epoch().count(), 60);
  EXPECT_EQ(world.Finish(), 74);
}

TEST_F(ReplayedWorldTest, AReplayThatIsKilledFails) {
  AddHeader();
  AddBatch(1, {1});
  PutScript("kill -9 $$");
  ReplayedWorld world(Request());
  Arrivals arrivals;
  while (!world.is_over()) world.Receive({}, &arrivals);
  EXPECT_EQ(arrivals.inputs.size(), 1u);
  EXPECT_NE(world.Finish(), 0);
}

// Goal:   one that is given up ends, though its replay has more to say than a pipe holds.
TEST_F(ReplayedWorldTest, AReplayThatIsGivenUpEnds) {
  AddHeader();
  for (int i = 0; i < 20'000; ++i) AddBatch(i, {1, 2, 3});
  PutScript("exit $?");
  ASSERT_GT(transcript_.size(), 500'000u);
  { const ReplayedWorld world(Request()); }
  ReplayedWorld finished(Request());
  EXPECT_NE(finished.Finish(), 0) << "its output could not be written";
}

TEST_F(ReplayedWorldTest, NamesReachItAsTheyAre) {
  AddHeader();
  PutScript("exit 0");
  for (const char* name : {"it's", "a b  c", "$(touch x)`", "\"; exit 1; \"", "*\\", "'"}) {
    const std::string file = folder_ + "/" + name;
    std::ofstream(file) << "anything";
    ReplayedWorld world({.file = file, .from_ns = 0, .until_ns = 1'764'000'000'500'000'000});
    EXPECT_EQ(world.Finish(), 0) << file;
    std::ostringstream words;
    words << std::ifstream(folder_ + "/words").rdbuf();
    EXPECT_EQ(words.str(), "--log-level\nerror\n--transcript\n--replay\n" + file +
                               "\n--from\n1970-01-01T00:00:00.000Z\n--until\n"
                               "2025-11-24T16:00:00.500Z\n");
  }
}

TEST_F(ReplayedWorldTest, WithoutCollisiondOrTheFileOneSentenceSaysSo) {
  EXPECT_TRUE(RefusalOf(Request()).starts_with("collisiond is not beside this program"));
  PutScript("exit 0");
  EXPECT_EQ(RefusalOf(Request()), "");
  EXPECT_EQ(RefusalOf({.file = folder_ + "/none.rec", .from_ns = {}, .until_ns = {}}),
            folder_ + "/none.rec: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace collision::client
