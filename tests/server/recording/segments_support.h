// What the tests of segments share: a folder for them, and steps to record.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/config/config.h"
#include "server/recording/replay/segment_chain.h"
#include "server/recording/segments.h"
#include "tests/server/messages.h"
#include "tests/support/temporary_path.h"

namespace collision::server {

inline constexpr std::int64_t kSecondNs = 1'000'000'000;
inline constexpr std::int64_t kStart = 1'790'000'000 * kSecondNs;

/// Batches are a second apart, each with one clock, of about `bytes`.
inline v1::RecordedBatch Batch(int number, std::size_t bytes = 1000) {
  v1::RecordedBatch batch;
  batch.set_wall_ns(kStart + number * kSecondNs);
  batch.set_monotonic_ns(number * kSecondNs);
  v1::SimulatorClock clock = ClockOf("alpha", number);
  clock.set_simulator_name("alpha" + std::string(bytes, 'x'));
  *batch.add_inputs() = From(1, clock);
  return batch;
}

inline Opening OfAlpha() {
  Opening opening;
  opening.claim = {.instance = 7, .epoch = 1};
  opening.simulators[SimulatorId("alpha")] = {.sender = 1, .run = 1, .is_in_time = true};
  return opening;
}

class SegmentsTest : public testing::Test {
 protected:
  SegmentsTest() { std::filesystem::remove_all(folder_); }
  ~SegmentsTest() override { std::filesystem::remove_all(folder_); }

  RollingPlace Place(std::uint64_t bytes_max, std::int64_t keep_s = 0) const {
    return {.folder = folder_,
            .world_and_domain = "lab.0",
            .suffix = ".rec",
            .limits = {.bytes_max = bytes_max, .keep_ns = keep_s * kSecondNs}};
  }

  Segments Begin(const RollingPlace& place, SegmentLimits limits, int at = 0) const {
    return Segments(place, limits, config_, {.instance = 7}, kStart + at * kSecondNs);
  }

  /// One step, as the daemon does it.
  static void Step(Segments* segments, const v1::RecordedBatch& batch) {
    segments->Take(batch, segments->wants_opening() ? std::optional(OfAlpha()) : std::nullopt);
    segments->Flush();
  }

  std::vector<wire::KeptFile> Files() const { return wire::KeptFilesIn(folder_, ".rec"); }

  /// The clocks of a chain that begins with this file, without the opening of the first.
  std::vector<std::int64_t> ClocksFrom(const wire::KeptFile& file) const {
    std::vector<std::int64_t> clocks;
    SegmentChain chain(folder_, {.from_ns = file.begin_ns});
    const bool begins = chain.NextRun([](const std::string& cause) { ADD_FAILURE() << cause; });
    EXPECT_TRUE(begins);
    if (!begins) return clocks;
    while (const auto batch = chain.Next()) {
      if (!batch->opening()) clocks.push_back(batch->inputs(0).simulator_clock().clock_ns());
    }
    EXPECT_EQ(chain.error(), "");
    return clocks;
  }

  const v1::Config config_ = CompleteConfig({});
  const std::string folder_ = TemporaryPath("segments");
};

}  // namespace collision::server
