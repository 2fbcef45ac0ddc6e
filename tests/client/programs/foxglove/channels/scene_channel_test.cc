// Goal:   a 3D panel shows each agent once, where it is and how near to a contact; what has left is
//         gone, also for a viewer that reads rarely.
// Method: messages by hand; a model of a panel that adds and deletes as the schema says.
#include "client/programs/foxglove/channels/scene_channel.h"

#include <gtest/gtest.h>

#include "idl/shape_bytes.h"
#include "tests/client/programs/foxglove/foxglove_fixture.h"

namespace collision::client {
namespace {

using foxglove::FrameTransforms;
using foxglove::SceneUpdate;

class SceneChannelTest : public FoxgloveTest {
 protected:
  std::vector<SceneUpdate> Updates() { return News<SceneUpdate>(&scene_reader_); }

  void Look() {
    Step();
    panel_.Take(Updates());
  }

  /// A shape of one mesh that the agent then has.
  std::string Send(const ShapeContent& content) {
    const std::string bytes = EncodeShape(content);
    v1::ShapePart part;
    part.set_simulator_id(kSimulator);
    part.set_parts(static_cast<std::uint32_t>(ShapeParts(bytes.size())));
    part.set_content_hash(Sha256(bytes));
    for (std::uint32_t i = 0; i < part.parts(); ++i) {
      part.set_part(i);
      part.set_bytes(bytes.substr(i * wire::kShapePartBytes, wire::kShapePartBytes));
      all_.shape_part(part);
    }
    return part.content_hash();
  }

  ChannelReader scene_reader_{&channels_, ChannelId::kScene};
  ChannelReader transform_reader_{&channels_, ChannelId::kTransforms};
  Panel panel_;
};

TEST_F(SceneChannelTest, AnAgentIsSentOnceAndMovedByItsFrame) {
  Describe(Agent(0));
  Place(0, 1.5, 2'000'000'001);
  Look();
  ASSERT_TRUE(panel_.Has("agent/0"));
  const foxglove::SceneEntity& ada = panel_.At("agent/0");
  EXPECT_EQ(ada.frame_id(), "people/agent-0");
  EXPECT_TRUE(ada.frame_locked());
  ASSERT_EQ(ada.spheres_size(), 1);
  EXPECT_EQ(ada.spheres(0).size().x(), 1) << "the diameter";
  EXPECT_EQ(ada.spheres(0).color().a(), 1);
  const auto transforms = News<FrameTransforms>(&transform_reader_);
  ASSERT_EQ(transforms.size(), 1u);
  const foxglove::FrameTransform& one = transforms[0].transforms(0);
  EXPECT_EQ(one.parent_frame_id(), "world");
  EXPECT_EQ(one.child_frame_id(), "people/agent-0");
  EXPECT_EQ(one.translation().x(), 1.5);
  EXPECT_EQ(one.rotation().w(), 0.1);
  EXPECT_EQ(one.rotation().x(), 0.7);
  EXPECT_EQ(one.rotation().y(), 0.5);
  EXPECT_EQ(one.rotation().z(), -0.5);
  EXPECT_EQ(one.timestamp().seconds(), 2);
  EXPECT_EQ(one.timestamp().nanos(), 1);

  Place(0, 2.5, 3'000'000'000);
  Step();
  EXPECT_TRUE(Updates().empty());
  EXPECT_EQ(News<FrameTransforms>(&transform_reader_).at(0).transforms(0).translation().x(), 2.5);
}

TEST_F(SceneChannelTest, AReaderThatComesLaterGetsWhatStands) {
  for (std::uint32_t slot = 0; slot < 3; ++slot) Describe(Agent(slot));
  Look();
  Remove(1);
  Look();
  ChannelReader late(&channels_, ChannelId::kScene);
  Panel other;
  other.Take(News<SceneUpdate>(&late));
  EXPECT_EQ(other.size(), 2u);
  EXPECT_TRUE(other.Has("agent/0"));
  EXPECT_TRUE(other.Has("agent/2"));
}

TEST_F(SceneChannelTest, AnAgentThatLeavesIsDeleted) {
  Describe(Agent(0));
  Describe(Agent(1));
  Look();
  Remove(0);
  Step();
  const auto updates = Updates();
  ASSERT_EQ(updates.size(), 1u);
  const auto& deletion = updates[0].deletions(0);
  EXPECT_EQ(deletion.id(), "agent/0");
  const auto& entity = panel_.At("agent/0");
  EXPECT_GT(deletion.timestamp().seconds() * 1'000'000'000 + deletion.timestamp().nanos(),
            entity.timestamp().seconds() * 1'000'000'000 + entity.timestamp().nanos())
      << "or it would not be deleted";
  panel_.Take(updates);
  EXPECT_EQ(panel_.size(), 1u);
}

TEST_F(SceneChannelTest, ASlowReaderKeepsNothingThatHasLeft) {
  Describe(Agent(0));
  Look();
  Remove(0);
  Step();
  v1::AgentDescription next = Agent(0);
  next.set_agent_name("next");
  next.set_generation(1);
  Describe(next);
  Step();
  Step();
  panel_.Take(Updates());
  ASSERT_EQ(panel_.size(), 1u);
  EXPECT_EQ(panel_.At("agent/0").frame_id(), "people/next");
}

TEST_F(SceneChannelTest, TheColorIsThatOfTheNextContact) {
  Describe(Agent(0));
  Describe(Agent(1));
  Describe(Agent(2));
  all_.status(Status(1'000'000'000));
  const auto red = [this](const std::string& id) {
    return 255 * panel_.At(id).spheres(0).color().r();
  };
  Look();
  EXPECT_NEAR(red("agent/0"), 0x4d, 0.01);
  v1::CollisionEvent event = Event(v1::EVENT_POSSIBLE);
  event.mutable_expected()->set_outcome(v1::EXPECTED_TOUCH);
  all_.event(event);
  Look();
  EXPECT_NEAR(red("agent/0"), 0x56, 0.01) << "a contact may come";
  all_.status(Status(2'390'000'000));
  Look();
  EXPECT_NEAR(red("agent/0"), 0x56, 0.01) << "in 2.01 s";
  all_.status(Status(2'410'000'000));
  Look();
  EXPECT_NEAR(red("agent/0"), 0xe6, 0.01) << "it is near";
  all_.event(Event(v1::EVENT_CONFIRMED));
  all_.status(Status(4'600'000'000));
  Look();
  EXPECT_NEAR(red("agent/0"), 0xd5, 0.01) << "it lasts";
  EXPECT_NEAR(red("agent/1"), 0xd5, 0.01);
  EXPECT_NEAR(red("agent/2"), 0x4d, 0.01) << "another one is calm";
  all_.event(Event(v1::EVENT_ENDED));
  Look();
  EXPECT_NEAR(red("agent/0"), 0x4d, 0.01);
}

TEST_F(SceneChannelTest, AContactIsShownAtItsPointAndAWhileLonger) {
  Describe(Agent(0, 0.5));
  Describe(Agent(1, 2));
  all_.status(Status(5'000'000'000));
  all_.event(Event(v1::EVENT_CONFIRMED));
  Look();
  ASSERT_TRUE(panel_.Has("contact/0"));
  const foxglove::SceneEntity& contact = panel_.At("contact/0");
  EXPECT_EQ(contact.frame_id(), "world");
  EXPECT_EQ(contact.spheres(0).pose().position().x(), 3);
  ASSERT_EQ(contact.arrows_size(), 1);
  const foxglove::Quaternion& q = contact.arrows(0).pose().orientation();
  EXPECT_NEAR(q.z(), std::sqrt(0.5), 1e-12) << "from +x to the normal, +y";
  EXPECT_NEAR(q.w(), std::sqrt(0.5), 1e-12);
  EXPECT_NE(contact.texts(0).text().find("agent-0 × agent-1"), std::string::npos);
  EXPECT_NE(contact.texts(0).text().find("4.400 s"), std::string::npos);

  all_.event(Event(v1::EVENT_ENDED));
  all_.status(Status(6'000'000'000));
  Look();
  EXPECT_TRUE(panel_.Has("contact/0"));
  all_.status(Status(8'000'000'000));
  Look();
  EXPECT_FALSE(panel_.Has("contact/0"));
}

TEST_F(SceneChannelTest, EachContactHasAPlaceOfItsOwn) {
  all_.status(Status(5'000'000'000));
  for (const std::uint32_t contact : {1, 2}) all_.event(Event(v1::EVENT_CONFIRMED, contact));
  Look();
  EXPECT_TRUE(panel_.Has("contact/0") && panel_.Has("contact/1"));
  all_.event(Event(v1::EVENT_ENDED, 1));
  Look();
  all_.event(Event(v1::EVENT_CONFIRMED, 3));
  Look();
  EXPECT_TRUE(panel_.Has("contact/2")) << "the first is shown still";
  all_.status(Status(7'000'000'000));
  Look();
  EXPECT_EQ(panel_.size(), 2u);
  for (const std::uint32_t contact : {4, 5}) all_.event(Event(v1::EVENT_CONFIRMED, contact));
  Look();
  EXPECT_EQ(panel_.size(), 4u);
  EXPECT_TRUE(panel_.Has("contact/0")) << "its place is used again";
  EXPECT_TRUE(panel_.Has("contact/3"));
}

TEST_F(SceneChannelTest, ManyAgentsAreBallsOfChunks) {
  constexpr std::uint32_t kMany = ShownWorld::kAgentsApartMax + 1;
  for (std::uint32_t slot = 0; slot < kMany; ++slot) {
    Describe(Agent(slot));
    Place(slot, slot);
  }
  v1::AgentDescription floor = Agent(kMany, 0);
  floor.mutable_half_space()->mutable_normal()->set_z(1);
  Describe(floor);
  Place(kMany, 0);
  Look();
  EXPECT_EQ(panel_.size(), 3u);
  ASSERT_TRUE(panel_.Has("chunk/0") && panel_.Has("chunk/1"));
  EXPECT_EQ(panel_.At("chunk/0").spheres_size() + panel_.At("chunk/1").spheres_size(), 1001);
  EXPECT_EQ(panel_.At("chunk/1").spheres(0).pose().position().x(), 512);
  EXPECT_EQ(panel_.At("chunk/1").frame_id(), "world");
  EXPECT_EQ(panel_.At("agent/1001").cubes_size(), 1) << "a floor stands apart";
  EXPECT_TRUE(News<FrameTransforms>(&transform_reader_).empty());

  Place(600, -1, 1);
  Step();
  const auto updates = Updates();
  ASSERT_EQ(updates.size(), 1u) << "the chunk that has changed";
  EXPECT_EQ(updates[0].entities(0).spheres(600 - 512).pose().position().x(), -1);

  for (std::uint32_t slot = 0; slot < 103; ++slot) Remove(slot);
  Look();
  EXPECT_EQ(panel_.size(), 899u);
  EXPECT_FALSE(panel_.Has("chunk/0"));
  EXPECT_EQ(News<FrameTransforms>(&transform_reader_).size(), 2u);
}

TEST_F(SceneChannelTest, AShapeIsDrawnWhenItHasArrived) {
  const ShapeContent triangle{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                              .triangles = {{0, 1, 2}}};
  v1::AgentDescription description = Agent(0, 2);
  description.set_shape_hash(Sha256(EncodeShape(triangle)));
  Describe(description);
  Look();
  ASSERT_EQ(panel_.At("agent/0").spheres_size(), 1);
  EXPECT_LT(panel_.At("agent/0").spheres(0).color().a(), 1) << "in its place";
  Send(triangle);
  Look();
  ASSERT_EQ(panel_.At("agent/0").triangles_size(), 1);
  EXPECT_EQ(panel_.At("agent/0").spheres_size(), 0);
  EXPECT_EQ(panel_.At("agent/0").triangles(0).points_size(), 3);
}

TEST_F(SceneChannelTest, ALargeShapeIsNotSentAgainForItsColor) {
  ShapeContent large;
  for (int i = 0; i < 4000; ++i) large.vertices.push_back({1.0 * i, 1.5, 1});
  large.triangles = {{0, 1, 2}};
  v1::AgentDescription description = Agent(0, 2);
  description.set_shape_hash(Send(large));
  Describe(description);
  Describe(Agent(1));
  Look();
  ASSERT_EQ(panel_.At("agent/0").triangles(0).points_size(), 4000);
  all_.event(Event(v1::EVENT_CONFIRMED));
  Step();
  for (const SceneUpdate& update : Updates()) {
    for (const auto& entity : update.entities()) EXPECT_NE(entity.id(), "agent/0");
  }
}

TEST_F(SceneChannelTest, WhenTimeBeginsAnewAllIsPutAnew) {
  Describe(Agent(0));
  all_.status(Status(9'000'000'000));
  Look();
  all_.status(Status(8'500'000'000));
  Step();
  EXPECT_EQ(channels_.now_ns(), 9'000'000'000) << "told a little late";
  EXPECT_TRUE(Updates().empty());
  all_.status(Status(1'000'000'000));
  Step();
  EXPECT_EQ(channels_.now_ns(), 1'000'000'000);
  const auto updates = Updates();
  ASSERT_EQ(updates.size(), 2u);
  EXPECT_EQ(updates[0].deletions(0).type(), foxglove::SceneEntityDeletion::ALL);
  EXPECT_EQ(updates[1].entities(0).id(), "agent/0");
}

TEST_F(SceneChannelTest, TheFrameOfTheWorldIsThatOfItsStatus) {
  Describe(Agent(0));
  Place(0, 1);
  v1::ServiceStatus status = Status(0);
  all_.status(status);
  Look();
  News<FrameTransforms>(&transform_reader_);
  status.set_frame("ENU 47 8");
  all_.status(status);
  Look();
  const auto transforms = News<FrameTransforms>(&transform_reader_);
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].transforms(0).parent_frame_id(), "ENU 47 8");
}

}  // namespace
}  // namespace collision::client
