// Goal:   what happens between a jump and the next state counts, although that state has replaced
//         the jump before the service could read it.
// Method: two simulators with the library in lock-step, over a daemon in the same thread; one jumps
//         beside the other, hits it, and is gone again, within one round.
#include <gtest/gtest.h>

#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(Jump, AContactBetweenTwoJumpsOfOneRoundIsConfirmed) {
  v1::Config config = server::Simulated();
  config.mutable_clock()->set_simulators_awaited(2);
  config.mutable_clock()->set_grant_ahead_max_s(1);
  InProcessService service(config, 1);
  World still = service.Connect(1, {.simulator = "still"});
  World jumper = service.Connect(2, {.simulator = "jumper"});
  const AgentDescription ball{.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0.01};
  Agent a = still.AddAgent(ball, {.stamp_ns = 0});
  Agent b = jumper.AddAgent(ball, {.stamp_ns = 0, .position_m = {1000, 0, 0}});
  const auto advance = [&](std::int64_t clock_ns) {
    for (int tries = 0; tries < 1000; ++tries) {
      const Advance one = still.AdvanceTo(clock_ns, std::chrono::nanoseconds(0));
      const Advance other = jumper.AdvanceTo(clock_ns, std::chrono::nanoseconds(0));
      if (one == Advance::kReached && other == Advance::kReached) return true;
      service.Step(0.001);
    }
    return false;
  };
  ASSERT_TRUE(advance(0));
  ASSERT_TRUE(advance(100 * kMillisecond));
  ASSERT_GE(jumper.granted_until_ns(), 500 * kMillisecond) << "the jumps are in one round";
  // At 300 ms it stands 1 m beside, and hits it at 350 ms.
  b.SetState({.stamp_ns = 300 * kMillisecond,
              .position_m = {3, 0, 0},
              .velocity_m_s = {-20, 0, 0},
              .discontinuity = true});
  ASSERT_TRUE(advance(300 * kMillisecond));
  b.SetState({.stamp_ns = 400 * kMillisecond, .position_m = {1000, 0, 0}, .discontinuity = true});
  ASSERT_TRUE(advance(400 * kMillisecond));
  b.SetState({.stamp_ns = 500 * kMillisecond, .position_m = {1000, 0, 0}});
  ASSERT_TRUE(advance(500 * kMillisecond));
  ASSERT_TRUE(advance(3000 * kMillisecond));
  bool confirmed = false;
  for (const Event& event : still.TakeEvents()) {
    if (event.status != EventStatus::kConfirmed) continue;
    confirmed = true;
    EXPECT_LE(event.begin.earliest_ns, 350 * kMillisecond);
    EXPECT_GE(event.begin.latest_ns, 350 * kMillisecond);
  }
  EXPECT_TRUE(confirmed);
  EXPECT_TRUE(jumper.TakeRejections().empty());
}

}  // namespace
}  // namespace collision::client
