#include "server/recording/replay/replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "server/config/config.h"

namespace collision::server {
namespace {

/// Three batches with 0, 1 and 2 inputs, at 10, 20 and 30 ns.
class ReplayTest : public testing::Test {
 protected:
  ReplayTest() {
    RecordingWriter writer(path_, CompleteConfig({}));
    for (int i = 0; i < 3; ++i) {
      v1::RecordedBatch batch;
      batch.set_monotonic_ns(10 * (i + 1));
      batch.set_wall_ns(1000 + i);
      batch.set_wall_was_set(i == 1);
      batch.set_earliest_readers(7 + i);
      for (int j = 0; j < i; ++j) batch.add_inputs()->set_sender(100 * i + j);
      EXPECT_TRUE(writer.Record(batch));
    }
  }
  ~ReplayTest() override { std::remove(path_.c_str()); }

  const std::string path_ = testing::TempDir() + "replay_test." + std::to_string(getpid());
};

// Goal:   each Receive() is one recorded batch, whatever its limit, and Read() gives that batch's
//         times until the next one, as earliest_readers() gives its readers; before the first the
//         times are the first one's.
TEST_F(ReplayTest, RepeatsBatchesAndTimes) {
  RecordingReader reader(path_);
  ReplaySource source(reader);
  EXPECT_EQ(source.Read().monotonic_ns, 10);
  for (int i = 0; i < 3; ++i) {
    std::vector<v1::Input> inputs;
    ASSERT_TRUE(source.Receive(std::chrono::hours(1), 1, &inputs));
    ASSERT_EQ(inputs.size(), static_cast<std::size_t>(i));
    for (int j = 0; j < i; ++j) EXPECT_EQ(inputs[j].sender(), 100u * i + j);
    EXPECT_EQ(source.Read().monotonic_ns, 10 * (i + 1));
    EXPECT_EQ(source.Read().wall_ns, 1000 + i);
    EXPECT_EQ(source.Read().wall_was_set, i == 1);
    EXPECT_EQ(source.earliest_readers(), 7u + i);
  }
  std::vector<v1::Input> inputs;
  EXPECT_FALSE(source.Receive({}, 1, &inputs));
  EXPECT_TRUE(inputs.empty());
  EXPECT_EQ(source.Read().monotonic_ns, 30);
}

// Goal:   what is appended to keeps what it held, as any bus must.
TEST_F(ReplayTest, AppendsInputs) {
  RecordingReader reader(path_);
  ReplaySource source(reader);
  std::vector<v1::Input> inputs;
  while (source.Receive({}, 100, &inputs)) {
  }
  EXPECT_EQ(inputs.size(), 3u);
}

// Goal:   of a recording that is cut off, the complete batches are handed out, and the reader
// tells.
TEST_F(ReplayTest, EndsWhereTheRecordingIsCutOff) {
  ASSERT_EQ(truncate(path_.c_str(),
                     [&] {
                       std::ifstream file(path_, std::ios::ate);
                       return static_cast<off_t>(file.tellg()) - 1;
                     }()),
            0);
  RecordingReader reader(path_);
  ReplaySource source(reader);
  std::vector<v1::Input> inputs;
  EXPECT_TRUE(source.Receive({}, 100, &inputs));
  EXPECT_TRUE(source.Receive({}, 100, &inputs));
  EXPECT_FALSE(source.Receive({}, 100, &inputs));
  EXPECT_EQ(inputs.size(), 1u);
  EXPECT_NE(reader.error(), "");
}

// Goal:   outputs go to the given function, or nowhere.
TEST_F(ReplayTest, HandsOutputsOn) {
  RecordingReader reader(path_);
  int events = 0;
  v1::Output event;
  event.mutable_collision_event();
  ReplaySource(reader, [&](const v1::Output& output) {
    events += output.has_collision_event();
  }).Publish(event);
  EXPECT_EQ(events, 1);
  ReplaySource(reader).Publish(event);
}

}  // namespace
}  // namespace collision::server
