// Goal:   a stated precondition that does not hold throws.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/face_sweep/alpha_t_faces.h"
#include "collision_core/broad_phase/face_sweep/crossing_order.h"
#include "collision_core/broad_phase/index/earliest_pair_sink.h"

namespace collision::broad_phase {
namespace {

Instant At(std::int64_t seconds) { return Instant::FromNanoseconds(seconds * 1'000'000'000); }

TEST(BroadPhasePreconditions, FacesAreThoseOfAWindowThatReachesTheStamp) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = At(2);
  EXPECT_TRUE(FaceLinesOf(bound, At(1), At(3)));
  EXPECT_THROW(FaceLinesOf(bound, At(0), At(1)), CheckFailure);
  EXPECT_THROW(FaceLinesOf(bound, At(4), At(3)), CheckFailure);
}

TEST(BroadPhasePreconditions, OnlyFacesThatChangePlacesCross) {
  AlphaTFace below{}, above{};
  below.start = 0, below.end = 2;
  above.start = above.end = 1;
  EXPECT_GT(CrossingTick(below, above), 0u);
  EXPECT_THROW(CrossingTick(above, below), CheckFailure) << "it is above at the start";
  below.end = 1;
  EXPECT_THROW(CrossingTick(below, above), CheckFailure) << "they only touch";
}

TEST(BroadPhasePreconditions, AnExcludedPairHasNoTime) {
  intersection::PairRules rules;
  ASSERT_TRUE(rules.Set(0, 1, {.excluded = true}));
  HornTable table;
  table.UseRules(&rules);
  AgentBound bound;
  bound.bound.limits.radius = 1;
  for (const std::uint32_t agent : {0u, 1u, 2u}) table.Set(agent, bound);
  intersection::BroadQuery query;
  EXPECT_THROW(EarliestIntersectionOf(query, table, 0, 1), CheckFailure);
  EXPECT_NO_THROW(EarliestIntersectionOf(query, table, 0, 2));
}

}  // namespace
}  // namespace collision::broad_phase
