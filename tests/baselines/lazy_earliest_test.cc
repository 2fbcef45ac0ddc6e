// Goal:   asking again only at the head of the queue gives, after every update, what asking
//         all agents from scratch gives.
// Method: balls fly under accelerations within their M and tell their states in random order; after
//         each, the queue's answer is compared with AllPairs::Earliest() from scratch.
#include "tests/baselines/lazy_earliest.h"

#include <gtest/gtest.h>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/numeric/seconds.h"
#include "tests/baselines/ball_bound.h"
#include "tests/baselines/scenes.h"
#include "tests/support/random.h"

namespace collision::baselines {
namespace {

constexpr double kLookAhead = 0.7;

class AllPairsAsker : public AgentAsker {
 public:
  std::optional<AgentMeeting> Ask(std::uint32_t agent, Instant from, Instant until) override {
    const auto meeting = phase.EarliestOf(agent, {intersection::BoundKind::kHorn, from, until});
    if (!meeting) return std::nullopt;
    return AgentMeeting{meeting->lower == agent ? meeting->higher : meeting->lower,
                        meeting->time.instant()};
  }

  broad_phase::AllPairs phase;
};

TEST(LazyEarliest, IsTheEarliestOfAllAgents) {
  int found_count = 0;
  std::uint64_t asked = 0, updates = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    UniformOptions options;
    options.count = 60, options.seed = seed, options.clear_until = 0.3;
    BallScene scene = UniformScene(options);
    AllPairsAsker asker;
    LazyEarliest lazy(scene.size(), kLookAhead, &asker);
    Random random(seed);
    std::vector<Eigen::Vector3d> acceleration;
    for (std::uint32_t i = 0; i < scene.size(); ++i) {
      asker.phase.Set(i, BoundOf(scene[i]));
      acceleration.push_back(random.UnitVector() * 0.9);
    }
    for (std::uint32_t i = 0; i < scene.size(); ++i) lazy.Ask(i, Instant());
    for (int step = 1; step <= 600; ++step, ++updates) {
      const double t = step * 0.0004;
      const auto agent = static_cast<std::uint32_t>(random.Below(scene.size()));
      BallAgent& state = scene[agent];
      const double since = t - state.stamp;
      state.p_WA += state.v_WA * since + 0.5 * since * since * acceleration[agent];
      state.v_WA += acceleration[agent] * since;
      state.stamp = t;
      const motion::SpaceTimeBound bound = BoundOf(state);
      asker.phase.Tighten(agent, bound);
      lazy.Renewed(agent);
      const Instant now = bound.state.stamp;
      const auto expected = asker.phase.Earliest(
          {intersection::BoundKind::kHorn, now, numeric::AddRoundedDown(now, kLookAhead)});
      const auto found = lazy.Earliest(now);
      ASSERT_EQ(found.has_value(), expected.has_value()) << step;
      if (!found) continue;
      ++found_count;
      EXPECT_EQ(std::min(found->agent, found->partner), expected->lower) << step;
      EXPECT_EQ(std::max(found->agent, found->partner), expected->higher) << step;
      // In a query from another instant, the same time may round to another nanosecond.
      EXPECT_NEAR(static_cast<double>(found->when.nanoseconds()),
                  static_cast<double>(expected->time.instant().nanoseconds()), 2)
          << step;
    }
    asked += lazy.asked() - scene.size();
  }
  EXPECT_GT(found_count, 1000);
  // Not idle: far from all others is asked again.
  EXPECT_LT(asked, updates);
  EXPECT_GT(asked, 0u);
}

}  // namespace
}  // namespace collision::baselines
