// Goal:   what a service has kept is found by its world and time, also what is damaged.
// Method: files are written by hand, without a service.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "client/programs/tools/collisionctl/kept/kept_contacts.h"
#include "client/programs/tools/collisionctl/kept/kept_options.h"
#include "client/programs/tools/collisionctl/kept/recordings.h"
#include "idl/recording/entries.h"
#include "idl/recording/utc.h"
#include "idl/recording_format.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kNow = 1'790'000'000 * kSecond;  // 2026-09-21T14:13:20Z

std::string At(const std::string& word) {
  const auto time = WallTimeOf(word, kNow);
  return time ? wire::UtcText(*time) : "none";
}

TEST(KeptOptions, TimesAreThoseOfPeople) {
  EXPECT_EQ(At("0"), "2026-09-21T14:13:20.000Z");
  EXPECT_EQ(At("2h"), "2026-09-21T12:13:20.000Z");
  EXPECT_EQ(At("1.5d"), "2026-09-20T02:13:20.000Z");
  EXPECT_EQ(At("TODAY"), "2026-09-21T00:00:00.000Z");
  EXPECT_EQ(At("YESTERDAY"), "2026-09-20T00:00:00.000Z");
  EXPECT_EQ(At("2026-11-28"), "2026-11-28T00:00:00.000Z");
  EXPECT_EQ(At("2026-11-28T03:00Z"), "2026-11-28T03:00:00.000Z");
  EXPECT_EQ(At("2026-11-28T03:00:07.25"), "2026-11-28T03:00:07.250Z");
  for (const char* wrong : {"", "2026-02-30", "2026-11-28T24:00", "1e9d", "-1", "yesterday", "2w",
                            "28.11.2026", "1e10", "2026-11-28 03:00"}) {
    EXPECT_EQ(At(wrong), "none") << wrong;
  }
}

// Goal:   a number of seconds means what it has always meant: the newest of what is told now.
TEST(KeptOptions, ANumberOfSecondsIsOfTheRunningWorld) {
  KeptOptions options;
  EXPECT_FALSE(AsksForJournal(options));
  options.since = "30";
  EXPECT_EQ(SinceSeconds(options), 30.0);
  EXPECT_FALSE(AsksForJournal(options));
  options.since = "30s";
  EXPECT_FALSE(SinceSeconds(options));
  EXPECT_TRUE(AsksForJournal(options));
  options.since = "30";
  options.state_dir = "/there";
  EXPECT_TRUE(AsksForJournal(options));
  EXPECT_EQ(StateFolder(options, "lab"), "/there");
}

class KeptFilesTest : public testing::Test {
 protected:
  KeptFilesTest() {
    for (const char* folder : {"/recordings", "/contacts"}) {
      std::filesystem::create_directories(folder_ + folder);
    }
    v1::RecordingEntry header;
    header.mutable_header()->set_format(wire::kRecordingFormat);
    std::string recording, contacts;
    wire::AppendEntry(header, &contacts);
    header.mutable_header()->set_segment(1);
    wire::AppendEntry(header, &recording);
    for (int i = 0; i < 3; ++i) {
      v1::RecordingEntry batch, contact;
      batch.mutable_batch()->set_wall_ns(kNow + i * kSecond);
      v1::Input* input = batch.mutable_batch()->add_inputs();
      input->mutable_simulator_clock()->set_simulator_id(7 + i % 2);
      wire::AppendEntry(batch, &recording);
      contact.mutable_contact()->set_wall_ns(kNow + i * kSecond);
      contact.mutable_contact()->mutable_event()->set_contact(1 + i);
      wire::AppendEntry(contact, &contacts);
    }
    Write("/recordings/lab.0.20260921T141320.000Z.rec", recording);
    Write("/recordings/lab.0.20260921T141330.000Z.rec", recording + "\x20 cut");
    Write("/recordings/notes.txt", "of somebody");
    Write("/contacts/lab.0.20260921T141320.000Z.contacts", contacts);
    Write("/contacts/lab.1.20260921T141320.000Z.contacts", contacts);
  }
  ~KeptFilesTest() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ + name, std::ios::binary) << bytes;
  }

  const std::string folder_ = testing::TempDir() + "kept_test." + std::to_string(getpid());
};

TEST_F(KeptFilesTest, SegmentsAreListedWithWhatIsInThem) {
  const std::vector<SegmentFacts> segments = SegmentsIn(folder_);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].batches, 3u);
  EXPECT_EQ(segments[0].simulators, 2u);
  EXPECT_EQ(segments[0].contacts, 3u);
  EXPECT_EQ(segments[0].damage, "");
  EXPECT_EQ(segments[1].batches, 3u);
  EXPECT_TRUE(segments[1].damage.ends_with(": cut off")) << segments[1].damage;
  EXPECT_EQ(SegmentsIn(folder_ + "/recordings").size(), 2u);
  const std::string page = RecordingsPage(segments);
  EXPECT_NE(page.find("2026-09-21T14:13:20.000Z 2026-09-21T14:13:22.000Z"), std::string::npos)
      << page;
  EXPECT_NE(page.find("\n  damaged: " + segments[1].file.path + ": byte "), std::string::npos);
  EXPECT_EQ(ComplaintsAbout({RecordingsJson(folder_, segments)}), "");
  EXPECT_TRUE(SegmentsIn(folder_ + "/none").empty());
}

TEST_F(KeptFilesTest, ContactsAreThoseOfTheWorldAndTime) {
  std::vector<std::uint32_t> contacts;
  const auto take = [&](const v1::ToldContact& one) { contacts.push_back(one.event().contact()); };
  std::string complaints;
  const auto complain = [&](const std::string& line) { complaints += line; };
  EXPECT_EQ(ReadContacts(folder_, "lab.0", {.since_ns = kNow + kSecond}, take, complain), 1u);
  EXPECT_EQ(contacts, (std::vector<std::uint32_t>{2, 3}));
  contacts.clear();
  EXPECT_EQ(ReadContacts(folder_, "lab.0", {.until_ns = kNow}, take, complain), 1u);
  EXPECT_EQ(contacts, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(ReadContacts(folder_, "lab.2", {}, take, complain), 0u);
  EXPECT_EQ(complaints, "");
}

// Goal:   each contact is listed with the time at which it was told, and once, though a service
//         that took over has told it again; not left out where it only bears the same number.
TEST_F(KeptFilesTest, ContactsAreListedOnceAndWithTheirTime) {
  std::string bytes;
  for (const auto& [service, contact, begin_s] :
       {std::tuple(1, 1, 7), {1, 1, 8}, {2, 1, 7}, {2, 1, 8}, {2, 1, 90}, {2, 2, 7}}) {
    v1::RecordingEntry entry;
    entry.mutable_contact()->set_wall_ns(kNow + service * kSecond);
    v1::CollisionEvent& event = *entry.mutable_contact()->mutable_event();
    event.mutable_stamp()->set_service_id(static_cast<std::uint64_t>(service));
    event.set_contact(static_cast<std::uint32_t>(contact));
    event.set_revision(1);
    event.mutable_begin()->set_earliest_ns(begin_s * kSecond);
    event.set_contacts_sequence(static_cast<std::uint64_t>(contact));
    event.set_status(v1::EVENT_CONFIRMED);
    wire::AppendEntry(entry, &bytes);
  }
  v1::RecordingEntry header;
  header.mutable_header()->set_format(wire::kRecordingFormat);
  std::string head;
  wire::AppendEntry(header, &head);
  bytes.insert(0, head);
  Write("/contacts/lab.5.20260921T141320.000Z.contacts", bytes);
  KeptOptions options;
  options.state_dir = folder_;
  for (const bool json : {false, true}) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(PrintKeptContacts(options, "lab", 5, {.json = json}, {}), 0);
    const std::string out = testing::internal::GetCapturedStdout();
    EXPECT_EQ(std::ranges::count(out, '\n'), 4) << out;
    EXPECT_NE(out.find("2026-09-21T14:13:21.000Z"), std::string::npos) << out;
    EXPECT_NE(out.find("2026-09-21T14:13:22.000Z"), std::string::npos) << out;
    if (!json) continue;
    EXPECT_EQ(ComplaintsAbout({out.substr(0, out.find('\n'))}), "");
  }
  // What cannot be read is told, also by the exit code.
  for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() - 3)}) {
    Write("/contacts/lab.5.20260921T141321.000Z.contacts", damaged);
    testing::internal::CaptureStdout();
    EXPECT_EQ(PrintKeptContacts(options, "lab", 5, {}, {}), 74);
    testing::internal::GetCapturedStdout();
  }
  options.since = "2026-09-22";
  options.until = "2026-09-21";
  EXPECT_EQ(PrintKeptContacts(options, "lab", 5, {}, {}), 2);
}

}  // namespace
}  // namespace collision::client
