// Goal:   a page hears everything once, and each state once; one that has nothing hears all.
// Method: messages by hand through a receiver without a network.
#include "client/programs/recordings/page_stream.h"

#include <algorithm>

#include "client/programs/recordings/heard_first.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class PageStreamTest : public CollisionctlTest {
 protected:
  std::vector<std::string> NewNames() {
    stream_.Poll({});
    std::vector<std::string> names;
    for (const Board::Item& item : stream_.TakeNew()) names.push_back(item.name);
    return names;
  }
  static bool IsAmong(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  }

  PageStream stream_{std::make_unique<FakeReceiver>(&next_)};
};

TEST_F(PageStreamTest, EachStateIsToldOnce) {
  Status();
  Describe("ada", 1, 0);
  Place(1, 1);
  const auto first = NewNames();
  EXPECT_TRUE(IsAmong(first, "agent/0"));
  EXPECT_EQ(first.back(), "states") << "behind the agents that they are of";
  EXPECT_EQ(std::ranges::count(first, "states"), 1);
  EXPECT_TRUE(NewNames().empty());
  Place(1, 1);
  EXPECT_EQ(NewNames(), std::vector<std::string>{"states"});
  stream_.BeginAnew();
  const auto anew = NewNames();
  for (const char* name : {"agent/0", "status", "states"}) EXPECT_TRUE(IsAmong(anew, name)) << name;
}

TEST_F(PageStreamTest, AnotherEpochEndsIt) {
  const auto tell = [this](std::uint64_t service, std::uint32_t epoch) {
    v1::ServiceStatus* status = Status();
    status->set_service_id(service);
    status->mutable_stamp()->set_service_id(service);
    status->mutable_stamp()->set_epoch(epoch);
    NewNames();
  };
  EXPECT_FALSE(stream_.IsOver());
  tell(1, 3);
  EXPECT_FALSE(stream_.IsOver());
  tell(1, 4);
  EXPECT_TRUE(stream_.IsOver());
  stream_.BeginAnew();
  EXPECT_FALSE(stream_.IsOver());
}

// Goal:   states are due before newer ones replace them, and what is told of time alone as well;
//         a stamp that cannot be delays little.
TEST(TakingTimes, OnceInAPeriodOfStatesOrOfTheService) {
  TakingTimes times(PeriodNs(10));
  constexpr std::int64_t kTenth = 100'000'000;
  const auto due_with = [&times](std::int64_t stamp_ns) {
    Arrivals arrivals;
    arrivals.inputs.emplace_back().mutable_agent_states()->add_states()->set_stamp_ns(stamp_ns);
    return times.AreStatesDue(arrivals);
  };
  EXPECT_FALSE(times.AreStatesDue({}));
  EXPECT_TRUE(times.IsDue(0));
  times.Taken(0);
  EXPECT_TRUE(due_with(0));
  times.Taken(0);
  EXPECT_FALSE(due_with(kTenth - 1));
  EXPECT_FALSE(due_with(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(due_with(std::numeric_limits<std::int64_t>::min()));
  EXPECT_TRUE(due_with(kTenth));
  times.Taken(0);
  EXPECT_FALSE(due_with(50)) << "of another simulator";
  EXPECT_FALSE(times.IsDue(2 * kTenth - 1)) << "its states are those of the last time";
  EXPECT_TRUE(times.IsDue(2 * kTenth));
  EXPECT_TRUE(due_with(900 * kTenth)) << "of a simulator whose clock is wrong";
  times.Taken(0);
  EXPECT_TRUE(times.IsDue(11 * kTenth));
  times.BeginAnew();
  EXPECT_TRUE(times.IsDue(0));
  EXPECT_TRUE(due_with(50));
}

}  // namespace
}  // namespace collision::client
