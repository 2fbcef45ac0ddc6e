// Goal:   a viewer gets what it subscribes to, behind the time of the world; what it may not ask is
//         answered, and the connection goes on.
// Method: messages by hand on both sides.
#include "client/programs/gateway/foxglove_viewer.h"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "client/programs/foxglove/messages/foxglove.pb.h"
#include "client/programs/gateway/json_member.h"

namespace collision::gateway {
namespace {

using client::ChannelId;
using google::protobuf::Struct;

class FoxgloveViewerTest : public testing::Test {
 protected:
  void SetUp() override {
    Step(0);
    for (int i = 0; i < 3; ++i) viewer_.Next();  // what it is told first
  }

  void Step(std::int64_t now_ns) {
    v1::ServiceStatus status;
    status.set_service_id(1);
    status.set_now_ns(now_ns);
    v1::SimulatorStatus* people = status.add_simulators();
    people->set_simulator_id(9);
    people->set_run(1);
    people->set_alive(true);
    all_.status(status);
    channels_.Put(scene_, scene_.TakeChanges(), true);
  }

  void Describe(std::uint32_t slot) {
    v1::AgentDescription description;
    description.set_simulator_id(9);
    description.set_slot(slot);
    description.set_run(1);
    description.set_simulator_name("people");
    description.set_agent_name(std::to_string(slot));
    description.set_radius_m(1);
    all_.description(description);
  }

  /// The next message as a whole; empty: none.
  std::string Next() {
    const auto message = viewer_.Next();
    std::string all;
    if (message) {
      for (const Payload& piece : message->pieces) all += *piece;
    }
    return all;
  }

  std::vector<std::string> AllThatComes() {
    std::vector<std::string> all;
    for (std::string one = Next(); !one.empty(); one = Next()) all.push_back(one);
    return all;
  }

  /// The message of a status, which comes next.
  std::string Answer() {
    const auto message = viewer_.Next();
    if (!message || !message->is_text) return "";
    Struct status;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(*message->pieces[0], &status).ok());
    EXPECT_EQ(MemberOf(status, "op").string_value(), "status");
    EXPECT_EQ(MemberOf(status, "level").number_value(), 2);
    return MemberOf(status, "message").string_value();
  }

  void Say(const std::string& message) { EXPECT_EQ(viewer_.Hear(message, true), ""); }

  void Subscribe(std::uint32_t id, std::uint32_t channel) {
    Say(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) + R"(,"channelId":)" +
        std::to_string(channel) + "}]}");
  }

  client::ShapeStore shapes_;
  client::Scene scene_{&shapes_};
  client::FoxgloveChannels channels_;
  client::MessageMonitor::Callbacks all_ = scene_.Callbacks();
  FoxgloveViewer viewer_{&channels_, {"here", "lab", "1.2", "run-7"}};
};

constexpr auto kStatus = static_cast<std::uint32_t>(ChannelId::kStatus);
constexpr auto kScene = static_cast<std::uint32_t>(ChannelId::kScene);

TEST_F(FoxgloveViewerTest, IsToldOfTheServerAndItsChannelsFirst) {
  FoxgloveViewer other(&channels_, {"here", "lab", "1.2", "run-7"});
  auto message = other.Next();
  ASSERT_TRUE(message && message->is_text);
  EXPECT_EQ(*message->pieces[0],
            R"({"op":"serverInfo","name":"here","capabilities":["time"],)"
            R"("metadata":{"world":"lab","version":"1.2"},"sessionId":"run-7"})");
  message = other.Next();
  ASSERT_TRUE(message && message->is_text);
  Struct advertise;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(*message->pieces[0], &advertise).ok());
  EXPECT_EQ(MemberOf(advertise, "op").string_value(), "advertise");
  const auto& channels = MemberOf(advertise, "channels").list_value();
  ASSERT_EQ(channels.values_size(), static_cast<int>(client::Channels().size()));
  for (int i = 0; i < channels.values_size(); ++i) {
    const Struct& fields = channels.values(i).struct_value();
    const client::Channel& channel = client::Channels()[static_cast<std::size_t>(i)];
    EXPECT_EQ(MemberOf(fields, "id").number_value(), channel.id);
    EXPECT_EQ(MemberOf(fields, "topic").string_value(), channel.topic);
    EXPECT_EQ(MemberOf(fields, "encoding").string_value(), channel.encoding);
    EXPECT_EQ(MemberOf(fields, "schemaName").string_value(), channel.schema_name);
    EXPECT_EQ(MemberOf(fields, "schemaEncoding").string_value(), channel.schema_encoding);
    EXPECT_EQ(MemberOf(fields, "schema").string_value() == channel.schema,
              channel.encoding == "cdr")
        << "bytes are told in base64";
  }
  message = other.Next();
  ASSERT_TRUE(message && !message->is_text);
  EXPECT_EQ(*message->pieces[0], std::string("\2\0\0\0\0\0\0\0\0", 9)) << "the time";
  EXPECT_FALSE(other.Next());
}

TEST_F(FoxgloveViewerTest, GetsWhatItSubscribesToBehindTheTime) {
  Subscribe(0x01020304, kStatus);
  Step(0x0a0b);
  const std::string time("\x0b\x0a\0\0\0\0\0\0", 8);
  EXPECT_EQ(Next(), "\2" + time);
  const std::string data = Next();
  EXPECT_EQ(data.substr(0, 13), std::string("\1\4\3\2\1", 5) + time);
  v1::ServiceStatus status;
  ASSERT_TRUE(status.ParseFromString(data.substr(13)));
  EXPECT_EQ(status.now_ns(), 0x0a0b);
  EXPECT_EQ(Next(), "");
}

TEST_F(FoxgloveViewerTest, TimeIsNeverBehindTheData) {
  Subscribe(1, kStatus);
  Step(5);
  EXPECT_EQ(Next()[1], 5);
  Step(6);
  EXPECT_EQ(Next().substr(0, 2), "\2\6");
  EXPECT_EQ(Next().substr(5, 1), "\6");
}

TEST_F(FoxgloveViewerTest, ASlowOneGetsWhatIsNewest) {
  Subscribe(0, kStatus);
  Subscribe(1, kScene);
  Describe(0);
  for (int now = 1; now < 100; ++now) Step(now);
  const auto all = AllThatComes();
  ASSERT_EQ(all.size(), 4u) << "time, status, that all before is deleted, an agent";
  EXPECT_EQ(all[0][1], 99);
}

TEST_F(FoxgloveViewerTest, EachSubscriptionHasItsTurn) {
  Subscribe(3, kStatus);
  Subscribe(8, kScene);
  for (std::uint32_t slot = 0; slot < 5; ++slot) Describe(slot);
  std::set<char> ids;
  for (int now = 1; now <= 3; ++now) {
    Step(now);
    EXPECT_EQ(Next()[0], 2);
    ids.insert(Next()[1]);
  }
  EXPECT_EQ(ids, (std::set<char>{3, 8}));
}

TEST_F(FoxgloveViewerTest, GetsNothingMoreWhenItUnsubscribes) {
  Subscribe(7, kStatus);
  Step(1);
  EXPECT_EQ(channels_.kept(ChannelId::kStatus), 1u);
  Say(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  EXPECT_EQ(AllThatComes().size(), 1u) << "the time";
  Step(2);
  EXPECT_EQ(channels_.kept(ChannelId::kStatus), 0u);
  Subscribe(7, kStatus);
  Step(3);
  EXPECT_EQ(AllThatComes().size(), 2u);
}

TEST_F(FoxgloveViewerTest, WhatItLeftUnreadEndsWithIt) {
  {
    FoxgloveViewer other(&channels_, {});
    other.Hear(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4}]})", true);
    Step(1);
    EXPECT_EQ(channels_.kept(ChannelId::kStatus), 1u);
  }
  Step(2);
  EXPECT_EQ(channels_.kept(ChannelId::kStatus), 0u);
}

TEST_F(FoxgloveViewerTest, WhatIsNotOfferedIsAnswered) {
  for (const char* operation : {"advertise", "getParameters", "fetchAsset", "unheard-of"}) {
    Say(std::string(R"({"op":")") + operation + R"("})");
    EXPECT_NE(Answer().find(operation), std::string::npos);
  }
  for (const std::string& wrong :
       {std::string("hello"), std::string("[1,2]"), std::string(""), std::string("{\"op\":"),
        std::string("\xff\xfe"), std::string(60000, '['), "{\"a\":" + std::string(60000, '[')}) {
    Say(wrong);
    EXPECT_EQ(Answer(), "That is not a JSON object.") << wrong.substr(0, 20);
  }
  for (const char* wrong : {"{}", R"({"op":7})", R"({"op":{"op":"subscribe"}})"}) {
    Say(wrong);
    EXPECT_NE(Answer(), "") << wrong;
  }
  Say(R"({"op":")" + std::string(60000, 'x') + "\"}");
  EXPECT_LT(Answer().size(), 64u);
  EXPECT_EQ(viewer_.Hear(std::string("\1\0\0\0\0", 5), false), "");
  EXPECT_NE(Answer(), "") << "a message of a client";
}

TEST_F(FoxgloveViewerTest, SubscriptionsThatCannotBeAreAnswered) {
  for (const char* wrong :
       {R"({"id":1,"channelId":0})", R"({"id":1,"channelId":99})", R"({"id":-1,"channelId":4})",
        R"({"id":1.5,"channelId":4})", R"({"id":4294967296,"channelId":4})",
        R"({"id":"1","channelId":4})", R"({"channelId":4})", "7"}) {
    Say(std::string(R"({"op":"subscribe","subscriptions":[)") + wrong + "]}");
    EXPECT_NE(Answer(), "") << wrong;
  }
  Subscribe(4294967295, kStatus);
  EXPECT_EQ(Answer(), "");
  Subscribe(4294967295, kScene);
  EXPECT_NE(Answer(), "") << "the id is taken";
  Subscribe(1, kStatus);
  EXPECT_NE(Answer(), "") << "the channel has one";
  Say(R"({"op":"unsubscribe","subscriptionIds":[5]})");
  EXPECT_NE(Answer(), "");
}

TEST_F(FoxgloveViewerTest, AnswersAreBounded) {
  for (int i = 0; i < 1000; ++i) Say("nonsense");
  EXPECT_EQ(AllThatComes().size(), FoxgloveViewer::kAnswersMax);
}

}  // namespace
}  // namespace collision::gateway
