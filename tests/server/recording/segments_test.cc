// Goal:   the flight recorder keeps what fits, the newest of it, whole, and ends nothing.
#include "server/recording/segments.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "server/recording/recording.h"
#include "server/recording/replay/segment_chain.h"
#include "tests/server/recording/segments_support.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

std::string ContentOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST_F(SegmentsTest, RollBySizeAndEachBeginsWithWhatIsNewest) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 30'000, .age_ns = kStart});
  for (int i = 0; i < 100; ++i) Step(&segments, Batch(i));
  segments.End();
  const auto files = Files();
  ASSERT_GE(files.size(), 4u);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_LE(files[i].bytes, 32'000u);
    const std::vector<std::int64_t> clocks = ClocksFrom(files[i]);
    ASSERT_FALSE(clocks.empty());
    EXPECT_EQ(clocks.back(), 99) << "it goes on to the end";
    for (std::size_t next = 1; next < clocks.size(); ++next) {
      EXPECT_EQ(clocks[next], clocks[next - 1] + 1) << "without a gap";
    }
    RecordingReader reader(files[i].path);
    EXPECT_EQ(reader.segment(), i + 1);
    const auto first = reader.Next();
    EXPECT_EQ(first->opening(), i > 0);
    if (i > 0) {
      EXPECT_EQ(first->inputs(0).simulator_clock().clock_ns(), clocks[0] - 1);
    }
  }
}

// Goal:   what ever-new keys take is given back without a new segment.
TEST_F(SegmentsTest, ACensusBeginsNoSegment) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 1 << 30, .age_ns = kStart});
  for (int i = 0; i < 40'000; ++i) {
    v1::RecordedBatch batch = Batch(i, 10);
    *batch.add_inputs() = From(2, ClockOf("stranger" + std::to_string(i), 1));
    const bool asks = segments.wants_opening() || segments.wants_census();
    segments.Take(batch, asks ? std::optional(OfAlpha()) : std::nullopt);
    ASSERT_LT(segments.newest().bytes(), 2 * NewestInputs::kNewBytes + 10'000);
  }
  segments.End();
  EXPECT_EQ(Files().size(), 1u);
}

TEST_F(SegmentsTest, RollByAge) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = 10 * kSecondNs});
  for (int i = 0; i < 65; ++i) Step(&segments, Batch(i));
  EXPECT_EQ(Files().size(), 6u);
}

TEST_F(SegmentsTest, TheOldestGoBeyondTheBoundAndAfterTheirTime) {
  Segments segments = Begin(Place(100'000), {.bytes = 20'000, .age_ns = kStart});
  for (int i = 0; i < 1000; ++i) {
    Step(&segments, Batch(i));
    std::uint64_t bytes = 0;
    for (const wire::KeptFile& file : Files()) bytes += file.bytes;
    ASSERT_LE(bytes, 102'000u);
  }
  EXPECT_GE(Files().size(), 4u);
  EXPECT_EQ(ClocksFrom(Files().front()).back(), 999);
  segments.End();
  Segments aged = Begin(Place(1 << 30, 100), {.bytes = 1 << 20, .age_ns = 10 * kSecondNs}, 1000);
  for (int i = 1000; i < 1400; ++i) Step(&aged, Batch(i));
  EXPECT_GE(Files().front().begin_ns, kStart + 1270 * kSecondNs);
  EXPECT_LE(Files().front().begin_ns, kStart + 1300 * kSecondNs);
}

// Goal:   limits that change while it writes count from then on.
TEST_F(SegmentsTest, OtherLimitsCountFromTheNextStepOn) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 5'000, .age_ns = kStart});
  for (int i = 0; i < 200; ++i) Step(&segments, Batch(i));
  ASSERT_GT(Files().size(), 20u);
  segments.SetLimits({.bytes_max = 40'000}, {.bytes = 10'000, .age_ns = kStart});
  Step(&segments, Batch(200));
  std::uint64_t bytes = 0;
  for (const wire::KeptFile& file : Files()) bytes += file.bytes;
  EXPECT_LE(bytes, 41'000u);
  EXPECT_GE(bytes, 30'000u);
  for (int i = 201; i < 400; ++i) Step(&segments, Batch(i));
  EXPECT_LE(Files().size(), 6u);
  EXPECT_EQ(ClocksFrom(Files().front()).back(), 399);
}

// Goal:   what a clock wrote that was years ahead does not push out what is written now.
TEST_F(SegmentsTest, FilesOfAWrongClockGoFirst) {
  {
    Segments ahead(Place(1 << 30), {.bytes = 5'000, .age_ns = kStart}, config_, {.instance = 6},
                   kStart * 2);
  }
  Segments segments = Begin(Place(30'000), {.bytes = 5'000, .age_ns = kStart});
  for (int i = 0; i < 60; ++i) Step(&segments, Batch(i));
  ASSERT_GT(Files().size(), 3u);
  EXPECT_LT(Files().back().begin_ns, kStart + 60 * kSecondNs);
}

TEST_F(SegmentsTest, AStartKeepsWhatIsThereAndEachWorldHasItsOwn) {
  { Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart}); }
  const std::string first = ContentOf(Files().at(0).path);
  RollingPlace other = Place(1);
  other.world_and_domain = "other.0";
  { Begin(other, {.bytes = 1, .age_ns = kStart}); }
  { Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart}); }  // at the same time
  ASSERT_EQ(Files().size(), 3u);
  EXPECT_EQ(ContentOf(Files()[0].path), first);
  RecordingReader reader(Files()[0].path);
  EXPECT_FALSE(reader.Next());
  EXPECT_FALSE(reader.continues());
}

// Goal:   a service that stands by gives no opening: the segment ends at twice its size.
TEST_F(SegmentsTest, WithoutAnOpeningItEndsAndBeginsWhenThereIsOne) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 20'000, .age_ns = kStart});
  for (int i = 0; i < 200; ++i) {
    segments.Take(Batch(i), {});
    segments.Flush();
  }
  ASSERT_EQ(Files().size(), 1u);
  EXPECT_LE(Files()[0].bytes, 42'000u);
  EXPECT_TRUE(segments.wants_opening());
  Step(&segments, Batch(200));
  ASSERT_EQ(Files().size(), 2u);
  EXPECT_EQ(ClocksFrom(Files()[0]).back(), 37) << "a chain does not go on over a gap";
  EXPECT_EQ(ClocksFrom(Files()[1]), std::vector<std::int64_t>{200});
}

// Goal:   a segment that is cut off, as kill -9 does it, or changed anywhere, gives its whole
//         entries before that and names the byte.
TEST_F(SegmentsTest, WhatIsDamagedIsNamedAndWhatPrecedesIsWhole) {
  {
    Segments segments = Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart});
    for (int i = 0; i < 20; ++i) Step(&segments, Batch(i, 20));
  }
  const std::string path = Files().at(0).path, whole = ContentOf(path);
  Random random(5);
  for (int turn = 0; turn < 200; ++turn) {
    std::string bytes = whole;
    if (turn % 2 == 0) {
      bytes.resize(random.Below(whole.size()));
    } else {
      bytes[random.Below(whole.size())] ^= static_cast<char>(1 << random.Below(8));
    }
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      RecordingReader reader(path);
      int next = 0;
      while (const auto batch = reader.Next()) {
        ASSERT_EQ(batch->DebugString(), Batch(next, 20).DebugString());
        ++next;
      }
      const bool is_named = reader.error().starts_with(path + ": byte ");
      EXPECT_TRUE(is_named || (turn % 2 == 0 && reader.error().empty())) << next;
    } catch (const std::runtime_error& refused) {
      EXPECT_TRUE(std::string(refused.what()).starts_with(path + ": byte 0: ")) << refused.what();
    }
  }
}

// Goal:   where nothing can be written it says so, keeps the rest whole, and tries again later.
// Method: a limit on the size of files stands for the disk.
TEST_F(SegmentsTest, AFailureEndsTheSegmentAndTheNextBeginsAfterAWhile) {
  std::signal(SIGXFSZ, SIG_IGN);
  Segments segments =
      Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart, .retry_ns = 5 * kSecondNs});
  for (int i = 0; i < 10; ++i) Step(&segments, Batch(i));
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{Files().at(0).bytes + 10, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  for (int i = 10; i < 13; ++i) Step(&segments, Batch(i));
  EXPECT_EQ(segments.failure(), Files().at(0).path + ": cannot be written: File too large");
  setrlimit(RLIMIT_FSIZE, &before);
  for (int i = 13; i < 30; ++i) Step(&segments, Batch(i));
  EXPECT_EQ(segments.failure(), "");
  ASSERT_EQ(Files().size(), 2u);
  EXPECT_EQ(ClocksFrom(Files()[0]).back(), 9);
  EXPECT_EQ(ClocksFrom(Files()[1]).front(), 16);
  EXPECT_EQ(RecordingReader(Files()[1].path).Next()->inputs(0).simulator_clock().clock_ns(), 15)
      << "the newest inputs were kept meanwhile";
}

// Goal:   two services that write to one folder, with clocks that are set, are two runs, each whole
//         and in its order; what cannot be read is passed over, also where it is the first.
TEST_F(SegmentsTest, RunsAreToldApartByTheirHeaders) {
  const SegmentLimits limits{.bytes = 5'000, .age_ns = 1'000 * kSecondNs};
  Segments first = Begin(Place(1 << 30), limits);
  Segments second(Place(1 << 30), limits, config_, {.instance = 8}, kStart + kSecondNs / 2);
  const auto step = [&](Segments* segments, std::uint64_t instance, int number, int set_back_s) {
    v1::RecordedBatch batch = Batch(number);
    batch.set_wall_ns(batch.wall_ns() - set_back_s * kSecondNs);
    Opening opening = OfAlpha();
    opening.claim.instance = instance;
    opening.serves = true;
    segments->Take(batch, segments->wants_opening() ? std::optional(opening) : std::nullopt);
    segments->Flush();
  };
  for (int i = 1; i < 40; ++i) step(&first, 7, i, i < 20 ? 0 : 15);
  for (int i = 1; i < 40; ++i) step(&second, 8, i, 0);
  first.End();
  second.End();
  std::ofstream(folder_ + "/lab.0.19990101T000000.000Z.rec") << "";
  SegmentChain chain(folder_, {});
  std::string skipped;
  const auto skip = [&](const std::string& cause) { skipped += cause; };
  for (const std::uint64_t instance : {7, 8}) {
    ASSERT_TRUE(chain.NextRun(skip));
    EXPECT_EQ(chain.claim().instance, instance);
    std::vector<std::int64_t> clocks;
    while (const auto batch = chain.Next()) {
      if (!batch->opening()) clocks.push_back(batch->inputs(0).simulator_clock().clock_ns());
    }
    ASSERT_EQ(clocks.size(), 39u);
    EXPECT_TRUE(std::ranges::is_sorted(clocks));
  }
  EXPECT_FALSE(chain.NextRun(skip));
  EXPECT_NE(skipped.find("19990101T000000.000Z.rec"), std::string::npos) << skipped;
}

// Goal:   where the next segment of a start is missing, one of another start does not take its
//         place, though it has the number.
TEST_F(SegmentsTest, ARunEndsWhereItsNextSegmentIsMissing) {
  const SegmentLimits limits{.bytes = 5'000, .age_ns = 1'000 * kSecondNs};
  for (const std::uint64_t instance : {7, 8}) {
    const int begin = instance == 7 ? 0 : 100;
    Segments segments(Place(1 << 30), limits, config_, {.instance = instance},
                      kStart + begin * kSecondNs);
    for (int i = begin; i < begin + 40; ++i) {
      Opening opening = OfAlpha();
      opening.claim.instance = instance;
      segments.Take(Batch(i), segments.wants_opening() ? std::optional(opening) : std::nullopt);
      segments.Flush();
    }
    segments.End();
  }
  for (const wire::KeptFile& file : Files()) {
    const RecordingReader reader(file.path);
    const bool is_first = reader.claim().instance == 7;
    if (is_first == (reader.segment() > 2)) std::filesystem::remove(file.path);
  }
  SegmentChain chain(folder_, {});
  const auto skip = [](const std::string& cause) { ADD_FAILURE() << cause; };
  ASSERT_TRUE(chain.NextRun(skip));
  EXPECT_FALSE(chain.begins_behind_a_gap());
  std::int64_t last = 0;
  while (const auto batch = chain.Next()) last = batch->inputs(0).simulator_clock().clock_ns();
  EXPECT_LT(last, 40);
  ASSERT_TRUE(chain.NextRun(skip));
  EXPECT_EQ(chain.claim().instance, 8u);
  EXPECT_TRUE(chain.begins_behind_a_gap());
}

// Goal:   a replay from a time begins with the segment that has it, though another service has
//         begun one later.
TEST_F(SegmentsTest, AReplayBeginsWithTheRunThatHasTheTime) {
  Segments first = Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = 1'000 * kSecondNs});
  for (int i = 0; i < 10; ++i) Step(&first, Batch(i));
  Segments second(Place(1 << 30), {}, config_, {.instance = 8}, kStart + 5 * kSecondNs);
  first.End();
  second.End();
  SegmentChain chain(folder_, {.from_ns = kStart + 8 * kSecondNs});
  ASSERT_TRUE(chain.NextRun([](const std::string& cause) { ADD_FAILURE() << cause; }));
  EXPECT_EQ(chain.claim().instance, 7u);
  EXPECT_THROW(SegmentChain(folder_, {.from_ns = kStart + 60 * kSecondNs}), std::runtime_error);
}

// Goal:   a time at which nothing was recorded is refused, of a folder as of a single file.
TEST_F(SegmentsTest, ATimeOfWhichNothingIsThereIsRefused) {
  Segments segments = Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart}, 1);
  for (int i = 1; i < 10; ++i) Step(&segments, Batch(i));
  segments.End();
  for (const std::string& path : {folder_, Files().at(0).path}) {
    const auto refusal = [&path](const ReplayRange& range) -> std::string {
      try {
        const SegmentChain chain(path, range);
      } catch (const std::runtime_error& error) {
        return error.what();
      }
      return "";
    };
    EXPECT_NE(refusal({.from_ns = kStart}).find("--from"), std::string::npos);
    EXPECT_NE(refusal({.until_ns = kStart}).find("--until"), std::string::npos);
    EXPECT_NE(refusal({.from_ns = kStart + 10 * kSecondNs}).find("after the end"),
              std::string::npos);
    EXPECT_EQ(refusal({.from_ns = kStart + kSecondNs, .until_ns = kStart + kSecondNs}), "");
    EXPECT_EQ(refusal({.from_ns = kStart + 9 * kSecondNs}), "");
  }
}

// Goal:   who removes the folder of a running service loses what was in it, and nothing later.
TEST_F(SegmentsTest, BeginAnewWhereTheFileWasRemoved) {
  Segments segments =
      Begin(Place(1 << 30), {.bytes = 1 << 20, .age_ns = kStart, .retry_ns = 5 * kSecondNs});
  for (int i = 0; i < 10; ++i) Step(&segments, Batch(i));
  std::filesystem::remove_all(folder_);
  Step(&segments, Batch(10));
  EXPECT_NE(segments.failure(), "");
  for (int i = 11; i < 30; ++i) Step(&segments, Batch(i));
  EXPECT_EQ(segments.failure(), "");
  ASSERT_EQ(Files().size(), 1u);
  EXPECT_EQ(ClocksFrom(Files()[0]).back(), 29);
}

// Goal:   on a full disk the oldest segments make room; where none is left it says so.
// Method: a small file system in memory, in a namespace of a thread of the test; that takes root,
//         without whom nothing is tested here.
TEST_F(SegmentsTest, OnAFullDiskTheOldestMakesRoom) {
  std::thread([&] {
    std::filesystem::create_directories(folder_);
    if (unshare(CLONE_FS | CLONE_NEWNS) != 0) return;
    mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
    if (mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=1m") != 0) return;
    Segments segments =
        Begin(Place(1 << 30), {.bytes = 100'000, .age_ns = kStart, .retry_ns = 5 * kSecondNs});
    for (int i = 0; i < 3000; ++i) Step(&segments, Batch(i));
    EXPECT_EQ(segments.failure(), "");
    EXPECT_EQ(ClocksFrom(Files().front()).back(), 2999);
    const auto files = Files();
    EXPECT_GE(files.size(), 5u);
    // A batch that does not fit even when all others have gone.
    Step(&segments, Batch(3000, 2'000'000));
    EXPECT_TRUE(segments.failure().ends_with("No space left on device")) << segments.failure();
    EXPECT_EQ(Files().size(), 1u) << "the one that was open";
    EXPECT_EQ(ClocksFrom(Files()[0]).back(), 2999);
    for (int i = 3001; i < 3004; ++i) Step(&segments, Batch(i));
    for (int i = 3004; i < 3020; ++i) Step(&segments, Batch(i));
    EXPECT_EQ(segments.failure(), "");
    EXPECT_EQ(ClocksFrom(Files().back()).back(), 3019);
  }).join();
}

}  // namespace
}  // namespace collision::server
