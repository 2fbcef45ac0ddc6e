#include "server/world/succession.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

v1::Input Part(std::uint64_t sender, std::size_t bytes) {
  v1::Input input;
  input.set_sender(sender);
  input.mutable_shape_part()->set_bytes(std::string(bytes, 'x'));
  return input;
}

TEST(Succession, HandsOutWhatIsHeldInOrder) {
  Succession succession;
  EXPECT_FALSE(succession.IsAwaited(1));
  for (const std::uint64_t sender : {7u, 8u, 7u}) succession.Hold(1, Part(sender, sender));
  succession.Hold(2, Part(9, 100));
  EXPECT_TRUE(succession.IsAwaited(1));
  EXPECT_TRUE(succession.Waits(1, 8));
  EXPECT_FALSE(succession.Waits(2, 8));
  EXPECT_EQ(succession.shape_bytes(), 122u);
  const std::vector<v1::Input> inputs = succession.Take(1);
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[0].sender(), 7u);
  EXPECT_EQ(inputs[1].sender(), 8u);
  EXPECT_EQ(inputs[2].sender(), 7u);
  EXPECT_FALSE(succession.IsAwaited(1));
  EXPECT_TRUE(succession.Take(1).empty());
  EXPECT_EQ(succession.shape_bytes(), 100u);
}

TEST(Succession, NothingOfADroppedSenderIsHeld) {
  Succession succession;
  for (const std::uint64_t sender : {7u, 8u, 7u}) succession.Hold(1, Part(sender, 10));
  succession.Drop(1, 7);
  EXPECT_FALSE(succession.Waits(1, 7));
  EXPECT_EQ(succession.shape_bytes(), 10u);
  succession.Drop(1, 8);
  EXPECT_FALSE(succession.IsAwaited(1));
  succession.Drop(1, 8);
}

// Goal:   memory is bounded, and a removal is held even then, in place of the newest message.
TEST(Succession, HoldsABoundedNumberAndEveryRemoval) {
  Succession succession;
  for (std::size_t i = 0; i < kHeldInputsMax + 5; ++i) succession.Hold(1, Part(7, 1));
  EXPECT_EQ(succession.shape_bytes(), kHeldInputsMax);
  v1::Input removal;
  removal.mutable_agent_removal()->set_slot(3);
  succession.HoldRemoval(1, removal);
  const std::vector<v1::Input> inputs = succession.Take(1);
  ASSERT_EQ(inputs.size(), kHeldInputsMax);
  EXPECT_TRUE(inputs.back().has_agent_removal());
}

}  // namespace
}  // namespace collision::server
