// Goal:   a changed description counts when everybody who relied on the one before knows, or can
//         rely on it no longer; neither earlier nor later.
// Method: revisions, and what each simulator has been told and has taken in, step by step.
#include "server/world/wall_clock/widenings.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

constexpr std::int64_t kExpiry = 100;
constexpr detection::AgentId kAgent{.simulator = 1, .slot = 3, .run = 1, .generation = 1};

using Revisions = std::vector<std::uint32_t>;

class WideningsTest : public testing::Test {
 protected:
  Revisions Take(const std::vector<Informed>& others, std::int64_t now_ns) {
    Revisions revisions;
    for (const Widening& one : widenings_.Take(others, now_ns)) revisions.push_back(one.revision);
    return revisions;
  }

  Widenings widenings_{kExpiry};
};

TEST_F(WideningsTest, CountsAtOnceIfNobodyMustKnow) {
  widenings_.Add({kAgent, 2});
  // The owner itself, and one that has taken in everything.
  EXPECT_EQ(Take({{1, 9, 4}, {2, 7, 7}}, 0), Revisions{2});
  EXPECT_TRUE(widenings_.empty());
}

TEST_F(WideningsTest, CountsWhenTheLastHasAcknowledgedWhatWasPublishedThen) {
  widenings_.Add({kAgent, 2});
  EXPECT_EQ(Take({{2, 7, 5}, {3, 8, 8}, {4, 9, 5}}, 0), Revisions{});
  EXPECT_EQ(Take({{2, 12, 7}, {3, 12, 8}, {4, 12, 8}}, 50), Revisions{});
  EXPECT_EQ(Take({{2, 13, 7}, {3, 13, 8}, {4, 13, 9}}, 99), Revisions{2});
}

TEST_F(WideningsTest, CountsWhenThePromisesBeforeHaveExpired) {
  widenings_.Add({kAgent, 2});
  EXPECT_EQ(Take({{2, 7, 5}}, 20), Revisions{});
  EXPECT_EQ(widenings_.NextDue(), 120);
  EXPECT_EQ(Take({{2, 7, 5}}, 119), Revisions{});
  EXPECT_EQ(Take({}, 120), Revisions{2});
  EXPECT_EQ(widenings_.NextDue(), std::nullopt);
}

TEST_F(WideningsTest, WhoseAgentsAreGoneStillReliesOnWhatItHeard) {
  widenings_.Add({kAgent, 2});
  EXPECT_EQ(Take({{2, 7, 5}}, 0), Revisions{});
  EXPECT_EQ(Take({}, 99), Revisions{});
}

TEST_F(WideningsTest, OneThatIsDescribedAllTheTimeCountsNowAndThen) {
  std::uint32_t revision = 1;
  Revisions counted;
  for (std::int64_t step = 0; step < 50; ++step) {
    widenings_.Add({kAgent, ++revision});
    const auto published = static_cast<std::uint64_t>(10 + step);
    // The other one acknowledges ten steps late.
    for (const std::uint32_t one : Take({{2, published, published - 10}}, step)) {
      counted.push_back(one);
    }
  }
  EXPECT_GE(counted.size(), 3u);
  EXPECT_TRUE(std::is_sorted(counted.begin(), counted.end()));
}

}  // namespace
}  // namespace collision::server
