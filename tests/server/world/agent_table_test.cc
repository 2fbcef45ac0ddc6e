// Goal:   the table and its clearances agree at every moment, and everything that a clearance
//         sample says marks the sample when it changes.
#include "server/world/agent_table.h"

#include <gtest/gtest.h>

#include <set>

#include "collision_core/base/check.h"

namespace collision::server {
namespace {

using Chunks = std::set<std::uint32_t>;

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

Agent Described(std::uint32_t generation) { return {generation, 1, detection::AgentDeclaration{}}; }

detection::AgentClearance ClearanceOf(std::uint32_t slot, std::uint32_t generation,
                                      Instant clear_until) {
  return {.agent = {.simulator = 1, .slot = slot, .run = 1, .generation = generation},
          .clear_until = clear_until};
}

/// With an admitted agent of generation 3 in slot 70, and nothing marked.
AgentTable Table() {
  AgentTable table;
  table.Add(70, Described(3));
  table.Admit(70, At(1), 10);
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{1});
  return table;
}

TEST(AgentTable, EachChangeMarksItsChunkAndNoOther) {
  AgentTable table = Table();
  table.Acknowledge(70, At(2), 11);
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{1});
  EXPECT_EQ(table.Find(70)->stamp(), At(2));
  EXPECT_EQ(table.Find(70)->acknowledged_sequence(), 11u);
  table.Revise(70, 2, {});
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{1});
  EXPECT_EQ(table.Find(70)->revision(), 2u);
  table.SetClearance(ClearanceOf(70, 3, At(9)));
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{1});
  EXPECT_EQ(table.clearances().all().at(70).clear_until, At(9));
  table.Remove(70);
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{1});
  EXPECT_TRUE(table.clearances().all().empty());
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{});
  table.Validate();
}

// Goal:   the time until which all agents of a simulator are clear follows each change.
TEST(AgentTable, KnowsUntilWhenAllAgentsAreClear) {
  AgentTable table = Table();
  EXPECT_TRUE(table.clearances().clear_until().is_never());
  table.Add(6, Described(1));
  table.Admit(6, At(1), 10);
  table.SetClearance(ClearanceOf(70, 3, At(9)));
  table.SetClearance(ClearanceOf(6, 1, At(5)));
  EXPECT_EQ(table.clearances().clear_until(), At(5));
  table.SetClearance(ClearanceOf(6, 1, At(12)));
  EXPECT_EQ(table.clearances().clear_until(), At(9));
  detection::AgentClearance touching = ClearanceOf(6, 1, At(12));
  touching.in_contact = true;
  table.SetClearance(touching);
  EXPECT_EQ(table.clearances().clear_until(), Instant::Always());
  table.Validate();
  table.Remove(6);
  EXPECT_EQ(table.clearances().clear_until(), At(9));
  table.Remove(70);
  EXPECT_TRUE(table.clearances().clear_until().is_never());
  table.Validate();
}

TEST(AgentTable, WhatASampleDoesNotSayMarksNothing) {
  AgentTable table = Table();
  EXPECT_EQ(table.RecordState(70, 3, 12), StateOrder::kNew);
  table.SetWaiting(5, {.generation = 1, .sequence = 1, .state = {}}, AgentTable::Former::kReplaced);
  table.Add(6, Described(1));
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{});
  table.Validate();
}

TEST(AgentTable, AClearanceOfAnAgentThatIsGoneIsIgnored) {
  AgentTable table = Table();
  table.SetClearance(ClearanceOf(70, 2, At(9)));
  table.SetClearance(ClearanceOf(71, 3, At(9)));
  EXPECT_TRUE(table.clearances().all().empty());
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), Chunks{});
}

TEST(AgentTable, StatesAreNewOnceAndNeverAfterTheirGeneration) {
  AgentTable table = Table();
  EXPECT_EQ(table.RecordState(70, 3, 5), StateOrder::kNew);
  EXPECT_EQ(table.RecordState(70, 3, 5), StateOrder::kRepeated);
  EXPECT_EQ(table.RecordState(70, 3, 4), StateOrder::kRepeated);
  EXPECT_EQ(table.RecordState(70, 2, 6), StateOrder::kEnded);
  EXPECT_EQ(table.RecordState(70, 4, 1), StateOrder::kNew);
  table.Remove(70);
  EXPECT_EQ(table.RecordState(70, 3, 9), StateOrder::kEnded);
  EXPECT_TRUE(table.HasEnded(70, 3));
  EXPECT_FALSE(table.HasEnded(70, 4));
  EXPECT_FALSE(table.HasEnded(71, 0));
}

// Goal:   a removal ends the state that waits for the same generation, not the one of the next.
TEST(AgentTable, RemovalEndsWhatWaitsForTheSameGeneration) {
  for (const std::uint32_t generation : {3u, 4u}) {
    AgentTable table = Table();
    table.SetWaiting(70, {.generation = generation, .sequence = 1, .state = {}},
                     AgentTable::Former::kReplaced);
    table.Remove(70);
    EXPECT_EQ(table.Waiting(70) != nullptr, generation == 4);
    table.Validate();
  }
  AgentTable table;
  table.SetWaiting(1, {.generation = 8, .sequence = 1, .state = {}}, AgentTable::Former::kReplaced);
  table.RemoveWaiting(1);
  EXPECT_EQ(table.Waiting(1), nullptr);
  EXPECT_TRUE(table.HasEnded(1, 8));
}

TEST(AgentTable, ANewRunMarksEveryUsedSlot) {
  AgentTable table = Table();
  table.SetWaiting(200, {.generation = 1, .sequence = 1, .state = {}},
                   AgentTable::Former::kReplaced);
  EXPECT_THROW(table.Clear(), CheckFailure);
  table.Remove(70);
  table.Clear();
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), (Chunks{1, 3}));
  EXPECT_EQ(table.RecordState(70, 1, 1), StateOrder::kNew);
  table.Validate();
}

TEST(AgentTable, AnExpelledAgentKeepsItsDescriptionAndWaitsForItsNextState) {
  AgentTable table = Table();
  table.RecordState(70, 3, 1);
  table.Admit(70, At(1), 1);
  static_cast<void>(table.clearances().TakeChanged(0, 0, {}));
  table.SetWaiting(70, {.generation = 3, .sequence = 2, .state = {}},
                   AgentTable::Former::kReplaced);
  table.Expel(70);
  ASSERT_NE(table.Find(70), nullptr);
  EXPECT_FALSE(table.Find(70)->admitted());
  EXPECT_EQ(table.Find(70)->stamp(), Instant::Always());
  EXPECT_EQ(table.Find(70)->acknowledged_sequence(), 0u);
  EXPECT_EQ(table.Waiting(70), nullptr);
  EXPECT_EQ(table.clearances().TakeChanged(0, 0, {}), (Chunks{1}));
  EXPECT_EQ(table.RecordState(70, 3, 1), StateOrder::kRepeated) << "what was known stays known";
  table.Expel(5);
  table.Validate();
}

TEST(AgentTable, AStateThatWaitsIsDroppedAndItsGenerationGoesOn) {
  AgentTable table = Table();
  table.SetWaiting(5, {.generation = 2, .sequence = 1, .state = {}}, AgentTable::Former::kReplaced);
  table.DropWaiting(5);
  table.DropWaiting(6);
  EXPECT_EQ(table.Waiting(5), nullptr);
  EXPECT_FALSE(table.HasEnded(5, 2));
}

TEST(AgentTable, PreconditionsAreChecked) {
  AgentTable table = Table();
  EXPECT_THROW(table.Add(70, Described(4)), CheckFailure);
  EXPECT_THROW(table.Remove(1), CheckFailure);
  EXPECT_THROW(table.Admit(1, At(0), 1), CheckFailure);
  EXPECT_THROW(table.Acknowledge(1, At(0), 1), CheckFailure);
  EXPECT_THROW(table.Revise(1, 1, {}), CheckFailure);
  EXPECT_THROW(static_cast<void>(table.TakeWaiting(70)), CheckFailure);
  table.Remove(70);
  EXPECT_THROW(table.Add(70, Described(3)), CheckFailure);
}

TEST(AgentTable, ARevisionCountsAtTheLatestFromTheAdmissionOn) {
  AgentTable table;
  table.Add(5, {1, 1, {}});
  table.Admit(5, {}, 1);
  table.Revise(5, 2, {});
  EXPECT_EQ(table.Find(5)->acknowledged_revision(), 1u);
  table.AcknowledgeRevision(5, 1, 2, Instant::FromNanoseconds(70));
  EXPECT_EQ(table.Find(5)->acknowledged_from(), Instant::FromNanoseconds(70));
  // Another epoch, whose time may be earlier.
  table.Expel(5);
  table.Revise(5, 3, {});
  table.Admit(5, {}, 2);
  EXPECT_EQ(table.Find(5)->acknowledged_revision(), 3u);
  EXPECT_EQ(table.Find(5)->acknowledged_from(), Instant::Always());
}

TEST(AgentTable, StatesThatCountWaitBeforeTheNewestOneUpToABound) {
  AgentTable table;
  const auto set = [&](std::uint64_t sequence, bool former_counts) {
    table.SetWaiting(5, {.generation = 1, .sequence = sequence, .state = {}},
                     former_counts ? AgentTable::Former::kWaitsOn : AgentTable::Former::kReplaced);
  };
  const auto taken = [&] {
    std::vector<std::uint64_t> sequences;
    for (const WaitingState& one : table.TakeWaiting(5)) sequences.push_back(one.sequence);
    return sequences;
  };
  table.Add(5, {1, 1, {}});
  set(3, false);
  set(4, true);
  set(5, false);
  set(6, false);
  set(7, true);
  EXPECT_EQ(taken(), (std::vector<std::uint64_t>{3, 6, 7}));
  for (std::uint64_t sequence = 10; sequence < 200; ++sequence) set(sequence, true);
  const std::vector<std::uint64_t> all = taken();
  EXPECT_EQ(all.size(), kWaitingBeforeMax + 1);
  EXPECT_EQ(all.back(), 199u);
}

}  // namespace
}  // namespace collision::server
