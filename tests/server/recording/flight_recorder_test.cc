// Goal:   what the flight recorder writes on a thread of its own is what it was given, or says so.
#include "server/recording/flight_recorder.h"

#include <gtest/gtest.h>

#include <memory>

#include "server/recording/recording.h"
#include "tests/server/recording/segments_support.h"

namespace collision::server {
namespace {

// Goal:   limits that change while it writes count from the next step on.
TEST_F(SegmentsTest, ARecorderTakesOtherLimitsWhileItRuns) {
  const SegmentLimits limits{.bytes = 5'000, .age_ns = kStart};
  FlightRecorder recorder(Place(1 << 30), limits, config_, {.instance = 7}, kStart);
  recorder.Start();
  const auto step = [&recorder](int i) {
    auto batch = std::make_shared<v1::RecordedBatch>(Batch(i));
    recorder.Take(batch, recorder.wants_opening() ? std::optional(OfAlpha()) : std::nullopt);
    recorder.WaitUntilWritten();
  };
  for (int i = 0; i < 200; ++i) step(i);
  ASSERT_GT(Files().size(), 10u);
  recorder.SetLimits({.bytes_max = 20'000}, limits);
  step(200);
  EXPECT_LE(Files().size(), 5u);
}

// Goal:   with hardly any room in its queue batches are left out, but never without saying so, and
//         what is newest is never lost.
// Method: one that takes two batches at most; how many it leaves out depends on the machine, and
//         what holds does not.
TEST_F(SegmentsTest, ASlowDiskLeavesAGapThatIsTold) {
  constexpr int kBatches = 3000;
  {
    const SegmentLimits limits{.bytes = 20'000, .age_ns = kStart, .queue_bytes = 1};
    FlightRecorder recorder(Place(1 << 30), limits, config_, {.instance = 7}, kStart);
    recorder.Start();
    for (int i = 0; i < kBatches; ++i) {
      auto batch = std::make_shared<v1::RecordedBatch>(Batch(i, 100));
      recorder.Take(batch, recorder.wants_opening() ? std::optional(OfAlpha()) : std::nullopt);
    }
  }
  std::int64_t last = -1;
  bool continues = false;
  for (const wire::KeptFile& file : Files()) {
    RecordingReader reader(file.path);
    std::int64_t opened = -1;
    while (const auto batch = reader.Next()) {
      const std::int64_t clock = batch->inputs(0).simulator_clock().clock_ns();
      if (batch->opening()) {
        opened = clock;
        EXPECT_TRUE(!continues || clock == last) << "nothing is missing where a segment says so";
        EXPECT_GE(clock, last);
        continue;
      }
      EXPECT_EQ(clock, opened >= 0 ? opened + 1 : last + 1) << file.path;
      opened = -1;
      last = clock;
    }
    EXPECT_EQ(reader.error(), "");
    continues = reader.continues();
  }
}

}  // namespace
}  // namespace collision::server
