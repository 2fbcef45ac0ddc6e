// Goal:   with a wall clock a wider declaration counts once every other simulator knows of it, or
//         its promises have expired.
// Method: two simulators with the library, over a daemon in the same thread; one of them stops
//         acknowledging.
#include <gtest/gtest.h>

#include "idl/limits.h"
#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr double kStepS = 0.02;

class WideningTest : public testing::Test {
 protected:
  static v1::Config Wall() {
    v1::Config config;
    config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
    config.mutable_clock()->set_skew_max_s(0.025);
    return config;
  }

  World Connect(std::uint64_t sender, const std::string& name) {
    return service_.Connect(sender, {.simulator = name, .lock_step = false, .wall_clock = [this] {
                                       return service_.clocks().wall_ns;
                                     }});
  }

  State At(double x) { return {.stamp_ns = service_.clocks().wall_ns, .position_m = {x, 0, 0}}; }

  void Publish(World* world) {
    world->Publish(service_.clocks().wall_ns);
    world->Poll();
  }

  InProcessService service_{Wall(), 2};
  World left_ = Connect(1, "left"), right_ = Connect(2, "right");
};

TEST_F(WideningTest, CountsWhenTheOtherHasAcknowledgedOrItsPromisesHaveExpired) {
  const AgentDescription calm{.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 0.1};
  Agent a = left_.AddAgent(calm, At(0)), b = right_.AddAgent(calm, At(30));
  const auto step = [&](bool right_lives) {
    a.SetState(At(0));
    b.SetState(At(30));
    Publish(&left_);
    if (right_lives) Publish(&right_);
    service_.Step(kStepS);
  };
  for (int i = 0; i < 50; ++i) step(true);
  EXPECT_TRUE(a.clearance().description_counts);
  const std::int64_t promised_ns = b.clearance().clear_until_ns;
  for (const bool right_lives : {true, false}) {
    const auto wild = [&] {
      AgentDescription description = calm;
      description.acceleration_max_m_s2 = right_lives ? 5 : 50;
      return description;
    }();
    const std::int64_t told_ns = service_.clocks().wall_ns;
    a.SetDescription(wild);
    EXPECT_FALSE(a.clearance().description_counts);
    std::int64_t counts_ns = 0;
    for (int i = 0; i < 200 && counts_ns == 0; ++i) {
      step(right_lives);
      if (a.clearance().description_counts) counts_ns = service_.clocks().wall_ns;
    }
    ASSERT_NE(counts_ns, 0);
    EXPECT_GE(a.clearance().effective_from_ns, told_ns);
    if (right_lives) {
      // Two ways: its clearance to the other, and that one's acknowledgement.
      EXPECT_LT(b.clearance().clear_until_ns, promised_ns);
      EXPECT_LE(counts_ns - told_ns, 15 * 20'000'000);
    } else {
      EXPECT_GE(counts_ns - told_ns, wire::kServiceLease);
      EXPECT_LE(counts_ns - told_ns, wire::kServiceLease + 300'000'000);
    }
  }
}

}  // namespace
}  // namespace collision::client
