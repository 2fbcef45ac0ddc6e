// Goal:   a jump that is staged reaches the service, also if a later state replaces it; and what a
//         clock counts is there to be read by a service that comes later, or has not all yet.
#include "client/library/world/agent_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace collision::client {
namespace {

// The jump has happened, although the clock never came to its stamp.
TEST(AgentTable, AJumpSurvivesALaterStagedState) {
  AgentTable table("simulator", 1, 1, 1, {});
  const AgentId ball = table.Add({.name = "ball"}, {.stamp_ns = 0});
  EXPECT_FALSE(table.TakeDue(0).at(0).states(0).discontinuity());
  table.Stage(ball, {.stamp_ns = 1, .position_m = {51, 0, 0}, .discontinuity = true});
  table.Stage(ball, {.stamp_ns = 2, .position_m = {51, 0, 0}});
  EXPECT_TRUE(table.TakeDue(1).empty());
  const v1::AgentStates sent = table.TakeDue(2).at(0);
  ASSERT_EQ(sent.states_size(), 2) << "behind the first state";
  EXPECT_EQ(sent.states(1).position_m().x(), 51);
  EXPECT_TRUE(sent.states(1).discontinuity());
}

// Each of two agents has been where it cannot have been, a hundred times.
TEST(AgentTable, ASampleCarriesTheNewestOfTheStatesThatCount) {
  AgentTable table("simulator", 1, 1, 1, {});
  std::vector<AgentId> agents;
  for (const char* name : {"a", "b"}) agents.push_back(table.Add({.name = name}, {.stamp_ns = 0}));
  v1::AgentStates sample;
  for (int k = 1; k <= 100; ++k) {
    for (const AgentId& agent : agents) {
      table.Stage(agent, {.stamp_ns = k, .position_m = {5.0 * k, 0, 0}});
    }
    sample = table.TakeDue(k).at(0);
  }
  ASSERT_EQ(sample.states_size(), 66);
  std::array<std::uint64_t, 2> newest{};
  for (const v1::AgentState& state : sample.states()) {
    EXPECT_GT(state.sequence(), 200u - 66);
    EXPECT_GT(state.sequence(), std::exchange(newest[state.slot()], state.sequence()));
  }
  EXPECT_EQ(newest, (std::array<std::uint64_t, 2>{199, 200}));
}

// It has sped up by what was declared before; from then on it does not.
TEST(AgentTable, WhatWasDeclaredBeforeCountsUpToTheNextState) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  AgentTable table("simulator", 1, 1, 1, {});
  const AgentId ball = table.Add({.name = "ball", .acceleration_max_m_s2 = 2}, {.stamp_ns = 0});
  table.TakeDue(0);
  v1::AgentClearance first;
  first.set_generation(1);
  first.set_acknowledged_sequence(1);
  table.SetClearance(first, 0);
  table.Describe(ball, {.name = "ball", .acceleration_max_m_s2 = 0});
  const auto carried = [&](std::int64_t stamp_ns, double x, double v) {
    table.Stage(ball, {.stamp_ns = stamp_ns, .position_m = {x, 0, 0}, .velocity_m_s = {v, 0, 0}});
    return table.TakeDue(stamp_ns).at(0).states_size() - 1;
  };
  EXPECT_EQ(carried(kSecond, 1, 2), 0);
  EXPECT_EQ(carried(2 * kSecond, 3, 2), 0);
  EXPECT_EQ(carried(3 * kSecond, 6, 4), 1) << "the state before, which this one belies";
}

// Lock-step: a removed agent's last states, sent with the next clock, stand until the round is
// over, which may take several steps, and the clock that ends it names them.
TEST(AgentTable, AClockNamesOnlyStatesThatStand) {
  AgentTable table("simulator", 1, 1, 1, {});
  const AgentId first = table.Add({.name = "first"}, {.stamp_ns = 0});
  const AgentId second = table.Add({.name = "second"}, {.stamp_ns = 0});
  table.TakeDue(0);
  EXPECT_EQ(table.Clock(0, 0, true).states_sequence(), 2u);
  table.Remove(second);
  table.EndRound();
  EXPECT_EQ(table.Clock(0, 0, true).states_sequence(), 2u) << "it stays in its chunk for now";
  const v1::AgentStates last = table.TakeDue(1).at(0);
  ASSERT_EQ(last.states_size(), 2);
  EXPECT_EQ(last.states(1).expiry_ns(), 0) << "when it left";
  EXPECT_EQ(table.Clock(1, 0, true).states_sequence(), 3u);
  EXPECT_TRUE(table.TakeDue(2).empty());
  table.EndRound();
  ASSERT_EQ(table.TakeDue(3).size(), 1u);
  EXPECT_EQ(table.SentStates().at(0).states_size(), 1);
  EXPECT_EQ(table.Clock(3, 0, true).states_sequence(), 1u);
  table.Remove(first);
  table.TakeDue(4);
  table.EndRound();
  table.TakeDue(5);
  EXPECT_EQ(table.Clock(5, 0, true).states_sequence(), 0u);
  EXPECT_EQ(table.stated(), 0u);
}

TEST(AgentTable, OnTheWallClockARemovedAgentsStatesStandUntilTheClockMovesOn) {
  AgentTable table("simulator", 1, 1, 1, {.wall_clock = true});
  const AgentId only = table.Add({.name = "only"}, {.stamp_ns = 0});
  table.TakeDue(0);
  table.Remove(only);
  table.TakeDue(0);
  EXPECT_EQ(table.Clock(0, 0, false).states_sequence(), 1u);
  table.TakeDue(1);
  EXPECT_EQ(table.Clock(1, 0, false).states_sequence(), 0u);
}

// Goal:   of all descriptions and removals the newest has the sequence that the clock names.
TEST(AgentTable, ARemovalIsOneOfTheDescriptions) {
  AgentTable table("simulator", 1, 1, 77, {});
  table.Add({.name = "first"}, {});
  const AgentId second = table.Add({.name = "second"}, {});
  const v1::AgentRemoval removal = table.Remove(second);
  EXPECT_EQ(removal.slot(), second.slot);
  EXPECT_EQ(removal.incarnation(), 77u);
  EXPECT_EQ(removal.sequence(), 3u);
  EXPECT_EQ(table.Clock(0, 0, true).descriptions_sequence(), 3u);
  ASSERT_EQ(table.Removals().size(), 1u);
  EXPECT_EQ(table.Removals()[0].sequence(), 3u);
  EXPECT_EQ(table.Descriptions().size(), 1u);
  table.SetRun(9);
  EXPECT_EQ(table.Descriptions()[0].run(), 9u);
  EXPECT_EQ(table.Clock(0, 0, true).run(), 9u);
}

/// The highest sequence in each chunk, in the order of writing.
std::vector<std::uint64_t> Newest(const std::vector<v1::AgentStates>& chunks) {
  std::vector<std::uint64_t> newest;
  for (const v1::AgentStates& chunk : chunks) {
    std::uint64_t& sequence = newest.emplace_back(0);
    for (const v1::AgentState& state : chunk.states())
      sequence = std::max<std::uint64_t>(sequence, state.sequence());
  }
  return newest;
}

// Goal:   who has the state that a clock names has all states before it: nothing that was written
//         comes after the highest sequence.
// Method: states are set in another order than that of the slots; one that is not due yet waits
//         before the others.
TEST(AgentTable, TheHighestSequenceIsWrittenLast) {
  for (const std::uint32_t chunk_size : {1u, 2u, 64u}) {
    PublishPolicy policy;
    policy.chunk_size = chunk_size;
    AgentTable table("simulator", 1, 1, 1, policy);
    std::vector<AgentId> agents;
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
      agents.push_back(table.Add({.name = name}, {.stamp_ns = 0}));
    table.TakeDue(0);
    table.Stage(agents[5], {.stamp_ns = 2});
    for (const int agent : {4, 1, 3, 0}) table.Stage(agents[agent], {.stamp_ns = 1});
    for (const std::int64_t clock_ns : {1, 2}) {
      const auto written = Newest(table.TakeDue(clock_ns));
      ASSERT_FALSE(written.empty());
      EXPECT_TRUE(std::is_sorted(written.begin(), written.end())) << "chunks of " << chunk_size;
      EXPECT_EQ(written.back(), table.Clock(clock_ns, 0, true).states_sequence());
    }
    table.Stage(agents[0], {.stamp_ns = 3});
    table.TakeDue(3);
    const auto again = Newest(table.SentStates());
    EXPECT_TRUE(std::is_sorted(again.begin(), again.end())) << "chunks of " << chunk_size;
    EXPECT_EQ(again.back(), table.Clock(3, 0, true).states_sequence());
  }
}

}  // namespace
}  // namespace collision::client
