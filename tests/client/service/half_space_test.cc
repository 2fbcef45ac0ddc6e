// Goal:   a floor that one simulator adds is met by the agents of another one: told in time, to
//         both, with what a level says before; what is no half-space is refused by field.
// Method: two simulators with the library in lock-step, over a daemon in the same thread; a ball
//         falls at a steady speed.
#include <gtest/gtest.h>

#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

class HalfSpaceTest : public testing::Test {
 protected:
  static v1::Config ConfigWithALevel() {
    v1::Config config = RoundsOfTwo();
    v1::Level* level = config.add_levels();
    level->set_name("low");
    level->set_margin_m(0.5);
    return config;
  }

  void SetUp() override {
    ground_.OnEvent([this](const Event& event) { told_ground_.push_back(event); });
    drones_.OnEvent([this](const Event& event) { told_drones_.push_back(event); });
  }

  void Advance(std::int64_t clock_ns) { AdvanceBoth(clock_ns, &service_, &ground_, &drones_); }

  static void ExpectOneContact(const std::vector<Event>& events, const std::string& level,
                               double begin_s) {
    const Event* confirmed = nullptr;
    for (const Event& event : events) {
      if (event.level == level && event.status == EventStatus::kConfirmed) confirmed = &event;
    }
    ASSERT_NE(confirmed, nullptr) << level;
    EXPECT_LE(static_cast<double>(confirmed->begin.earliest_ns), begin_s * 1e9 + 1);
    EXPECT_GE(static_cast<double>(confirmed->begin.latest_ns), begin_s * 1e9 - 1);
    EXPECT_LE(static_cast<double>(confirmed->begin.latest_ns - confirmed->begin.earliest_ns), 5e7);
  }

  InProcessService service_{ConfigWithALevel(), 1};
  World ground_ = service_.Connect(1, {.simulator = "ground", .levels = {"low"}});
  World drones_ = service_.Connect(2, {.simulator = "drones", .levels = {"low"}});
  std::vector<Event> told_ground_, told_drones_;
};

TEST_F(HalfSpaceTest, AFloorIsMetByTheAgentsOfAnotherSimulator) {
  const Agent floor =
      ground_.AddAgent({.name = "floor", .half_space = HalfSpace{{0, 0, 1}, 10}}, {.stamp_ns = 0});
  const AgentDescription ball{.name = "drone", .radius_m = 1, .acceleration_max_m_s2 = 0.5};
  Agent drone = drones_.AddAgent(
      ball, {.stamp_ns = 0, .position_m = {5e3, 0, 14}, .velocity_m_s = {0, 0, -2}});
  Advance(0);
  for (int step = 1; step <= 25; ++step) {
    const double t = 0.1 * step;
    drone.SetState({.stamp_ns = 100 * step * kMillisecond,
                    .position_m = {5e3, 0, 14 - 2 * t},
                    .velocity_m_s = {0, 0, -2}});
    Advance(100 * step * kMillisecond);
  }
  for (const auto* events : {&told_ground_, &told_drones_}) {
    ExpectOneContact(*events, "", 1.5);
    ExpectOneContact(*events, "low", 1.25);
  }
}

TEST_F(HalfSpaceTest, WhatIsNoHalfSpaceIsRefusedByField) {
  const auto complaint = [&](const AgentDescription& description) -> std::string {
    try {
      ground_.AddAgent(description, {.stamp_ns = 0});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({.name = "a", .half_space = HalfSpace{{0, 0, 2}, 10}}),
            "half_space.normal has the length 2; allowed is 1, to within 1e-06");
  EXPECT_EQ(complaint({.name = "a", .half_space = HalfSpace{{0, 0, 1}, 1e16}}),
            "half_space.offset_m is 1e+16; allowed are -1e+15 to 1e+15");
  EXPECT_EQ(complaint({.name = "a", .radius_m = 1, .half_space = HalfSpace{}}),
            "radius_m: 1, allowed: 0, or left out, of a half-space");
  EXPECT_EQ(complaint({.name = "a", .acceleration_max_m_s2 = 2, .half_space = HalfSpace{}}),
            "acceleration_max_m_s2: 2, allowed: 0, or left out, of a half-space");
}

}  // namespace
}  // namespace collision::client
