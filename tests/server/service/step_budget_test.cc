// Goal:   a simulator whose pairs want more than their share is named in the status, with its share
//         and for how long, until none waits; a long step tells that it goes on, which changes
//         nothing.
// Method: balls of one simulator at one place, under the smallest step budget there is.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::uint32_t kAgents = 12;
constexpr std::int64_t kTick = 1'000'000'000 / 60;

v1::Config Tight() {
  v1::Config config = Simulated();
  config.set_step_budget_us(1);
  return config;
}

std::vector<v1::Input> Descriptions() {
  std::vector<v1::Input> inputs;
  for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
    inputs.push_back(From(1, Description("greedy", slot)));
  }
  return inputs;
}

/// All states and the clock of a tick; `apart`: 100 m from each other.
std::vector<v1::Input> Tick(int tick, bool apart = false) {
  v1::AgentStates chunk = Chunk("greedy");
  std::uint64_t sequence = tick * kAgents;
  for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
    v1::AgentState state = State(slot, tick * kTick, ++sequence);
    if (!apart) state.mutable_position_m()->set_x(0.001 * slot);
    state.set_discontinuity(apart);
    *chunk.add_states() = state;
  }
  v1::SimulatorClock clock = ClockOf("greedy", tick * kTick);
  clock.set_states_sequence(sequence);
  clock.set_descriptions_sequence(kAgents);
  clock.set_agents(kAgents);
  return {From(1, chunk), From(1, clock)};
}

void Fly(ScriptedDaemon* daemon, int from, int to, bool apart = false) {
  for (int tick = from; tick < to; ++tick) daemon->Step(Tick(tick, apart), 1.0 / 60);
}

std::string Held(const v1::ServiceStatus& status) {
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == "narrow_phase_held") return extension.value();
  }
  return {};
}

TEST(StepBudget, NamesTheSimulatorThatIsHeldToItsShare) {
  ScriptedDaemon daemon(Tight());
  daemon.Step(Descriptions());
  Fly(&daemon, 0, 30);
  EXPECT_EQ(Held(daemon.status()), "") << "not for half a second";
  EXPECT_GT(daemon.counter("pairs_waiting"), kAgents);
  Fly(&daemon, 30, 200);
  const std::string held = Held(daemon.status());
  EXPECT_TRUE(held.starts_with("greedy (held to its share of 1/1 for 3 s; ")) << held;
  EXPECT_TRUE(held.ends_with(" pairs wait)")) << held;
  Fly(&daemon, 200, 600, true);
  EXPECT_EQ(daemon.counter("pairs_waiting"), 0u);
  EXPECT_EQ(Held(daemon.status()), "");
}

/// Statuses that a first step publishes in which the call number `at` asks for one.
std::ptrdiff_t StatusesWith(int at) {
  int calls = 0;
  ScriptedDaemon daemon(Simulated(), DaemonParts{.progress = [&] { return ++calls == at; }});
  daemon.Step(Descriptions());
  Fly(&daemon, 0, 1);
  EXPECT_GT(calls, 3) << "after each query of an agent and each evaluation of a pair";
  return std::count_if(daemon.bus().outputs.begin(), daemon.bus().outputs.end(),
                       [](const v1::Output& output) { return output.has_service_status(); });
}

TEST(StepBudget, ALongStepTellsThatItGoesOn) { EXPECT_EQ(StatusesWith(3), StatusesWith(0) + 1); }

TEST(StepBudget, WhatIsToldInAStepChangesNoEvent) {
  std::uint64_t hashes[2];
  for (std::uint64_t& hash : hashes) {
    int calls = 0;
    const bool first = &hash == hashes;
    ScriptedDaemon daemon(Tight(),
                          DaemonParts{.progress = [&] { return first && ++calls % 5 == 0; }});
    daemon.Step(Descriptions());
    Fly(&daemon, 0, 60);
    EXPECT_GT(daemon.daemon().event_log().count(), kAgents);
    hash = daemon.daemon().event_log().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace collision::server
