#include "server/recording/recording.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <sstream>
#include <vector>

#include "server/config/config.h"
#include "tests/support/random.h"

namespace collision::server {
namespace {

const v1::Config& Complete() {
  static const v1::Config config = CompleteConfig({});
  return config;
}

v1::RecordedBatch Batch(int number) {
  v1::RecordedBatch batch;
  batch.set_wall_ns(1'000'000'000'000 + number);
  batch.set_monotonic_ns(number);
  for (int i = 0; i < number % 5; ++i) {
    v1::Input* input = batch.add_inputs();
    input->set_sender(i);
    input->mutable_simulator_clock()->set_clock_ns(number);
  }
  return batch;
}

class RecordingTest : public testing::Test {
 protected:
  ~RecordingTest() override { std::remove(path_.c_str()); }

  /// Returns where each entry ends: the header, then each batch.
  std::vector<std::size_t> WriteBatches(int count) {
    std::vector<std::size_t> ends;
    RecordingWriter writer(path_, Complete());
    ends.push_back(Content().size());
    for (int i = 0; i < count; ++i) {
      EXPECT_TRUE(writer.Record(Batch(i)));
      ends.push_back(Content().size());
    }
    EXPECT_EQ(writer.error(), "");
    return ends;
  }

  /// Reads to the end, expecting the batches from 0 on; returns their number.
  int CountBatches(RecordingReader& reader) {
    int count = 0;
    while (const auto batch = reader.Next()) {
      EXPECT_EQ(batch->SerializeAsString(), Batch(count).SerializeAsString());
      ++count;
    }
    return count;
  }

  std::string Content() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

  void SetContent(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }

  /// The one line that the reader refuses the file with.
  std::string RefusalOf(const std::string& bytes) {
    SetContent(bytes);
    try {
      RecordingReader reader(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_ = testing::TempDir() + "recording_test." + std::to_string(getpid());
};

// Goal:   what was recorded is read back, configuration included, and each batch is in the file
//         as soon as Record() has returned.
TEST_F(RecordingTest, ReadsBackWhatWasWritten) {
  const std::vector<std::size_t> ends = WriteBatches(20);
  for (std::size_t i = 1; i < ends.size(); ++i) EXPECT_GT(ends[i], ends[i - 1]);
  RecordingReader reader(path_);
  EXPECT_EQ(reader.config().SerializeAsString(), Complete().SerializeAsString());
  EXPECT_EQ(CountBatches(reader), 20);
  EXPECT_EQ(reader.error(), "");
  EXPECT_FALSE(reader.Next());
}

// Goal:   a recording made with a method that is no longer there (FACE_SWEEP, 3) is read: methods
//         differ in cost only.
TEST_F(RecordingTest, AMethodThatIsNoLongerThereIsReadAsAuto) {
  v1::Config config = CompleteConfig({});
  config.set_broad_phase(static_cast<v1::Config::BroadPhase>(3));
  { RecordingWriter writer(path_, config); }
  const v1::Config read = RecordingReader(path_).config();
  EXPECT_EQ(read.broad_phase(), v1::Config::AUTO);
  EXPECT_TRUE(CheckConfig(read).empty());
}

// Goal:   a recording cut off anywhere gives every complete batch, and an error with the byte
//         offset of the first incomplete one; cut between two entries it is simply shorter.
// Method: every length of a recording of eight batches.
TEST_F(RecordingTest, CutOffAnywhereGivesWhatIsComplete) {
  const std::vector<std::size_t> ends = WriteBatches(8);
  const std::string whole = Content();
  for (std::size_t length = ends[0]; length <= whole.size(); ++length) {
    SetContent(whole.substr(0, length));
    std::size_t complete = 0;
    while (complete + 1 < ends.size() && ends[complete + 1] <= length) ++complete;
    RecordingReader reader(path_);
    EXPECT_EQ(CountBatches(reader), static_cast<int>(complete));
    const std::string error = path_ + ": byte " + std::to_string(ends[complete]) + ": cut off";
    EXPECT_EQ(reader.error(), length == ends[complete] ? "" : error);
  }
  EXPECT_EQ(RefusalOf(whole.substr(0, ends[0] - 1)), path_ + ": byte 0: cut off");
  EXPECT_EQ(RefusalOf(""), path_ + ": byte 0: empty, not a recording");
}

// Goal:   damage never makes a program of the reader's fail: it ends in batches, then perhaps one
//         error with a byte offset.
// Method: 300 recordings with up to four random bytes changed.
TEST_F(RecordingTest, DamageIsAnErrorAtMost) {
  WriteBatches(8);
  const std::string whole = Content();
  Random random(3);
  int refused = 0, ended_early = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    for (std::uint64_t n = 1 + random.Below(4); n > 0; --n) {
      bytes[random.Below(bytes.size())] = static_cast<char>(random.Below(256));
    }
    SetContent(bytes);
    try {
      RecordingReader reader(path_);
      while (reader.Next()) {
      }
      ended_early += reader.error().starts_with(path_ + ": byte ");
    } catch (const std::runtime_error& error) {
      ++refused;
      EXPECT_TRUE(std::string(error.what()).starts_with(path_ + ": byte 0: ")) << error.what();
    }
  }
  EXPECT_GT(refused, 15);
  EXPECT_GT(ended_early, 15);
}

// Goal:   a well-formed entry that is no batch, such as a second header, is an error too.
TEST_F(RecordingTest, RefusesASecondHeader) {
  const std::size_t end = WriteBatches(1).back();
  const std::string whole = Content();
  SetContent(whole + whole);
  RecordingReader reader(path_);
  EXPECT_EQ(CountBatches(reader), 1);
  EXPECT_EQ(reader.error(), path_ + ": byte " + std::to_string(end) + ": damaged: not a batch");
}

// Goal:   files that are something else are refused by one line that says so.
TEST_F(RecordingTest, RefusesOtherFiles) {
  EXPECT_EQ(RefusalOf("# Shared by all programs of the world.\nworld: \"default\"\n"),
            path_ + ": byte 0: not a recording");
  EXPECT_EQ(RefusalOf(std::string(1, '\0')), path_ + ": byte 0: not a recording: it has no header");
  // A header of format 2, by version "0.0.1".
  EXPECT_EQ(RefusalOf("\x0b\x0a\x09\x08\x02\x12\x05"
                      "0.0.1"),
            path_ +
                ": byte 0: format 2, written by version \"0.0.1\"; this program reads format 3 "
                "only: use the version that wrote it");
  EXPECT_EQ(RefusalOf(std::string("\xff\xff\xff\xff\xff\xff", 6)),
            path_ + ": byte 0: damaged: not a valid entry length");
  EXPECT_THROW(RecordingReader(path_ + ".missing"), std::runtime_error);
  EXPECT_THROW(RecordingReader("/"), std::runtime_error);
}

// Goal:   an entry of 64 MiB is read as far as it is there; one byte more is refused before
//         anything is allocated for it.
TEST_F(RecordingTest, BoundsTheSizeOfAnEntry) {
  EXPECT_EQ(RefusalOf(std::string("\x80\x80\x80\x20", 4)), path_ + ": byte 0: cut off");
  EXPECT_EQ(RefusalOf(std::string("\x81\x80\x80\x20", 4)),
            path_ + ": byte 0: damaged: an entry of 67108865 bytes");
}

/// Twice as many bytes as an entry may have, in inputs of 1 MiB that differ.
v1::RecordedBatch LargeBatch() {
  v1::RecordedBatch batch = Batch(0);
  batch.set_wall_was_set(true);
  batch.set_earliest_readers(3);
  for (int i = 0; i < 130; ++i) {
    v1::Input& input = *batch.add_inputs();
    input.set_sender(i);
    input.mutable_shape_part()->set_bytes(std::string(1 << 20, static_cast<char>('a' + i % 26)));
  }
  return batch;
}

// Goal:   a batch of any size is recorded, in several entries, and read back as one.
TEST_F(RecordingTest, ALargeBatchIsReadBackAsOne) {
  {
    RecordingWriter writer(path_, Complete());
    ASSERT_TRUE(writer.Record(Batch(0)));
    ASSERT_TRUE(writer.Record(LargeBatch()));
    ASSERT_TRUE(writer.Record(Batch(2)));
    EXPECT_EQ(writer.error(), "");
  }
  RecordingReader reader(path_);
  EXPECT_EQ(reader.Next()->SerializeAsString(), Batch(0).SerializeAsString());
  EXPECT_TRUE(reader.Next()->SerializeAsString() == LargeBatch().SerializeAsString());
  EXPECT_EQ(reader.Next()->SerializeAsString(), Batch(2).SerializeAsString());
  EXPECT_FALSE(reader.Next());
  EXPECT_EQ(reader.error(), "");
}

// Goal:   of a large batch that is cut off, between two of its entries or in one, nothing is read.
TEST_F(RecordingTest, ALargeBatchThatIsCutOffIsLeftOut) {
  std::vector<std::size_t> ends = WriteBatches(2);
  {
    RecordingWriter writer(path_, Complete());
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(writer.Record(Batch(i)));
    ASSERT_TRUE(writer.Record(LargeBatch()));
  }
  const std::string whole = Content();
  std::size_t first_length = 0;
  for (int i = 0; i < 4; ++i) {
    first_length |= static_cast<std::size_t>(whole[ends.back() + i] & 0x7f) << (7 * i);
  }
  for (const std::size_t end : {ends.back() + 4 + first_length, whole.size() - 1}) {
    SetContent(whole.substr(0, end));
    RecordingReader reader(path_);
    EXPECT_EQ(CountBatches(reader), 2);
    EXPECT_TRUE(reader.error().ends_with(": cut off")) << reader.error();
  }
}

// Goal:   former recordings are kept, as many as the limit says, and the oldest goes.
TEST_F(RecordingTest, FormerRecordingsAreKept) {
  KeepFormerRecordings(path_);  // there is none
  const auto name = [this](int number) { return path_ + "." + std::to_string(number); };
  for (int run = 0; run <= kFormerRecordingsMax + 1; ++run) {
    KeepFormerRecordings(path_);
    SetContent("run " + std::to_string(run));
  }
  SetContent("");
  KeepFormerRecordings(path_);  // an empty file holds nothing
  for (int number = 1; number <= kFormerRecordingsMax; ++number) {
    std::ostringstream text;
    text << std::ifstream(name(number)).rdbuf();
    EXPECT_EQ(text.str(), "run " + std::to_string(kFormerRecordingsMax + 1 - number));
    std::remove(name(number).c_str());
  }
  EXPECT_NE(access(name(kFormerRecordingsMax + 1).c_str(), F_OK), 0);
  KeepFormerRecordings("/dev/null");
  EXPECT_EQ(access("/dev/null.1", F_OK), -1);
}

// Goal:   the writer writes nothing that the reader would refuse for its size.
TEST_F(RecordingTest, RefusesToWriteAnEntryBeyondTheBound) {
  RecordingWriter writer(path_, Complete());
  v1::RecordedBatch batch;
  batch.add_inputs()->mutable_agent_description()->set_agent_name(std::string(64 << 20, 'x'));
  EXPECT_FALSE(writer.Record(batch));
  EXPECT_NE(writer.error(), "");
}

// Goal:   a file that cannot be written fails at once, with file and cause.
TEST_F(RecordingTest, FailsAtOnceWhereNothingCanBeWritten) {
  EXPECT_THROW(RecordingWriter("/", Complete()), std::runtime_error);
  try {
    RecordingWriter("/dev/full", Complete());
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/dev/full: byte 0: cannot be written: No space left on device");
  }
}

// Goal:   when the disk is full later on, Record() says so and keeps saying so, and what was
//         recorded before remains readable.
// Method: a limit on the size of files stands for the disk.
TEST_F(RecordingTest, FullDiskEndsTheRecording) {
  std::signal(SIGXFSZ, SIG_IGN);
  RecordingWriter writer(path_, Complete());
  ASSERT_TRUE(writer.Record(Batch(0)));
  ASSERT_TRUE(writer.Record(Batch(1)));
  const std::size_t size = Content().size();
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{size + 3, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_FALSE(writer.Record(Batch(2)));
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(writer.error(),
            path_ + ": byte " + std::to_string(size) + ": cannot be written: File too large");
  EXPECT_FALSE(writer.Record(Batch(3))) << "a gap would be worse than an end";
  RecordingReader reader(path_);
  EXPECT_EQ(CountBatches(reader), 2);
  EXPECT_EQ(reader.error(), "") << "the part of a batch is taken off the end";
}

}  // namespace
}  // namespace collision::server
