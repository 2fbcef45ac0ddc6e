// Goal:   a watch stands for its lease, bounded in number, period and lease; of several the least
//         period counts.
// Method: watches at times of the test's choice.
#include "client/library/world/watches.h"

#include <gtest/gtest.h>

#include "idl/limits.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::int64_t kMillisecond = 1'000'000;
const AgentId kAgent{.simulator = 1, .run = 2, .slot = 3, .generation = 4};

v1::Watch Watch(std::uint64_t watcher, std::int64_t period_ms, std::int64_t lease_ms = 1000) {
  v1::Watch watch;
  watch.set_watcher_id(watcher);
  watch.set_period_ns(period_ms * kMillisecond);
  watch.set_lease_ns(lease_ms * kMillisecond);
  watch.set_all(true);
  return watch;
}

TEST(Watches, StandForTheirLease) {
  Watches watches;
  const Watches::Time begin{};
  watches.Hear(Watch(1, 500), begin);
  watches.Hear(Watch(2, 100, 300), begin);
  EXPECT_EQ(watches.PeriodOf(kAgent), milliseconds(100));
  watches.Expire(begin + milliseconds(300));
  EXPECT_EQ(watches.PeriodOf(kAgent), milliseconds(500));
  watches.Hear(Watch(1, 500), begin + milliseconds(900));
  watches.Expire(begin + milliseconds(1000));
  EXPECT_FALSE(watches.empty()) << "it was repeated";
  watches.Hear(Watch(1, 500, 0), begin + milliseconds(1000));
  EXPECT_TRUE(watches.empty()) << "its watcher has ended it";
}

TEST(Watches, NameAgentsOrAll) {
  v1::Watch watch = Watch(1, 500);
  watch.set_all(false);
  v1::AgentId& agent = *watch.add_agents();
  agent.set_simulator_id(1);
  agent.set_slot(3);
  agent.set_generation(4);
  Watches watches;
  watches.Hear(watch, {});
  EXPECT_TRUE(watches.PeriodOf(kAgent));
  AgentId other = kAgent;
  other.generation = 5;
  EXPECT_FALSE(watches.PeriodOf(other));
}

TEST(Watches, AreBounded) {
  Watches watches;
  const Watches::Time begin{};
  watches.Hear(Watch(1, 19), begin);
  watches.Hear(Watch(1, 3'600'001), begin);
  watches.Hear(Watch(1, 500, 60'001), begin);
  EXPECT_TRUE(watches.empty());
  for (std::uint64_t watcher = 0; watcher <= wire::kWatchersMax; ++watcher) {
    const auto period_ms = static_cast<std::int64_t>(20 + watcher);
    watches.Hear(Watch(watcher, period_ms), begin + seconds(watcher));
  }
  EXPECT_EQ(watches.PeriodOf(kAgent), milliseconds(21)) << "the one heard first was dropped";
}

}  // namespace
}  // namespace collision::client
