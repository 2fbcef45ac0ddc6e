// Goal:   channels without a reader keep nothing; one with readers has what stands: events, status,
//         sentences and numbers.
// Method: messages by hand; numbers are read back by the layout that their schema says.
#include "client/programs/foxglove/foxglove_channels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

#include "client/programs/foxglove/channels/log_channel.h"
#include "tests/client/programs/foxglove/foxglove_fixture.h"

namespace collision::client {
namespace {

class FoxgloveChannelsTest : public FoxgloveTest {
 protected:
  std::size_t Kept() const {
    std::size_t all = 0;
    for (const Channel& channel : Channels()) {
      all += channels_.kept(static_cast<ChannelId>(channel.id));
    }
    return all;
  }

  template <class Number>
  static Number At(std::string_view bytes, std::size_t at) {
    Number number{};
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
  }

  std::atomic<bool> is_over_ = false;
};

TEST_F(FoxgloveChannelsTest, AChannelWithoutReadersKeepsNothing) {
  Describe(Agent(0));
  Place(0, 1);
  all_.status(Status(1));
  all_.event(Event(v1::EVENT_CONFIRMED));
  Step();
  EXPECT_EQ(Kept(), 0u);
  {
    ChannelReader reader(&channels_, ChannelId::kScene);
    ChannelReader other(&channels_, ChannelId::kScene);
    Step();
    EXPECT_GT(channels_.kept(ChannelId::kScene), 0u);
    EXPECT_EQ(channels_.kept(ChannelId::kScene), Kept()) << "of the others nothing";
  }
  Place(0, 2);
  Step();
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(FoxgloveChannelsTest, AReaderThatComesAgainGetsWhatChangedMeanwhile) {
  Describe(Agent(0));
  all_.status(Status(1));
  {
    ChannelReader reader(&channels_, ChannelId::kScene);
    Step();
  }
  Step();
  Remove(0);
  Describe(Agent(1));
  Step();
  ChannelReader reader(&channels_, ChannelId::kScene);
  Step();
  Panel panel;
  panel.Take(News<foxglove::SceneUpdate>(&reader));
  EXPECT_EQ(panel.size(), 1u);
  EXPECT_TRUE(panel.Has("agent/1"));
}

TEST_F(FoxgloveChannelsTest, ReadersMayBeOnAnotherThread) {
  std::thread other([this] {
    for (int round = 0; round < 20; ++round) {
      ChannelReader scene(&channels_, ChannelId::kScene), status(&channels_, ChannelId::kStatus);
      std::int64_t newest = 0;
      while (newest == 0) {
        const Payload payload = status.Next();
        if (payload) newest = TimeOf(*payload);
        EXPECT_GE(channels_.now_ns(), newest) << "time is told before its messages";
        while (scene.Next()) continue;
      }
    }
    is_over_ = true;
  });
  for (int now = 1; !is_over_; ++now) {
    all_.status(Status(now));
    Describe(Agent(static_cast<std::uint32_t>(now % 10)));
    Step();
  }
  other.join();
}

TEST_F(FoxgloveChannelsTest, MessagesBearTheTimeOfTheWorld) {
  ChannelReader reader(&channels_, ChannelId::kStatus);
  all_.status(Status(0x0102'0304'0506'0708));
  Step();
  const Payload payload = reader.Next();
  ASSERT_TRUE(payload);
  EXPECT_EQ(payload->substr(0, 8), "\x08\x07\x06\x05\x04\x03\x02\x01");
  EXPECT_EQ(TimeOf(*payload), 0x0102'0304'0506'0708);
  v1::ServiceStatus status;
  ASSERT_TRUE(status.ParseFromString(std::string(MessageOf(*payload))));
  EXPECT_EQ(status.world(), "lab");
  EXPECT_FALSE(reader.Next());
  Step();
  EXPECT_FALSE(reader.Next()) << "it is told once";
}

TEST_F(FoxgloveChannelsTest, ATimeBeforeZeroIsZero) {
  ChannelReader reader(&channels_, ChannelId::kStatus);
  all_.status(Status(-5));
  Step();
  EXPECT_EQ(channels_.now_ns(), 0);
  EXPECT_EQ(TimeOf(*reader.Next()), 0);
}

TEST_F(FoxgloveChannelsTest, EventsComeAsTheyWereTold) {
  ChannelReader reader(&channels_, ChannelId::kEvents);
  all_.event(Event(v1::EVENT_POSSIBLE));
  Step();
  all_.event(Event(v1::EVENT_CONFIRMED));
  all_.event(Event(v1::EVENT_DISMISSED, 2));
  Step();
  const auto events = News<v1::CollisionEvent>(&reader);
  ASSERT_EQ(events.size(), 2u) << "of each the newest";
  EXPECT_EQ(events[0].SerializeAsString(), Event(v1::EVENT_CONFIRMED).SerializeAsString());
  ChannelReader late(&channels_, ChannelId::kEvents);
  EXPECT_EQ(News<v1::CollisionEvent>(&late).size(), 2u);
}

TEST_F(FoxgloveChannelsTest, AForecastThatWasReplacedIsNotKept) {
  ChannelReader reader(&channels_, ChannelId::kEvents);
  all_.event(Event(v1::EVENT_POSSIBLE));
  Step();
  v1::CollisionEvent next = Event(v1::EVENT_POSSIBLE);
  next.mutable_higher()->set_slot(2);
  all_.event(next);
  Step();
  EXPECT_EQ(channels_.kept(ChannelId::kEvents), 1u);
  ChannelReader late(&channels_, ChannelId::kEvents);
  EXPECT_EQ(News<v1::CollisionEvent>(&late).at(0).higher().slot(), 2u);
}

TEST_F(FoxgloveChannelsTest, TheLogTellsOfContactsAndOfTheService) {
  Describe(Agent(0));
  Describe(Agent(1));
  all_.status(Status(5'000'000'000));
  all_.event(Event(v1::EVENT_CONFIRMED));
  ChannelReader reader(&channels_, ChannelId::kLog);
  Step();
  auto lines = News<foxglove::Log>(&reader);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].level(), foxglove::Log::WARNING);
  EXPECT_NE(lines[0].message().find("agent-0 (people) and agent-1 (people)"), std::string::npos)
      << lines[0].message();
  EXPECT_EQ(lines[1].message(),
            "The service 0000000000000001 (term 1, version ) serves world lab.");

  v1::CollisionEvent more = Event(v1::EVENT_CONFIRMED);
  more.set_revision(2);
  all_.event(more);
  Step();
  EXPECT_TRUE(News<foxglove::Log>(&reader).empty()) << "it is told already";
  all_.event(Event(v1::EVENT_ENDED));
  service_alive_ = false;
  Step();
  lines = News<foxglove::Log>(&reader);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].level(), foxglove::Log::ERROR);
  EXPECT_EQ(lines[1].level(), foxglove::Log::INFO);
  service_alive_ = true;
  v1::ServiceStatus other = Status(5'000'000'000);
  other.mutable_stamp()->set_term(2);
  all_.status(other);
  Step();
  EXPECT_NE(News<foxglove::Log>(&reader).at(0).message().find("(term 2"), std::string::npos);
}

TEST_F(FoxgloveChannelsTest, TheLogIsBounded) {
  ChannelReader reader(&channels_, ChannelId::kLog);
  Step();
  for (std::uint32_t i = 0; i < LogChannel::kLinesMax + 10; ++i) {
    all_.event(Event(v1::EVENT_CONFIRMED, i));
  }
  Step();
  EXPECT_EQ(channels_.kept(ChannelId::kLog), LogChannel::kLinesMax);
}

TEST_F(FoxgloveChannelsTest, TheNumbersOfTheWorldHaveTheLayoutOfTheirSchema) {
  Describe(Agent(0));
  v1::ServiceStatus status = Status(3'000'000'500);
  status.set_agents(7);
  status.set_pairs_tracked(12);
  status.set_cpu_us(2'500'000);
  v1::Counter* contacts = status.add_counters();
  contacts->set_name("events_confirmed");
  contacts->set_value(5);
  status.set_memory_bytes(1 << 20);
  all_.status(status);
  all_.event(Event(v1::EVENT_CONFIRMED));
  all_.event(Event(v1::EVENT_POSSIBLE, 2));
  all_.event(Event(v1::EVENT_POSSIBLE, 3));
  v1::EarliestIntersection earliest;
  earliest.set_found(true);
  earliest.set_earliest_ns(4'000'000'500);
  all_.earliest(earliest);
  ChannelReader reader(&channels_, ChannelId::kWorldNumbers);
  Step();
  Payload payload = reader.Next();
  ASSERT_TRUE(payload);
  std::string_view bytes = MessageOf(*payload).substr(4);
  ASSERT_EQ(bytes.size(), 64u);
  EXPECT_EQ(At<std::int32_t>(bytes, 0), 3);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 500u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 8), 7u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 12), 12u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 16), 2u) << "possible";
  EXPECT_EQ(At<std::uint32_t>(bytes, 20), 1u) << "confirmed";
  EXPECT_EQ(At<std::uint64_t>(bytes, 24), 5u);
  EXPECT_NEAR(At<double>(bytes, 32), 1, 1e-6);
  EXPECT_TRUE(std::isnan(At<double>(bytes, 40))) << "nothing is promised";
  EXPECT_EQ(At<double>(bytes, 48), 2.5);
  EXPECT_EQ(At<std::uint64_t>(bytes, 56), 1u << 20);

  v1::Clearance clearance;
  clearance.set_simulator_id(kSimulator);
  clearance.set_run(1);
  clearance.add_agents()->set_clear_until_ns(3'500'000'500);
  all_.clearance(clearance);
  all_.status(status);
  Step();
  payload = reader.Next();
  ASSERT_TRUE(payload);
  EXPECT_NEAR(At<double>(MessageOf(*payload).substr(4), 40), 0.5, 1e-6);
}

TEST_F(FoxgloveChannelsTest, TheNearestPairIsTheOneThatIsExpectedFirst) {
  Describe(Agent(0));
  Describe(Agent(1));
  all_.status(Status(4'000'000'000));
  ChannelReader reader(&channels_, ChannelId::kNearestNumbers);
  Step();
  Payload payload = reader.Next();
  ASSERT_TRUE(payload);
  std::string_view bytes = MessageOf(*payload).substr(4);
  for (const std::size_t at : {8u, 16u, 24u, 32u}) EXPECT_TRUE(std::isnan(At<double>(bytes, at)));
  EXPECT_EQ(bytes.substr(40), std::string_view("\1\0\0\0\0\0\0\0\1\0\0\0\0", 13));

  all_.event(Event(v1::EVENT_CONFIRMED));
  v1::CollisionEvent passes = Event(v1::EVENT_POSSIBLE, 2);
  passes.mutable_begin()->set_earliest_ns(1);
  all_.event(passes);
  Step();
  payload = reader.Next();
  ASSERT_TRUE(payload);
  bytes = MessageOf(*payload).substr(4);
  EXPECT_EQ(At<double>(bytes, 8), -0.25);
  EXPECT_EQ(At<double>(bytes, 16), 0.5);
  EXPECT_NEAR(At<double>(bytes, 24), 0.4, 1e-6);
  EXPECT_NEAR(At<double>(bytes, 32), 0.6, 1e-6);
  EXPECT_EQ(bytes.substr(40, 12), std::string_view("\x08\0\0\0agent-0\0", 12));
  EXPECT_EQ(bytes.substr(52), std::string_view("\x08\0\0\0agent-1\0", 12));
}

}  // namespace
}  // namespace collision::client
