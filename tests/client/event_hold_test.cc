// Goal:   no event is shown before its names are known, none waits for long, and their order stays.
// Method: names and the wall clock are in the test's hands.
#include "client/event_hold.h"

#include <gtest/gtest.h>

#include <set>

namespace collision::client {
namespace {

using std::chrono::milliseconds;

class EventHoldTest : public testing::Test {
 protected:
  void Add(std::uint32_t lower, std::uint32_t higher) {
    v1::CollisionEvent event;
    event.mutable_lower()->set_slot(lower);
    event.mutable_higher()->set_slot(higher);
    hold_.Add(event, now_);
  }

  std::vector<std::uint32_t> Take() {
    const auto named = [this](const v1::AgentId& id) { return named_.contains(id.slot()); };
    std::vector<std::uint32_t> lowers;
    for (const auto& event : hold_.Take(named, now_)) lowers.push_back(event.lower().slot());
    return lowers;
  }

  EventHold hold_;
  EventHold::Wall now_;
  std::set<std::uint32_t> named_;
};

TEST_F(EventHoldTest, AnEventWaitsForBothNames) {
  Add(1, 2);
  EXPECT_TRUE(Take().empty());
  named_ = {1};
  EXPECT_TRUE(Take().empty());
  named_ = {1, 2};
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(Take().empty());
}

TEST_F(EventHoldTest, NoneWaitsForMoreThanASecond) {
  Add(1, 2);
  now_ += milliseconds(999);
  EXPECT_TRUE(Take().empty());
  now_ += milliseconds(1);
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{1}));
}

TEST_F(EventHoldTest, WhatIsNamedWaitsForThoseBefore) {
  named_ = {3, 4};
  Add(3, 4);
  Add(1, 2);
  Add(4, 3);
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{3}));
  named_ = {1, 2, 3, 4};
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{1, 4}));
}

}  // namespace
}  // namespace collision::client
