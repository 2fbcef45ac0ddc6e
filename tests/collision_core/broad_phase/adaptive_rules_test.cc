// Goal:   rules and half-spaces stay right while the chosen method changes.
// Method: scenes that grow and shrink past the limits, beside all pairs alone or by hand.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/rules_table.h"

namespace collision::broad_phase {
namespace {

// Goal:   a change of method, with rules and half-spaces that come and go while the next one is
//         filled, never shows. Method: beside all pairs alone, from a few agents to many and back.
TEST(AdaptiveBroadPhaseWithRules, ChangesOfMethodDoNotShow) {
  AdaptiveBroadPhase chosen;
  AllPairs plain;
  Random random(77);
  const auto both = [&](auto change) { change(&chosen), change(&plain); };
  const std::uint32_t most = AdaptiveBroadPhase::kManyAgents + 200;
  const auto step = [&](std::uint32_t agents) {
    const auto i = static_cast<std::uint32_t>(random.Below(agents));
    const auto other = static_cast<std::uint32_t>(random.Below(agents));
    const intersection::PairRule rule = DrawRule(&random);
    const motion::SpaceTimeBound bound = BoundIn(60, 0.5, 5, 1, &random);
    const HalfSpace half_space{random.UnitVector(), random.Uniform(-60, -50)};
    const double kind = random.Uniform(0, 1);
    both([&](SweepingIndex* method) {
      if (kind < 0.01) method->SetHalfSpace(i, half_space);
      if (kind > 0.02 && kind < 0.05) method->Remove(other);
      if (kind > 0.4) method->Set(i, bound);
      if (i == other) return;
      if (rule.excluded) {
        method->Exclude(i, other);
      } else {
        method->SetMargin(i, other, rule.margin);
      }
    });
    const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                         numeric::AddRoundedUp(kMethodStart, 2)};
    ASSERT_EQ(Text(chosen.EarliestOf(i, query)), Text(plain.EarliestOf(i, query)));
    ASSERT_EQ(chosen.rules().size(), plain.rules().size());
  };
  for (std::uint32_t agent = 0; agent < most; ++agent) {
    const motion::SpaceTimeBound bound = BoundIn(60, 0.5, 5, 1, &random);
    both([&](SweepingIndex* method) { method->Set(agent, bound); });
    step(agent + 1);
    ASSERT_FALSE(HasFatalFailure()) << agent;
  }
  for (int i = 0; i < 300; ++i) step(most);
  ASSERT_FALSE(HasFatalFailure());
  for (std::uint32_t agent = most; agent-- > 100;) {
    both([&](SweepingIndex* method) { method->Remove(agent); });
    if (agent % 8 == 0) step(agent);
    ASSERT_FALSE(HasFatalFailure()) << agent;
  }
  // The other method is filled a few agents a call.
  for (int i = 0; i < 400; ++i) step(100);
  EXPECT_EQ(chosen.method(), BroadPhaseMethod::kAllPairs);
  EXPECT_GE(chosen.changes(), 2u);
}

// Goal:   what changes while the next method is filled counts after the change: rules of agents
//         that are in it already, half-spaces of indices that are not yet.
// Method: four agents far from all others, which only rules make meet or not, and half-spaces in
//         which all agents lie; the next method is being filled when 139 agents are there.
TEST(AdaptiveBroadPhaseWithRules, WhatChangesDuringTheFillingCounts) {
  AdaptiveBroadPhase chosen;
  Random random(5);
  for (std::uint32_t agent = 0; agent < 4; ++agent) {
    motion::SpaceTimeBound bound = BoundIn(0, 0.5, 0.01, 0, &random);
    bound.state.p_WA = {1e4, agent < 2 ? 0.0 : 1e4, agent % 2 * 2.0};
    chosen.Set(agent, bound);
  }
  chosen.SetMargin(0, 1, 3);
  std::uint32_t next = 4;
  const auto grow_to = [&](std::uint32_t end) {
    for (; next < end; ++next) {
      if (next < 100 || next > 102) chosen.Set(next, BoundIn(100, 0.01, 0.01, 0, &random));
    }
  };
  const HalfSpace everywhere{{0, 0, 1}, 1e6};
  ASSERT_TRUE(chosen.SetHalfSpace(100, everywhere));
  ASSERT_TRUE(chosen.SetHalfSpace(101, everywhere));
  grow_to(142);
  ASSERT_EQ(chosen.method(), BroadPhaseMethod::kAllPairs);
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                       numeric::AddRoundedUp(kMethodStart, 1)};
  EXPECT_EQ(Text(chosen.EarliestOf(3, query)).substr(0, 7), "3 x 100");
  chosen.Remove(100);
  chosen.Set(101, BoundIn(100, 0.01, 0.01, 0, &random));
  chosen.Remove(101);
  EXPECT_EQ(Text(chosen.EarliestOf(0, query)).substr(0, 5), "0 x 1");
  chosen.Exclude(0, 1);
  chosen.SetMargin(2, 3, 3);
  grow_to(AdaptiveBroadPhase::kManyAgents + 100);
  ASSERT_EQ(chosen.method(), BroadPhaseMethod::kSpatialIndex);
  EXPECT_EQ(Text(chosen.EarliestOf(0, query)), "none");
  EXPECT_EQ(Text(chosen.EarliestOf(3, query)).substr(0, 5), "2 x 3");
}

// Goal:   rules that are shared from outside count for every method, before and after they change.
// Method: two agents that meet at 8 s, at 5 s with a margin of 3 m, and never once excluded.
TEST(SharedRules, CountForEveryMethod) {
  const auto check = [](auto make, const char* name) {
    const auto rules = std::make_shared<intersection::PairRules>();
    const auto method = make(rules);
    AgentBound bound;
    bound.bound.state.stamp = kMethodStart;
    bound.bound.limits.radius = 1;
    bound.bound.state.v_WA = {1, 0, 0};
    method->Set(0, bound);
    bound.bound.state.p_WA = {10, 0, 0};
    bound.bound.state.v_WA = {0, 0, 0};
    bound.bound.limits.acceleration_max = 1e-12;
    method->Set(1, bound);
    const intersection::BroadQuery query{intersection::BoundKind::kHorn, kMethodStart,
                                         numeric::AddRoundedUp(kMethodStart, 100)};
    const auto change = [&](intersection::PairRule rule) {
      EXPECT_TRUE(rules->Set(0, 1, rule));
      method->UpdateRules(0);
      method->UpdateRules(1);
    };
    ASSERT_TRUE(method->Earliest(query)) << name;
    EXPECT_NEAR(method->Earliest(query)->time.seconds, 8, 1e-6) << name;
    change({.margin = 3});
    ASSERT_TRUE(method->Earliest(query)) << name;
    EXPECT_NEAR(method->Earliest(query)->time.seconds, 5, 1e-6) << name;
    change({.excluded = true});
    EXPECT_FALSE(method->Earliest(query)) << name;
  };
  using Rules = std::shared_ptr<intersection::PairRules>;
  check([](Rules rules) { return std::make_unique<AllPairs>(rules); }, "all pairs");
  check([](Rules rules) { return std::make_unique<SpatialIndex>(rules); }, "spatial index");
  check([](Rules rules) { return std::make_unique<ExhaustiveIndex>(rules); }, "exhaustive");
  check([](Rules rules) { return std::make_unique<FaceSweep>(rules); }, "face sweep");
  for (const BroadPhaseMethod kind :
       {BroadPhaseMethod::kAuto, BroadPhaseMethod::kSpatialIndex, BroadPhaseMethod::kExhaustive}) {
    check([kind](Rules rules) { return std::make_unique<AdaptiveBroadPhase>(kind, rules); },
          Name(kind));
  }
  EXPECT_THROW(AllPairs(nullptr), CheckFailure);
}

}  // namespace
}  // namespace collision::broad_phase
