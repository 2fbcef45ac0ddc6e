// Goal:   what was put is there when the journal is opened again, whatever happened to the process
//         or to single records in between; what is damaged is told and harms nothing else.
// Method: a journal in a scratch folder beside a plain map that says what it must hold.
#include "server/claim/journal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>

namespace collision::server {
namespace {

constexpr std::size_t kSimulatorsMax = 8;
constexpr std::size_t kRecordBytes = 128;

class JournalTest : public testing::Test {
 protected:
  JournalTest() {
    std::string folder = testing::TempDir() + "journalXXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
  }
  ~JournalTest() override { std::filesystem::remove_all(folder_); }

  Journal Open() const { return Journal(folder_, "lab", 7, kSimulatorsMax); }
  std::string path() const { return folder_ + "/lab.7.journal"; }

  std::string ErrorOfOpening() const {
    try {
      Open();
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  void Spoil(std::size_t byte) const {
    std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(byte));
    const char old = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(byte));
    file.put(static_cast<char>(old ^ 1));
  }

  std::string folder_;
};

/// No file of this process can grow beyond a size while this lives: as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

JournalledSimulator Simulator(std::uint64_t id, std::int64_t granted_ns) {
  return {.id = id,
          .run = static_cast<std::uint32_t>(id + 1),
          .name = "simulator-" + std::to_string(id),
          .granted = Instant::FromNanoseconds(granted_ns)};
}

TEST_F(JournalTest, ANewOneKnowsNothing) {
  const Journal journal = Open();
  EXPECT_EQ(journal.term(), 0u);
  EXPECT_EQ(journal.epoch(), 0u);
  EXPECT_TRUE(journal.simulators().empty());
  EXPECT_TRUE(journal.damage().empty());
  EXPECT_EQ(journal.path(), path());
}

TEST_F(JournalTest, HoldsWhatAMapHoldsThroughAnyNumberOfStarts) {
  std::mt19937 random(1);
  std::map<std::uint64_t, JournalledSimulator> expected;
  std::uint32_t term = 0;
  for (int start = 0; start < 200; ++start) {
    Journal journal = Open();
    ASSERT_EQ(journal.simulators(), expected) << "start " << start;
    ASSERT_EQ(journal.term(), term);
    ASSERT_EQ(journal.epoch(), term == 0 ? 0 : term + 5);
    ASSERT_TRUE(journal.damage().empty());
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t id = random() % 30;
      if (random() % 3 == 0) {
        expected.erase(id);
        ASSERT_TRUE(journal.Remove(id));
      } else if (expected.contains(id) || expected.size() < kSimulatorsMax) {
        expected[id] = Simulator(id, random());
        if (random() % 4 == 0) expected[id].granted = std::nullopt;
        ASSERT_TRUE(journal.Put(expected[id]));
      }
    }
    ++term;
    ASSERT_TRUE(journal.SetTerm(term, term + 5));
    if (random() % 20 == 0) {
      expected.clear();
      ASSERT_TRUE(journal.RemoveAll());
    }
  }
  EXPECT_LE(std::filesystem::file_size(path()), (1 + kSimulatorsMax) * kRecordBytes);
}

TEST_F(JournalTest, TheLongestNameAndExtremeGrantsComeBack) {
  JournalledSimulator simulator = Simulator(1, 0);
  simulator.name = std::string(64, 'x');
  for (const Instant granted : {Instant::Always(), Instant(), Instant::Never()}) {
    simulator.granted = granted;
    ASSERT_TRUE(Open().Put(simulator));
    EXPECT_EQ(Open().simulators().at(1), simulator);
  }
}

TEST_F(JournalTest, IsOpenInOneProcessAtATime) {
  const Journal journal = Open();
  EXPECT_EQ(ErrorOfOpening(), path() + ": in use: another collisiond serves this world");
  const Journal of_another_world(folder_, "other", 7, kSimulatorsMax);
  const Journal of_another_domain(folder_, "lab", 8, kSimulatorsMax);
}

// A machine that loses its power may keep an old record beside the new one of a simulator.
TEST_F(JournalTest, OfTwoRecordsOfASimulatorTheHigherRunAndGrantCount) {
  const auto bytes_of = [this](std::size_t record) {
    std::ifstream file(path(), std::ios::binary);
    std::string bytes(kRecordBytes, '\0');
    file.seekg(static_cast<std::streamoff>(record * kRecordBytes));
    file.read(bytes.data(), kRecordBytes);
    return bytes;
  };
  const JournalledSimulator low = Simulator(5, 10), high = Simulator(5, 20);
  JournalledSimulator later = low;
  ++later.run;
  const std::pair<JournalledSimulator, JournalledSimulator> cases[] = {
      {low, high}, {high, low}, {high, later}, {later, high}};
  for (const auto& [first, second] : cases) {
    std::filesystem::remove(path());
    std::string old;
    {
      Journal journal = Open();
      journal.SetTerm(1, 1);
      journal.Put(first);
      old = bytes_of(1);
      journal.Remove(5);
      journal.Put(Simulator(6, 0));
      journal.Put(second);
      journal.Remove(6);
    }
    std::fstream(path(), std::ios::in | std::ios::out | std::ios::binary)
        .seekp(kRecordBytes)
        .write(old.data(), kRecordBytes);
    const bool first_counts =
        std::pair(first.run, first.granted) > std::pair(second.run, second.granted);
    const JournalledSimulator& expected = first_counts ? first : second;
    {
      Journal journal = Open();
      EXPECT_EQ(journal.simulators(),
                (std::map<std::uint64_t, JournalledSimulator>{{5, expected}}));
      EXPECT_EQ(journal.damage(),
                std::vector<std::string>{path() +
                                         ": byte 256: simulator \"simulator-5\" has "
                                         "another record before this one: the higher run and grant "
                                         "counts"});
      EXPECT_TRUE(journal.SetTerm(2, 1));
      EXPECT_TRUE(journal.Remove(5));
    }
    const Journal after = Open();
    EXPECT_TRUE(after.simulators().empty()) << "the other record comes back";
    EXPECT_TRUE(after.damage().empty());
  }
}

TEST_F(JournalTest, ADamagedRecordIsToldAndTheOthersStay) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    for (std::uint64_t id = 0; id < 3; ++id) journal.Put(Simulator(id, 10));
  }
  for (std::size_t byte = kRecordBytes; byte < 4 * kRecordBytes; ++byte) {
    Spoil(byte);
    const std::size_t record = byte / kRecordBytes;
    const Journal journal = Open();
    EXPECT_EQ(journal.simulators().size(), 2u) << "byte " << byte;
    EXPECT_FALSE(journal.simulators().contains(record - 1)) << "byte " << byte;
    EXPECT_EQ(journal.term(), 3u);
    ASSERT_EQ(journal.damage().size(), 1u);
    EXPECT_EQ(journal.damage()[0], path() + ": byte " + std::to_string(record * kRecordBytes) +
                                       ": a simulator does not fit its checksum");
    Spoil(byte);
  }
  EXPECT_EQ(Open().simulators().size(), 3u);
}

TEST_F(JournalTest, ARecordInAnothersPlaceIsDamage) {
  {
    Journal journal = Open();
    journal.SetTerm(1, 1);
    journal.Put(Simulator(0, 10));
    journal.Put(Simulator(1, 20));
  }
  std::string bytes(kRecordBytes, '\0');
  std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(kRecordBytes);
  file.read(bytes.data(), kRecordBytes);
  file.seekp(2 * kRecordBytes);
  file.write(bytes.data(), kRecordBytes);
  file.close();
  const Journal journal = Open();
  EXPECT_EQ(journal.simulators().size(), 1u);
  EXPECT_EQ(journal.damage().size(), 1u);
}

TEST_F(JournalTest, ADamagedTermIsToldAndTheRosterStays) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    journal.Put(Simulator(1, 10));
  }
  Spoil(8);
  const Journal journal = Open();
  EXPECT_EQ(journal.term(), 0u);
  EXPECT_EQ(journal.simulators().size(), 1u);
  ASSERT_EQ(journal.damage().size(), 1u);
  EXPECT_EQ(journal.damage()[0], path() + ": byte 0: the term does not fit its checksum");
}

TEST_F(JournalTest, ACutOffFileLosesItsLastRecordOnly) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    for (std::uint64_t id = 0; id < 3; ++id) journal.Put(Simulator(id, 10));
  }
  std::filesystem::resize_file(path(), 4 * kRecordBytes - 1);
  Journal journal = Open();
  EXPECT_EQ(journal.simulators().size(), 2u);
  EXPECT_EQ(journal.damage().size(), 1u);
  EXPECT_TRUE(journal.Put(Simulator(2, 11)));
}

TEST_F(JournalTest, WhateverItIsCutToIsToldUnlessNothingWasLost) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    for (std::uint64_t id = 0; id < 3; ++id) journal.Put(Simulator(id, 10));
  }
  const std::size_t whole = std::filesystem::file_size(path());
  ASSERT_EQ(whole, 4 * kRecordBytes);
  EXPECT_TRUE(Open().damage().empty());
  for (std::size_t size = whole; size-- > 0;) {
    std::filesystem::resize_file(path(), size);
    if (size > 0 && size < 8) {
      EXPECT_NE(ErrorOfOpening(), "") << size;  // Not even its first bytes are a journal's.
      continue;
    }
    const Journal journal = Open();
    EXPECT_FALSE(journal.damage().empty()) << size;
    EXPECT_EQ(journal.simulators().size(), size < kRecordBytes ? 0 : size / kRecordBytes - 1);
  }
  const Journal journal = Open();
  ASSERT_EQ(journal.damage().size(), 1u);
  EXPECT_EQ(journal.damage()[0],
            path() + ": byte 0: the file is empty: the term and all simulators are lost");
}

TEST_F(JournalTest, DamageIsOverOnceItsServiceServes) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    for (std::uint64_t id = 0; id < 4; ++id) journal.Put(Simulator(id, 10));
  }
  Spoil(kRecordBytes);
  Spoil(2 * kRecordBytes);
  std::filesystem::resize_file(path(), 4 * kRecordBytes);
  {
    Journal journal = Open();
    EXPECT_EQ(journal.damage().size(), 3u);
    EXPECT_TRUE(journal.Put(Simulator(7, 10)));
    EXPECT_TRUE(journal.SetTerm(4, 5));
  }
  const Journal journal = Open();
  EXPECT_TRUE(journal.damage().empty());
  EXPECT_EQ(journal.term(), 4u);
  EXPECT_EQ(journal.simulators().size(), 2u);
  EXPECT_TRUE(journal.simulators().contains(7));
}

// Goal:   with a smaller simulators_max none is lost in silence, nor comes back years later.
TEST_F(JournalTest, SimulatorsBeyondASmallerMaximumAreToldOnce) {
  {
    Journal journal = Open();
    journal.SetTerm(3, 4);
    for (std::uint64_t id = 0; id < 3; ++id) journal.Put(Simulator(id, 10));
    journal.Remove(2);
  }
  EXPECT_TRUE(Journal(folder_, "lab", 7, 2).damage().empty()) << "the third record is free";
  {
    Journal smaller(folder_, "lab", 7, 1);
    EXPECT_EQ(smaller.simulators().size(), 1u);
    ASSERT_EQ(smaller.damage().size(), 1u);
    EXPECT_EQ(smaller.damage()[0],
              path() + ": byte 256: simulators beyond simulators_max, which was larger: 1");
    smaller.SetTerm(4, 5);
  }
  EXPECT_TRUE(Open().damage().empty());
  EXPECT_EQ(Open().simulators().size(), 1u);
}

// Goal:   a journal whose first write fails leaves no empty file, which would count as damaged, and
//         what a process left that was killed while it began one harms no later one.
TEST_F(JournalTest, AnEmptyFileIsNeverLeftByABeginning) {
  {
    const FullDisk full(7);
    EXPECT_EQ(ErrorOfOpening(), path() + ": byte 0: cannot be written: No space left on device");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  std::ofstream(path() + ".new") << std::string(1000, 'x');
  EXPECT_TRUE(Open().damage().empty());
  EXPECT_EQ(std::filesystem::file_size(path()), kRecordBytes);
  EXPECT_FALSE(std::filesystem::exists(path() + ".new"));
}

TEST_F(JournalTest, WhatIsNoJournalIsLeftAlone) {
  std::ofstream(path()) << "somebody's notes";
  EXPECT_EQ(ErrorOfOpening(),
            path() + ": byte 0: not a journal of this version; move it away to begin anew");
  std::filesystem::remove(path());
  std::filesystem::create_symlink("/dev/null", path());
  EXPECT_NE(ErrorOfOpening(), "");
  std::filesystem::remove(path());
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_EQ(ErrorOfOpening(), path() + ": is no regular file");
}

TEST_F(JournalTest, AFolderThatCannotBeMadeIsNamed) {
  std::ofstream(folder_ + "/file") << "";
  try {
    Journal(folder_ + "/file/state", "lab", 7, kSimulatorsMax);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find(folder_ + "/file/state: cannot be made: "), 0u);
  }
}

TEST_F(JournalTest, ARemovedOneIsTold) {
  Journal journal = Open();
  EXPECT_TRUE(journal.SetTerm(1, 1));
  std::filesystem::remove_all(folder_);
  EXPECT_FALSE(journal.SetTerm(2, 1));
  EXPECT_EQ(journal.error(), journal.path() + ": was removed");
}

TEST_F(JournalTest, AFullDiskIsToldAndWhatWasWrittenStays) {
  {
    Journal journal = Open();
    ASSERT_TRUE(journal.SetTerm(3, 4));
    ASSERT_TRUE(journal.Put(Simulator(1, 10)));
    const FullDisk full(2 * kRecordBytes + 7);
    EXPECT_FALSE(journal.Put(Simulator(2, 20)));
    EXPECT_EQ(journal.error(), path() + ": byte 256: cannot be written: No space left on device");
    EXPECT_FALSE(journal.Put(Simulator(1, 30))) << "nothing more is written after a failure";
  }
  const Journal journal = Open();
  ASSERT_EQ(journal.simulators().size(), 1u);
  EXPECT_EQ(journal.simulators().at(1), Simulator(1, 10));
}

}  // namespace
}  // namespace collision::server
