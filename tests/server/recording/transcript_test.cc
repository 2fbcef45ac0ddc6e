// Goal:   a transcript has what a replay takes in, step by step, and behind each step what the
//         service told in it: all of it, in order.
// Method: a run of two that come near is recorded; the transcript of its replay is read entry by
//         entry and compared with the recording and with what the replay publishes.
#include "server/recording/replay/transcript.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "idl/recording/entries.h"
#include "server/recording/replay/replay.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

std::vector<v1::RecordingEntry> EntriesIn(const std::string& bytes) {
  const std::string path = TemporaryPath("transcript");
  std::ofstream(path, std::ios::binary) << bytes;
  wire::EntryReader reader(path);
  std::vector<v1::RecordingEntry> entries;
  for (v1::RecordingEntry entry; reader.Next(&entry);) entries.push_back(entry);
  EXPECT_EQ(reader.error(), "");
  return entries;
}

TEST(Transcript, HasEachStepAndWhatWasToldInIt) {
  const std::string path = TemporaryPath("transcript.rec");
  const v1::Config config = CompleteConfig(Simulated());
  const ClaimOptions claim{.instance = 7};
  {
    RecordingWriter writer(path, config, claim);
    ScriptedDaemon daemon(config, DaemonParts{.recorder = &writer, .claim = claim});
    for (const char* name : {"alpha", "delta"}) {
      v1::AgentState state = State(0, 0, 1);
      state.mutable_position_m()->set_x(0.5 * name[0]);
      daemon.Step({From(name[0], Description(name, 0)), From(name[0], state, name),
                   From(name[0], ClockAfter(name, 0, 1, 1))},
                  0.01);
    }
    daemon.Pass(3);
  }
  std::vector<v1::RecordedBatch> batches;
  RecordingReader recorded(path);
  while (auto batch = recorded.Next()) batches.push_back(*batch);
  ASSERT_GT(batches.size(), 2u);

  std::ostringstream stream;
  Transcript transcript(&stream);
  std::vector<std::pair<std::size_t, v1::Output>> published;  // behind so many batches
  std::size_t taken = 0;
  RecordingReader reader(path);
  ReplaySource source(
      reader,
      [&](const v1::Output& output) {
        published.emplace_back(taken, output);
        transcript.Add(batches.at(taken == 0 ? 0 : taken - 1).wall_ns(), output);
      },
      [&](const v1::RecordedBatch& batch) {
        ++taken;
        transcript.Add(batch);
      });
  transcript.Begin(reader.config(), reader.claim());
  Daemon daemon(reader.config(), source, source, {.claim = reader.claim()});
  while (daemon.Step()) {
  }
  ASSERT_EQ(taken, batches.size());
  ASSERT_GT(published.size(), 5u);

  const auto entries = EntriesIn(stream.str());
  ASSERT_EQ(entries.size(), 1 + batches.size() + published.size());
  ASSERT_TRUE(entries[0].has_header());
  EXPECT_EQ(entries[0].header().config().DebugString(), config.DebugString());
  EXPECT_EQ(entries[0].header().claim().instance(), 7u);
  std::size_t steps = 0, told = 0;
  for (const v1::RecordingEntry& entry : entries) {
    EXPECT_TRUE(entry.has_checksum());
    if (entry.has_batch()) {
      EXPECT_EQ(entry.batch().DebugString(), batches[steps++].DebugString());
    } else if (entry.has_told()) {
      EXPECT_EQ(published[told].first, steps) << "output " << told;
      EXPECT_EQ(entry.told().output().DebugString(), published[told++].second.DebugString());
      EXPECT_EQ(entry.told().wall_ns(), batches[steps == 0 ? 0 : steps - 1].wall_ns());
    }
  }
  EXPECT_EQ(steps, batches.size());
  EXPECT_EQ(told, published.size());
}

// Goal:   a step that is larger than an entry may be comes in parts, of which nothing is lost.
TEST(Transcript, AHugeStepComesInParts) {
  v1::RecordedBatch batch;
  batch.set_wall_ns(5);
  constexpr std::size_t kPartBytes = wire::kEntryBytesMax / 5 * 2;
  for (std::uint32_t part = 0; part < 3; ++part) {
    v1::ShapePart& one = *batch.add_inputs()->mutable_shape_part();
    one.set_part(part);
    one.set_bytes(std::string(kPartBytes, static_cast<char>('a' + part)));
  }
  std::ostringstream stream;
  Transcript transcript(&stream);
  transcript.Add(batch);
  batch.clear_inputs();
  transcript.Add(batch);
  const auto entries = EntriesIn(stream.str());
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_TRUE(entries[0].batch().continued());
  EXPECT_FALSE(entries[1].batch().continued());
  EXPECT_FALSE(entries[2].batch().continued());
  ASSERT_EQ(entries[0].batch().inputs_size(), 2);
  ASSERT_EQ(entries[1].batch().inputs_size(), 1);
  EXPECT_EQ(entries[2].batch().inputs_size(), 0);
  EXPECT_EQ(entries[1].batch().wall_ns(), 5);
  EXPECT_EQ(entries[1].batch().inputs(0).shape_part().bytes(), std::string(kPartBytes, 'c'));
}

}  // namespace
}  // namespace collision::server
