// Goal:   no simulator alone takes what others are guaranteed, and what is told to one does not
//         silence what is told to another.
// Method: daemons on scripted buses.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kGreedy = 10, kModest = 20;  // senders

/// Descriptions, states and the clock of a simulator with so many agents.
std::vector<v1::Input> Joins(const std::string& name, std::uint64_t sender, std::uint32_t agents) {
  std::vector<v1::Input> inputs;
  v1::AgentStates chunk = Chunk(name);
  for (std::uint32_t slot = 0; slot < agents; ++slot) {
    inputs.push_back(From(sender, Description(name, slot)));
    *chunk.add_states() = State(slot, 0, slot + 1);
  }
  inputs.push_back(From(sender, chunk));
  inputs.push_back(From(sender, ClockAfter(name, 0, agents, agents)));
  return inputs;
}

std::uint32_t AgentsOf(const v1::ServiceStatus& status, const std::string& name) {
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    if (simulator.name() == name) return simulator.agents();
  }
  return 0;
}

std::size_t RejectionsOf(const ScriptedDaemon& daemon, const std::string& name) {
  const std::vector<v1::Rejection> all = daemon.rejections();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const auto& one) {
    return one.simulator_id() == SimulatorId(name);
  }));
}

v1::Config Small() {
  v1::Config config = Simulated();
  config.set_agents_max(10);
  config.set_simulators_max(4);
  return config;
}

TEST(Quotas, AgentsAreKeptForEachSimulatorOfTheWorld) {
  ScriptedDaemon daemon(Small());
  std::vector<v1::Input> both = Joins("greedy", kGreedy, 12);
  for (const v1::Input& input : Joins("modest", kModest, 1)) both.push_back(input);
  daemon.Step(both);
  EXPECT_EQ(daemon.status().agents(), 9u) << "8 and 1: 2 of 10 are guaranteed to the modest one";
  EXPECT_EQ(RejectionsOf(daemon, "greedy"), 4u);
  EXPECT_EQ(RejectionsOf(daemon, "modest"), 0u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_TOO_MANY_AGENTS);
  EXPECT_NE(Extension(daemon.status(), "quotas").find("greedy: agents 8 of 8"), std::string::npos);
  EXPECT_EQ(Extension(daemon.status(), "quotas").find("modest"), std::string::npos);
}

TEST(Quotas, ASimulatorThatIsAloneMayHaveEverything) {
  ScriptedDaemon daemon(Small());
  daemon.Step(Joins("greedy", kGreedy, 12));
  EXPECT_EQ(daemon.status().agents(), 10u);
  // What was taken is not taken back; it is kept once it is free.
  daemon.Step(Joins("modest", kModest, 1));
  EXPECT_EQ(daemon.status().agents(), 10u);
  daemon.Step({Removal(kGreedy, "greedy", 0), From(kGreedy, ClockAfter("greedy", 1, 12, 12)),
               From(kModest, State(0, 1, 2), "modest"),
               From(kModest, ClockAfter("modest", 1, 2, 1))});
  daemon.Step({From(kModest, State(0, 2, 3), "modest"),
               From(kGreedy, ClockAfter("greedy", 2, 12, 12)),
               From(kModest, ClockAfter("modest", 2, 3, 1))});
  EXPECT_EQ(daemon.status().agents(), 10u);
  EXPECT_EQ(daemon.counter("agents_admitted"), 11u);
}

TEST(Quotas, ANameInTheConfigurationHasItsPlaceAndItsMaximum) {
  v1::Config config = Small();
  config.set_simulators_max(2);
  v1::SimulatorLimits& vip = *config.add_limits();
  vip.set_name("vip");
  vip.set_guaranteed(0.4);
  v1::SimulatorLimits& others = *config.add_limits();
  others.set_name("*");
  others.set_agents_max(5);
  ScriptedDaemon daemon(config);
  daemon.Step(Joins("greedy", kGreedy, 7));
  EXPECT_EQ(daemon.status().agents(), 5u);
  daemon.Step(Joins("third", 30, 1));
  EXPECT_EQ(daemon.rejections().back().reason(), v1::REJECTED_TOO_MANY_SIMULATORS);
  daemon.Step(Joins("vip", kModest, 5));
  EXPECT_EQ(daemon.status().agents(), 10u);
  EXPECT_EQ(AgentsOf(daemon.status(), "vip"), 5u);
}

TEST(Quotas, WhatOneIsToldDoesNotSilenceOthers) {
  v1::Config config = Simulated();
  config.set_rejections_per_second_max(10);
  config.set_simulators_max(4);
  ScriptedDaemon daemon(config);
  daemon.Step(Joins("greedy", kGreedy, 1));
  daemon.Step(Joins("modest", kModest, 1));
  std::vector<v1::Input> bad;
  for (std::uint64_t i = 0; i < 50; ++i) {
    v1::AgentState state = State(0, 0, 100 + i);
    state.set_position_error_m(-1);
    bad.push_back(From(kGreedy, state, "greedy"));
    bad.push_back(From(kModest, state, "modest"));
  }
  daemon.Step(bad);
  EXPECT_EQ(RejectionsOf(daemon, "greedy") + RejectionsOf(daemon, "modest"), 10u);
  EXPECT_GE(RejectionsOf(daemon, "greedy"), 2u);
  EXPECT_GE(RejectionsOf(daemon, "modest"), 2u);
  daemon.Step({bad[0]}, 1);
  EXPECT_EQ(daemon.rejections().size(), 10u) << "a repetition is no news";
}

}  // namespace
}  // namespace collision::server
