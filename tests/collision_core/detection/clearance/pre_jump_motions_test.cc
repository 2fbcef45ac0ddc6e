// Goal:   an agent that jumped is found on its former motion up to the jump, and not beyond; the
//         motions that are kept are bounded, and forgotten in time.
// Method: one agent on a line; queries at places that it passes before and after its jump.
#include "collision_core/detection/clearance/search/pre_jump_motions.h"

#include <gtest/gtest.h>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

motion::SpaceTimeBound Around(double x) {
  motion::SpaceTimeBound bound;
  bound.state = State(0, {x, 0, 0}, {0, 0, 0});
  bound.limits.radius = 1;
  bound.limits.acceleration_max = 1e-30;
  return bound;
}

motion::SpaceTimeBound Runner(double y = 0) {
  motion::SpaceTimeBound bound;
  bound.state = State(0, {0, y, 0}, {10, 0, 0});
  bound.limits.radius = 1;
  return bound;
}

std::vector<AgentIndex> FoundAt(double x, double from, double until, PreJumpMotions* motions) {
  std::vector<AgentIndex> agents;
  motions->Find(Around(x), At(from), At(until), &agents);
  return agents;
}

TEST(PreJumpMotions, HoldUpToTheJump) {
  PreJumpMotions motions(std::make_unique<broad_phase::AllPairs>(), 4);
  EXPECT_TRUE(FoundAt(5, 0, 9, &motions).empty());
  const AgentIndex agent(7u);
  motions.Record(agent, Runner(), At(2));
  EXPECT_EQ(FoundAt(10, 0, 9, &motions), std::vector{agent}) << "passed at 1 s";
  EXPECT_TRUE(FoundAt(10, 0, 0.5, &motions).empty()) << "not there yet";
  EXPECT_TRUE(FoundAt(40, 0, 9, &motions).empty()) << "it would be there at 4 s";
  motions.Forget(At(1.9));
  EXPECT_EQ(motions.size(), 1u);
  motions.Forget(At(2));
  EXPECT_TRUE(FoundAt(10, 0, 9, &motions).empty());
}

TEST(PreJumpMotions, TheOldestGoesWhereThereIsNoRoom) {
  PreJumpMotions motions(std::make_unique<broad_phase::AllPairs>(), 2);
  for (std::uint32_t k = 0; k < 3; ++k) motions.Record(AgentIndex(k), Runner(), At(2));
  EXPECT_EQ(motions.size(), 2u);
  EXPECT_EQ(FoundAt(10, 0, 9, &motions).size(), 2u);
  PreJumpMotions none(std::make_unique<broad_phase::AllPairs>(), 0);
  none.Record(AgentIndex(1u), Runner(), At(2));
  EXPECT_EQ(none.size(), 0u);
}

TEST(PreJumpMotions, ValidateFindsAMotionThatTheIndexDoesNotHold) {
  auto index = std::make_unique<broad_phase::AllPairs>();
  broad_phase::AllPairs* const held = index.get();
  PreJumpMotions motions(std::move(index), 4);
  for (std::uint32_t k = 0; k < 3; ++k) motions.Record(AgentIndex(k), Runner(), At(k));
  motions.Forget(At(0));
  motions.Validate();
  held->Set(0, {Runner(), {}});
  EXPECT_THROW(motions.Validate(), CheckFailure) << "it was forgotten";
  held->Remove(0);
  motions.Validate();
  held->Remove(1);
  EXPECT_THROW(motions.Validate(), CheckFailure);
}

}  // namespace
}  // namespace collision::detection
