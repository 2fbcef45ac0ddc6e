// Goal:   a world is written as it was heard: each message with the world's time and the wall's,
//         and what the page needs, in an order that a reader by time keeps.
// Method: messages by hand through a receiver without a network; the files are taken apart by hand.
#include "client/programs/recordings/world_recorder.h"

#include <algorithm>
#include <filesystem>

#include "tests/client/programs/recordings/mcap_records.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"
#include "tests/support/temporary_path.h"

namespace collision::client {
namespace {

constexpr std::int64_t kTenthNs = 100'000'000;

class WorldRecorderTest : public CollisionctlTest {
 protected:
  ~WorldRecorderTest() override { std::filesystem::remove(Second()); }

  std::string Second() const {
    const std::filesystem::path path(path_);
    return (path.parent_path() / (path.stem().string() + ".2" + path.extension().string()))
        .string();
  }

  /// A status of that epoch and time is heard with all that is in `next_`.
  void Hear(std::uint32_t epoch, std::int64_t now_ns) {
    v1::ServiceStatus* status = Status();
    status->mutable_stamp()->set_service_id(1);
    status->mutable_stamp()->set_epoch(epoch);
    status->mutable_stamp()->set_sequence(++sequence_);
    status->set_now_ns(now_ns);
    recorder_.Poll({});
    wall_ns_ += kTenthNs;
  }

  void PlaceAt(std::int64_t stamp_ns, double x_m) {
    Place(1, 1);
    v1::AgentState* state = next_.inputs.back().mutable_agent_states()->mutable_states(0);
    state->set_stamp_ns(stamp_ns);
    state->mutable_position_m()->set_x(x_m);
  }

  static std::vector<McapMessage> PagesIn(const std::string& path) {
    std::vector<McapMessage> pages = McapMessagesOf(path);
    std::erase_if(pages, [](const McapMessage& message) { return message.topic != "/page"; });
    return pages;
  }

  const std::string path_ = TemporaryPath("world.mcap");
  std::int64_t wall_ns_ = 1'000'000;
  std::uint64_t sequence_ = 0;
  WorldRecorder recorder_{std::make_unique<FakeReceiver>(&next_),
                          {.path = path_, .rate_hz = 10, .wall_ns = [this] { return wall_ns_; }}};
};

TEST_F(WorldRecorderTest, EachMessageHasBothTimesAndItsBytes) {
  Describe("ada", 1, 0);
  const std::string description = next_.inputs.back().agent_description().SerializeAsString();
  Hear(1, 7);
  recorder_.Close();
  const auto messages = McapMessagesOf(path_);
  ASSERT_EQ(messages.size(), 3u + 5u) << "and those for Foxglove";
  EXPECT_EQ(messages[0].topic, "collision/v1/agent_description");
  EXPECT_EQ(messages[0].data, description);
  EXPECT_EQ(messages[1].topic, "collision/v1/service_status");
  EXPECT_EQ(messages[2].topic, "/page");
  for (const McapMessage& message : messages) {
    EXPECT_EQ(message.log_time, 7u);
    EXPECT_EQ(message.publish_time, 1'000'000u);
  }
  for (const char* topic : {"/scene", "/status", "/log", "/numbers/world", "/numbers/nearest"}) {
    EXPECT_EQ(std::ranges::count(messages, topic, &McapMessage::topic), 1) << topic;
  }
  EXPECT_EQ(recorder_.files().at(path_), messages.size());
}

TEST_F(WorldRecorderTest, NoTimeIsBeforeZero) {
  Describe("ada", 1, 0);
  Hear(1, -3'000'000'000);
  Hear(1, std::numeric_limits<std::int64_t>::min());  // it has no time yet
  recorder_.Close();
  const auto messages = McapMessagesOf(path_);
  ASSERT_GE(messages.size(), 3u);
  for (const McapMessage& message : messages) EXPECT_EQ(message.log_time, 0u) << message.topic;
}

TEST_F(WorldRecorderTest, TimeThatBeginsAnewGoesOnInASecondFile) {
  Describe("ada", 1, 0);
  Hear(1, 50 * kTenthNs);
  Hear(2, 0);  // belongs to the former one as long as nobody is there
  EXPECT_FALSE(std::filesystem::exists(Second()));
  Describe("ada", 2, 0);
  Hear(2, 0);
  recorder_.Close();
  const auto first = McapMessagesOf(path_);
  EXPECT_EQ(std::ranges::count(first, "collision/v1/service_status", &McapMessage::topic), 2);
  EXPECT_EQ(std::ranges::count(first, "collision/v1/agent_description", &McapMessage::topic), 1);
  const auto second = McapMessagesOf(Second());
  ASSERT_FALSE(second.empty());
  EXPECT_EQ(second[0].topic, "collision/v1/agent_description");
  EXPECT_EQ(second[0].sequence, 0u);
  const auto pages = PagesIn(Second());
  ASSERT_EQ(pages.size(), 1u) << "a page that has nothing gets all";
  EXPECT_NE(pages[0].data.find("\"agent\""), std::string::npos);
  EXPECT_EQ(recorder_.files().size(), 2u);
}

// Goal:   so does that of an epoch which was shorter than times may go back within one.
TEST_F(WorldRecorderTest, AShortEpochEndsAsWell) {
  Describe("ada", 1, 0);
  Hear(1, 5 * kTenthNs);
  Hear(2, 0);
  Describe("ada", 2, 0);
  Hear(2, kTenthNs);
  recorder_.Close();
  ASSERT_TRUE(std::filesystem::exists(Second()));
  EXPECT_EQ(PagesIn(Second()).size(), 1u);
}

// Goal:   a reader by time gets the page's messages in the order in which they build upon each
//         other.
TEST_F(WorldRecorderTest, PagesKeepTheirOrderWhereTimeGoesBackALittle) {
  Describe("ada", 1, 0);
  for (const int tenth : {10, 11, 12, 13, 9}) {
    PlaceAt(tenth * kTenthNs, tenth);
    Hear(1, tenth * kTenthNs);
  }
  recorder_.Close();
  const auto pages = PagesIn(path_);
  ASSERT_EQ(pages.size(), 5u);
  for (std::size_t i = 1; i < pages.size(); ++i) {
    EXPECT_GE(pages[i].log_time, pages[i - 1].log_time) << i;
  }
}

// Goal:   in lock-step simulators tell states while the service's time stands still: the page has
//         each of them, not the newest alone; states closer than the rate asks for, it need not.
TEST_F(WorldRecorderTest, StatesThatComeWhileTimeStandsStillAreAllOnThePage) {
  Describe("ada", 1, 0);
  for (const int tenth : {0, 20, 30, 40}) {
    PlaceAt(tenth * kTenthNs, tenth);
    Hear(1, 0);
  }
  for (int i = 0; i < 5; ++i) {
    PlaceAt(40 * kTenthNs + i, i);
    Hear(1, 0);
  }
  recorder_.Close();
  EXPECT_EQ(PagesIn(path_).size(), 5u) << "at first without it, three states, and the last";
}

TEST_F(WorldRecorderTest, AFileThatIsLeftHasAllUpToTheLastSecondOfTheWall) {
  Describe("ada", 1, 0);
  for (int i = 0; i < 15; ++i) Hear(1, i * kTenthNs);
  int chunks = 0;
  for (const McapRecord& record : McapRecordsIn(BytesOfFile(path_), kMcapMagicBytes)) {
    chunks += record.opcode == 6;
  }
  EXPECT_EQ(chunks, 2) << "at the begin, and a second later";
}

}  // namespace
}  // namespace collision::client
