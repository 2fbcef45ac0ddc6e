// Goal:   when the clock of one simulator turns out to be wrong, its agents leave all promises,
//         each agent that could have met one of them hears from when on they are void, and no other
//         one does; the agents come back with their next states.
// Method: few agents on a line, each with a simulator of its own, whose clearances are compared
//         before and after.
#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

/// The clearance of an agent among those that have changed; nullptr: it has not.
const AgentClearance* Find(const std::vector<AgentClearance>& changed, std::uint32_t slot) {
  const auto found = std::find_if(changed.begin(), changed.end(),
                                  [&](const AgentClearance& c) { return c.agent == Id(slot); });
  return found == changed.end() ? nullptr : &*found;
}

TEST(VoidOwner, TellsItsAgentsAndAllThatCanMeetThem) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {10, 0, 0}, {0, 0, 0});
  line.Add(3, {1e6, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  line.detector.TakeChangedClearances();
  line.detector.VoidOwner(OwnerOf(Id(1)), At(0.5));
  line.Step();
  const auto changed = line.detector.TakeChangedClearances();
  ASSERT_EQ(changed.size(), 3u) << "near or far: where the agent truly is, is not known";
  for (const AgentClearance& clearance : changed) {
    EXPECT_EQ(clearance.cause, ClearanceCause::kSkew);
    EXPECT_EQ(clearance.cause_agent, Id(1));
    EXPECT_EQ(clearance.void_from, At(0.5));
  }
  EXPECT_TRUE(Find(changed, 1)->not_clear);
  EXPECT_LE(Find(changed, 1)->clear_until, At(1));
  line.Step();
  EXPECT_TRUE(line.detector.TakeChangedClearances().empty()) << "it is told once";
}

TEST(VoidOwner, SaysNothingToAgentsThatTheirMasksKeepApart) {
  Line line;
  const auto add = [&](std::uint32_t slot, double x, std::uint32_t group, std::uint32_t mask) {
    line.detector.Admit(Id(slot), {.limits = {1, 1}, .filter = {group, mask}},
                        State(0, {x, 0, 0}, {0, 0, 0}), At(0));
  };
  add(1, 0, 1, 2);
  add(2, 10, 2, 1);
  add(3, 20, 4, 4);
  line.Step();
  line.detector.TakeChangedClearances();
  line.detector.VoidOwner(OwnerOf(Id(1)), Instant::Always());
  line.Step();
  const auto changed = line.detector.TakeChangedClearances();
  ASSERT_NE(Find(changed, 2), nullptr);
  EXPECT_EQ(Find(changed, 2)->void_from, Instant::Always());
  EXPECT_EQ(Find(changed, 3), nullptr);
}

TEST(VoidOwner, LeavesThePairsOfOthersAlone) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3, 0, 0}, {0, 0, 0});
  line.Add(3, {6, 0, 0}, {0, 0, 0});
  line.Step();
  ASSERT_EQ(line.With(EventStatus::kPossible).size(), 3u);
  line.detector.VoidOwner(OwnerOf(Id(3)), At(0));
  line.Step();
  EXPECT_EQ(line.With(EventStatus::kWithdrawn).size(), 2u);
  EXPECT_EQ(line.detector.pairs_tracked(), 1u);
  EXPECT_LT(line.detector.ClearanceOf(Id(1))->clear_until, At(2));
}

TEST(VoidOwner, ItsAgentsComeBackWithTheirNextStates) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {3, 0, 0}, {0, 0, 0});
  line.RunTo(1);
  line.detector.VoidOwner(OwnerOf(Id(1)), At(0));
  line.Step();
  EXPECT_EQ(line.detector.pairs_tracked(), 0u);
  EXPECT_EQ(line.detector.agents(), 2u);
  // Far from where it was: after what nobody believed, that is no breach.
  EXPECT_EQ(line.detector.Update(Id(1), State(2, {6, 0, 0}, {0, 0, 0}), At(2)),
            UpdateOutcome::kJumped);
  line.now = 2;
  line.Step();
  EXPECT_EQ(line.detector.counters().breaches, 0u);
  EXPECT_EQ(line.detector.pairs_tracked(), 1u);
}

TEST(VoidOwner, AnOwnerWithoutAgentsVoidsNothing) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Step();
  line.detector.TakeChangedClearances();
  line.detector.VoidOwner({77, 1}, At(0));
  line.Step();
  EXPECT_TRUE(line.detector.TakeChangedClearances().empty());
}

}  // namespace
}  // namespace collision::detection
