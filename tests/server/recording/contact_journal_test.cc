// Goal:   every published contact is kept, through starts of the service, within a bound; what was
//         cut off is cut off at the next start.
#include "server/recording/contact_journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "idl/recording/entries.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

class ContactJournalTest : public testing::Test {
 protected:
  ContactJournalTest() { std::filesystem::remove_all(folder_); }
  ~ContactJournalTest() override { std::filesystem::remove_all(folder_); }

  RollingPlace Place(std::uint64_t bytes_max) const {
    return {.folder = folder_,
            .world_and_domain = "lab.0",
            .suffix = ".contacts",
            .limits = {.bytes_max = bytes_max}};
  }

  static void Tell(ContactJournal* journal, std::uint64_t number) {
    v1::CollisionEvent event;
    event.set_contacts_sequence(number);
    event.mutable_lower_label()->set_agent_name("ada");
    journal->Add(event);
    journal->Write(static_cast<std::int64_t>(1000 + number));
  }

  std::vector<wire::KeptFile> Files() const { return wire::KeptFilesIn(folder_, ".contacts"); }

  std::vector<std::uint64_t> Kept() const {
    std::vector<std::uint64_t> numbers;
    for (const wire::KeptFile& file : Files()) {
      wire::EntryReader reader(file.path);
      v1::RecordingEntry entry;
      while (reader.Next(&entry)) {
        if (!entry.has_contact()) continue;
        EXPECT_EQ(entry.contact().event().lower_label().agent_name(), "ada");
        numbers.push_back(entry.contact().event().contacts_sequence());
        EXPECT_EQ(entry.contact().wall_ns(), static_cast<std::int64_t>(1000 + numbers.back()));
      }
      EXPECT_EQ(reader.error(), "");
    }
    return numbers;
  }

  const std::string folder_ = TemporaryPath("contacts");
};

TEST_F(ContactJournalTest, GoesOnAfterAStartAndCutsOffADamagedTail) {
  {
    ContactJournal journal(Place(1 << 20));
    journal.Start(1);
    Tell(&journal, 1);
    Tell(&journal, 2);
  }
  const std::string path = Files().at(0).path;
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  {
    ContactJournal journal(Place(1 << 20));
    journal.Start(1);
    Tell(&journal, 3);
    EXPECT_EQ(journal.failure(), "");
    ContactJournal beside(Place(1 << 20));
    beside.Start(1);  // a standby, or a service that is about to end
    Tell(&beside, 4);
  }
  EXPECT_EQ(Files().size(), 2u);
  EXPECT_EQ(Kept(), (std::vector<std::uint64_t>{1, 3, 4}));
}

TEST_F(ContactJournalTest, AnotherLimitCountsFromTheNextContactOn) {
  ContactJournal journal(Place(1 << 20));
  journal.Start(1);
  for (std::uint64_t i = 1; i <= 200; ++i) Tell(&journal, i);
  ASSERT_EQ(Files().size(), 1u);
  journal.SetLimits({.bytes_max = 4'000});
  for (std::uint64_t i = 201; i <= 400; ++i) Tell(&journal, i);
  std::uint64_t bytes = 0;
  for (const wire::KeptFile& file : Files()) bytes += file.bytes;
  EXPECT_LE(bytes, 4'000u);
  EXPECT_GE(bytes, 3'000u);
  EXPECT_EQ(Kept().back(), 400u);
}

// Goal:   damage in the middle costs what is damaged, and nothing behind it is written over.
TEST_F(ContactJournalTest, AFileThatIsDamagedInTheMiddleStaysAsItIs) {
  {
    ContactJournal journal(Place(1 << 20));
    journal.Start(1);
    for (std::uint64_t number = 1; number <= 9; ++number) Tell(&journal, number);
  }
  const std::string path = Files().at(0).path;
  const auto bytes = std::filesystem::file_size(path);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
      .seekp(static_cast<std::streamoff>(bytes / 2))
      .put('\x7f')
      .put('\x7f');
  ContactJournal journal(Place(1 << 20));
  journal.Start(2'000'000'000);
  Tell(&journal, 10);
  EXPECT_EQ(Files().size(), 2u);
  EXPECT_EQ(std::filesystem::file_size(path), bytes);
}

TEST_F(ContactJournalTest, TheOldestGo) {
  ContactJournal journal(Place(16'000));
  journal.Start(1);
  for (std::uint64_t number = 1; number <= 2000; ++number) Tell(&journal, number);
  std::uint64_t bytes = 0;
  for (const wire::KeptFile& file : Files()) bytes += file.bytes;
  EXPECT_LE(bytes, 16'500u);
  const std::vector<std::uint64_t> kept = Kept();
  ASSERT_GT(kept.size(), 100u);
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_EQ(kept[i], kept[i - 1] + 1);
  EXPECT_EQ(kept.back(), 2000u);
}

TEST_F(ContactJournalTest, BeginsAnewWhereItsFileWasRemoved) {
  ContactJournal journal(Place(1 << 20));
  journal.Start(1);
  Tell(&journal, 1);
  std::filesystem::remove_all(folder_);
  Tell(&journal, 2);
  EXPECT_EQ(journal.failure(), "");
  EXPECT_EQ(Kept(), std::vector<std::uint64_t>{2});
}

TEST_F(ContactJournalTest, WhatCannotBeWrittenIsTriedAgainAfterAMinute) {
  { std::ofstream(folder_) << "in the way"; }
  ContactJournal journal(Place(1 << 20));
  journal.Start(1);
  EXPECT_NE(journal.failure(), "");
  Tell(&journal, 1);
  std::filesystem::remove(folder_);
  Tell(&journal, 2);
  EXPECT_NE(journal.failure(), "");
  Tell(&journal, 100'000'000'000);
  EXPECT_EQ(journal.failure(), "") << "a minute has passed";
  EXPECT_EQ(Kept(), std::vector<std::uint64_t>{100'000'000'000});
}

}  // namespace
}  // namespace collision::server
