#include "collision_core/base/shared_limit.h"

#include <gtest/gtest.h>

namespace collision {
namespace {

// Goal:   a user may have what is free, less what others that are present have not used of what
//         they are guaranteed, and no more than its own maximum.
TEST(SharedLimit, WhatIsGuaranteedToOthersIsKept) {
  SharedLimit<int> limit;
  auto* greedy = limit.Enter(1);
  EXPECT_EQ(limit.RoomFor(*greedy, 100), 100u) << "alone";
  auto* other = limit.Enter(2);
  limit.SetShare(other, {.guaranteed = 10});
  EXPECT_EQ(limit.RoomFor(*greedy, 100), 90u);
  EXPECT_EQ(limit.RoomFor(*other, 100), 100u);
  EXPECT_EQ(limit.RoomFor(*greedy, 5), 0u);
  limit.Take(other, 4);
  EXPECT_EQ(limit.RoomFor(*greedy, 96), 90u) << "what it uses is not kept beside";
  limit.SetShare(greedy, {.max = 3});
  limit.Take(greedy, 1);
  EXPECT_EQ(limit.RoomFor(*greedy, 95), 2u);
  limit.GiveBack(greedy, 1);
}

// Goal:   a guarantee lasts as long as its user is present, what was taken until it is given back;
//         then the user is forgotten.
TEST(SharedLimit, AUserThatHasLeftKeepsOnlyWhatItUses) {
  SharedLimit<int> limit;
  auto* one = limit.Enter(1);
  auto* other = limit.Enter(2);
  limit.SetShare(other, {.guaranteed = 10});
  limit.Enter(2);
  limit.Take(other, 3);
  limit.Leave(other);
  EXPECT_EQ(limit.RoomFor(*one, 97), 90u) << "it had entered twice";
  limit.Leave(other);
  EXPECT_EQ(limit.RoomFor(*one, 97), 97u);
  EXPECT_EQ(limit.Find(2), other);
  limit.GiveBack(other, 3);
  EXPECT_EQ(limit.Find(2), nullptr);
}

}  // namespace
}  // namespace collision
