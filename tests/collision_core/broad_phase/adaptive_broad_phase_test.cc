// Goal:   the method follows the scene by counted work, with hysteresis, without a pause, and never
//         shows in an answer.
// Method: scenes that grow, shrink, sway and change, compared with all pairs.
#include "collision_core/broad_phase/adaptive_broad_phase.h"

#include <gtest/gtest.h>

#include <vector>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "tests/support/random.h"

namespace collision::broad_phase {
namespace {

/// The same agents in the chosen method and in all pairs.
class Scene {
 public:
  explicit Scene(std::uint64_t seed, BroadPhaseMethod method = BroadPhaseMethod::kAuto)
      : chosen(method), random_(seed) {}

  std::uint32_t agents() const { return agents_; }

  void Resize(std::uint32_t agents) {
    while (agents_ < agents) {
      const motion::SpaceTimeBound bound = Bound();
      bounds_.resize(std::max<std::size_t>(bounds_.size(), agents_ + 1));
      bounds_[agents_] = bound;
      chosen.Set(agents_, bound);
      plain.Set(agents_++, bound);
    }
    while (agents_ > agents) {
      chosen.Remove(--agents_);
      plain.Remove(agents_);
    }
  }

  /// Sets a state in the middle of the bound, or elsewhere; then queries one agent.
  void Step() {
    ++now_;
    const auto agent = static_cast<std::uint32_t>(random_.Below(agents_));
    motion::SpaceTimeBound& bound = bounds_[agent];
    if (random_.Chance(0.1)) {
      bound = Bound();
      chosen.Set(agent, bound);
      plain.Set(agent, bound);
    } else {
      const auto age_ns = static_cast<double>(now_ - bound.state.stamp.nanoseconds());
      bound.state.p_WA += bound.state.v_WA * (1e-9 * age_ns);
      bound.state.stamp = Instant::FromNanoseconds(now_);
      chosen.Set(agent, bound);
      plain.Set(agent, bound);
    }
    const intersection::BroadQuery query{.from = Instant::FromNanoseconds(now_),
                                         .until = Instant::Never()};
    Expect(chosen.EarliestOf(agent, query), plain.EarliestOf(agent, query));
  }

  void ExpectSameEarliest() {
    const intersection::BroadQuery query{.from = Instant::FromNanoseconds(now_),
                                         .until = Instant::Never()};
    Expect(chosen.Earliest(query), plain.Earliest(query));
  }

  AdaptiveBroadPhase chosen;
  AllPairs plain;

 private:
  motion::SpaceTimeBound Bound() {
    motion::SpaceTimeBound bound;
    bound.state.stamp = Instant::FromNanoseconds(now_);
    bound.state.p_WA = {random_.Uniform(0, 1000), random_.Uniform(0, 1000),
                        random_.Uniform(0, 1000)};
    bound.state.v_WA = random_.UnitVector() * random_.Uniform(0, 5);
    bound.limits.radius = 0.5;
    bound.limits.acceleration_max = 1;
    return bound;
  }

  static void Expect(const std::optional<intersection::IntersectingPair>& found,
                     const std::optional<intersection::IntersectingPair>& plain) {
    ASSERT_EQ(found.has_value(), plain.has_value());
    if (!found) return;
    EXPECT_EQ(found->lower, plain->lower);
    EXPECT_EQ(found->higher, plain->higher);
    EXPECT_EQ(found->time.base, plain->time.base);
    EXPECT_EQ(found->time.seconds, plain->time.seconds);
  }

  Random random_;
  std::vector<motion::SpaceTimeBound> bounds_;
  std::uint32_t agents_ = 0;
  std::int64_t now_ = 0;
};

TEST(AdaptiveBroadPhase, FollowsTheNumberOfAgents) {
  Scene scene(1);
  EXPECT_EQ(scene.chosen.method(), BroadPhaseMethod::kAllPairs);
  scene.Resize(100);
  for (int i = 0; i < 500; ++i) scene.Step();
  EXPECT_EQ(scene.chosen.method(), BroadPhaseMethod::kAllPairs);
  EXPECT_EQ(scene.chosen.why(), "100 agents: up to 128 it costs least");
  scene.Resize(AdaptiveBroadPhase::kManyAgents + 1);
  EXPECT_EQ(scene.chosen.method(), BroadPhaseMethod::kSpatialIndex);
  EXPECT_EQ(scene.chosen.why(), "769 agents: beyond 128 it costs least, as a rule");
  for (int i = 0; i < 100; ++i) scene.Step();
  scene.ExpectSameEarliest();
  scene.Resize(50);
  for (int i = 0; i < 100; ++i) scene.Step();
  EXPECT_EQ(scene.chosen.method(), BroadPhaseMethod::kAllPairs);
  scene.ExpectSameEarliest();
  EXPECT_EQ(scene.chosen.changes(), 2u);
}

// Between the limits the counts decide, and it does not sway.
TEST(AdaptiveBroadPhase, DecidesByCountedWorkAndKeepsToIt) {
  Scene scene(2);
  scene.Resize(500);
  for (int i = 0; i < 20000; ++i) scene.Step();
  EXPECT_LE(scene.chosen.changes(), 7u) << "1, and 2 with each try";
  EXPECT_NE(scene.chosen.why().find(" units of work a query with 500, "), std::string::npos)
      << scene.chosen.why();
  scene.ExpectSameEarliest();
}

TEST(AdaptiveBroadPhase, SwayingAboutALimitDoesNotChangeIt) {
  Scene scene(3);
  for (int round = 0; round < 30; ++round) {
    scene.Resize(AdaptiveBroadPhase::kManyAgents - 40);
    for (int i = 0; i < 20; ++i) scene.Step();
    scene.Resize(AdaptiveBroadPhase::kManyAgents + 40);
    for (int i = 0; i < 20; ++i) scene.Step();
  }
  EXPECT_EQ(scene.chosen.changes(), 1u);
}

// A change of method is spread over many calls: each queries and fills only a little.
TEST(AdaptiveBroadPhase, NoCallTakesAllTheWork) {
  Scene scene(4);
  scene.Resize(600);
  std::uint64_t before = scene.chosen.work().filter_tests, most = 0;
  for (int i = 0; i < 3000; ++i) {
    scene.Step();
    const std::uint64_t after = scene.chosen.work().filter_tests;
    most = std::max(most, after - before);
    before = after;
  }
  EXPECT_GT(scene.chosen.work().rebuilds, 0u);
  EXPECT_LT(most, 20u * 600) << "all pairs would be 180,000";
}

TEST(AdaptiveBroadPhase, WhatIsAskedForIsTaken) {
  for (const BroadPhaseMethod method : {BroadPhaseMethod::kAllPairs, BroadPhaseMethod::kExhaustive,
                                        BroadPhaseMethod::kSpatialIndex}) {
    Scene scene(5, method);
    for (const std::uint32_t agents : {10, 700, 5}) {
      scene.Resize(agents);
      for (int i = 0; i < 100; ++i) scene.Step();
      scene.ExpectSameEarliest();
      EXPECT_EQ(scene.chosen.method(), method);
    }
    EXPECT_EQ(scene.chosen.why(), "5 agents; the configuration asks for it");
    EXPECT_EQ(scene.chosen.changes(), 0u);
  }
}

}  // namespace
}  // namespace collision::broad_phase
