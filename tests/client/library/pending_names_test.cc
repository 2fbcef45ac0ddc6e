// Goal:   an event waits for both names, at most a second, and the order of events stays.
// Method: the test controls names and wall clock.
#include "collision/pending_names.h"

#include <gtest/gtest.h>

#include <set>

namespace collision::client {
namespace {

using std::chrono::milliseconds;

class PendingNamesTest : public testing::Test {
 protected:
  void Add(std::uint32_t lower, std::uint32_t higher) {
    Event event;
    event.lower.slot = lower;
    event.higher.slot = higher;
    pending_.Add(event, now_);
  }

  std::vector<std::uint32_t> Take() {
    const auto named = [this](const AgentId& id) { return named_.contains(id.slot); };
    std::vector<std::uint32_t> lowers;
    for (const auto& event : pending_.Take(named, now_)) lowers.push_back(event.lower.slot);
    return lowers;
  }

  PendingNames pending_;
  PendingNames::Wall now_;
  std::set<std::uint32_t> named_;
};

TEST_F(PendingNamesTest, AnEventWaitsForBothNames) {
  Add(1, 2);
  EXPECT_TRUE(Take().empty());
  named_ = {1};
  EXPECT_TRUE(Take().empty());
  named_ = {1, 2};
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(Take().empty());
}

TEST_F(PendingNamesTest, NoneWaitsForMoreThanASecond) {
  Add(1, 2);
  now_ += milliseconds(999);
  EXPECT_TRUE(Take().empty());
  now_ += milliseconds(1);
  EXPECT_EQ(Take(), (std::vector<std::uint32_t>{1}));
}

TEST_F(PendingNamesTest, ANamedEventWaitsForThoseBefore) {
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
