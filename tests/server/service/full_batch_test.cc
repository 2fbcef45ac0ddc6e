// Goal:   a clock counts when everything that was written before it has come, also where more
//         messages wait than a step takes.
// Method: two agents; the network hands on instance by instance, so the newest state comes with the
//         clock while an older one of the other agent still waits.
#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kSender = 1;

v1::Input ClockThatCounts(std::uint64_t states) {
  v1::SimulatorClock clock = ClockAfter("alpha", 0, states, 2);
  clock.set_next_ns(1'000'000'000);
  return From(kSender, clock);
}

/// Whether time has begun after a batch of the clock and the newest of two states, of which a step
/// takes so many messages.
bool BeginsAfterTwoMessages(std::uint32_t batch_max, ScriptedDaemon* daemon) {
  daemon->Step({From(kSender, Description("alpha", 0))});
  daemon->Step({From(kSender, Description("alpha", 1))});
  daemon->bus().outputs.clear();
  v1::Input newest = From(kSender, State(1, 0, 2), "alpha");
  newest.mutable_agent_states()->set_chunk(1);
  daemon->Step({newest, ClockThatCounts(2)});
  EXPECT_EQ(batch_max == 2, daemon->bus().outputs.empty());
  return !daemon->bus().outputs.empty();
}

TEST(FullBatch, NoClockCountsWhileMoreMayWait) {
  for (const std::uint32_t batch_max : {2, 3}) {
    v1::Config config = Simulated();
    config.set_inputs_per_batch_max(batch_max);
    ScriptedDaemon daemon(config);
    EXPECT_EQ(BeginsAfterTwoMessages(batch_max, &daemon), batch_max == 3);
    // The rest comes; or nothing more has waited, and the service looks at once.
    daemon.Step({From(kSender, State(0, 0, 1), "alpha")});
    EXPECT_EQ(daemon.bus().timeout_ns == 0, batch_max == 2);
    EXPECT_GT(daemon.clearance(SimulatorId("alpha")).granted_until_ns(), 0);
  }
}

}  // namespace
}  // namespace collision::server
