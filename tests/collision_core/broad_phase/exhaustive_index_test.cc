// Goal:   the reference of the methods gives what the canonical routine gives for each partner.
// Method: random scenes, against EarliestIntersectionOf() of each pair; sets of none and one.
#include "collision_core/broad_phase/index/exhaustive_index.h"

#include <gtest/gtest.h>

#include "tests/collision_core/broad_phase/face_sweep_scenes.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = kSanitized ? 10 : 100;

TEST(ExhaustiveIndex, AnswersAboutOneAgentAreTheCanonicalRoutines) {
  Random random(10);
  for (int i = 0; i < kScenes; ++i) {
    const SweepScene scene =
        RandomScene(SweepLayout::kUniform, intersection::BoundKind::kHorn, 30, &random);
    ExhaustiveIndex index;
    for (std::uint32_t a = 0; a < scene.agents.size(); ++a) index.Set(a, scene.agents[a]);
    std::optional<intersection::IntersectingPair> expected;
    for (std::uint32_t partner = 1; partner < scene.agents.size(); ++partner) {
      const intersection::IntersectingPair meeting{
          0, partner, EarliestIntersectionOf(scene.query, scene.agents[0], scene.agents[partner])};
      if (meeting.time.instant().is_never()) continue;
      if (!expected || meeting < *expected) expected = meeting;
    }
    const auto found = index.EarliestOf(0, scene.query);
    ASSERT_EQ(expected.has_value(), found.has_value());
    if (expected) {
      EXPECT_EQ(expected->higher, found->higher);
      EXPECT_EQ(expected->time.seconds, found->time.seconds);
    }
    std::vector<Neighbour> neighbours;
    index.FindNeighbours(
        0, {scene.query.from, scene.query.until, Instant::Never()},
        [](std::uint32_t partner) { return partner == 3; }, &neighbours);
    for (const Neighbour& neighbour : neighbours) EXPECT_NE(3u, neighbour.partner);
    EXPECT_TRUE(!expected || expected->higher == 3 || !neighbours.empty());
  }
}

TEST(ExhaustiveIndex, AnAgentAloneMeetsNone) {
  ExhaustiveIndex index;
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, Instant(), Instant::Never()};
  EXPECT_FALSE(index.Earliest(query));
  motion::SpaceTimeBound bound;
  bound.limits.radius = 1;
  index.Set(5, bound);
  EXPECT_FALSE(index.Earliest(query));
  EXPECT_FALSE(index.EarliestOf(5, query));
}

}  // namespace
}  // namespace collision::broad_phase
