// Goal:   simulators and a service whose wall clocks are set go on by themselves, and the contact
//         that lies ahead is told again and confirmed.
// Method: two simulators with the library, over a daemon in the same thread; all go by one clock,
//         which is set while they close in on each other.
#include <gtest/gtest.h>

#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr double kStepS = 0.02;

v1::Config Wall() {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.mutable_clock()->set_skew_max_s(0.025);
  return config;
}

class ClockStepTest : public testing::TestWithParam<std::int64_t> {
 protected:
  World Connect(std::uint64_t sender, const std::string& name) {
    return service_.Connect(sender, {.simulator = name, .lock_step = false, .wall_clock = [this] {
                                       return service_.clocks().wall_ns;
                                     }});
  }

  State StateAt(double x, double v) {
    return {.stamp_ns = service_.clocks().wall_ns,
            .position_m = {x + v * elapsed_s_, 0, 0},
            .velocity_m_s = {v, 0, 0}};
  }

  InProcessService service_{Wall(), 1};
  double elapsed_s_ = 0;
};

TEST_P(ClockStepTest, TheContactIsToldAgainAndConfirmed) {
  World left = Connect(1, "left"), right = Connect(2, "right");
  // They touch after 5 s, 2 s after the step.
  const AgentDescription ball{.name = "ball", .radius_m = 1, .acceleration_max_m_s2 = 2};
  Agent a = left.AddAgent(ball, StateAt(0, 0)), b = right.AddAgent(ball, StateAt(32, -6));
  const auto fly = [&](double until_s) {
    for (; elapsed_s_ < until_s; elapsed_s_ += kStepS) {
      a.SetState(StateAt(0, 0));
      b.SetState(StateAt(32, -6));
      for (World* world : {&left, &right}) {
        world->Publish(service_.clocks().wall_ns);
        world->Poll();
      }
      service_.Step(kStepS);
    }
  };
  fly(3);
  ASSERT_FALSE(left.TakeEvents().empty());
  std::vector<std::string> voided;
  left.OnVoid([&](const AgentId&, const Clearance& clearance) {
    voided.push_back(clearance.cause);
    EXPECT_EQ(clearance.void_from_ns, std::numeric_limits<std::int64_t>::min());
  });
  service_.clocks().wall_ns += GetParam();
  const std::size_t before = service_.said().size();
  fly(6);
  int refused = 0;
  bool offset_known = false;
  for (std::size_t i = before; i < service_.said().size(); ++i) {
    const v1::Output& output = service_.said()[i];
    if (output.has_rejection()) ++refused;
    if (!output.has_service_status()) continue;
    EXPECT_EQ(output.service_status().stamp().epoch(), 2u);
    for (const v1::SimulatorStatus& simulator : output.service_status().simulators()) {
      offset_known = simulator.clock_offset().latest_ns() != kNever;
      if (offset_known) {
        EXPECT_LE(simulator.clock_offset().earliest_ns(), 0);
        EXPECT_GE(simulator.clock_offset().latest_ns(), 0);
      }
    }
  }
  EXPECT_TRUE(offset_known);
  EXPECT_EQ(voided, std::vector<std::string>{"CAUSE_SKEW"});
  EXPECT_LE(refused, 8) << "what was on its way";
  for (World* world : {&left, &right}) {
    bool confirmed = false;
    for (const Event& event : world->TakeEvents()) {
      confirmed |= event.status == EventStatus::kConfirmed;
    }
    EXPECT_TRUE(confirmed);
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, ClockStepTest, testing::Values(5 * kSecond, -12 * kSecond));

}  // namespace
}  // namespace collision::client
