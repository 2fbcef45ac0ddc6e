// Goal:   a stated precondition that does not hold throws.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/narrow_phase/convex_pair/convex_search.h"
#include "collision_core/narrow_phase/separation/refinement.h"
#include "collision_core/narrow_phase/separation/separation_frontier.h"

namespace collision::narrow_phase {
namespace {

TEST(NarrowPhasePreconditions, ASearchBeginsWithAFreshBracket) {
  const geometry::ConvexSet a = geometry::BallSet({0, 0, 0}, 1);
  const geometry::ConvexSet b = geometry::BallSet({3, 0, 0}, 1);
  const ConvexQuery query;
  WorkBudget work(1000);
  ConvexBracket bracket(a, b);
  EXPECT_NO_THROW(ConvexSearch(query, &bracket, &work));
  bracket.TryDirection({1, 0, 0});
  EXPECT_THROW(ConvexSearch(query, &bracket, &work), CheckFailure);
}

TEST(NarrowPhasePreconditions, ASpanOfTimeDoesNotEndBeforeItBegins) {
  KnownMotion motion;
  motion.last.emplace();
  motion.last->state.stamp = Instant::FromNanoseconds(0);
  const TimeSpan span{Instant::FromNanoseconds(2), Instant::FromNanoseconds(1)};
  WorkBudget work(1000);
  EXPECT_THROW(TimeOfContact(motion, motion, span, {}, &work), CheckFailure);
}

TEST(NarrowPhasePreconditions, AnEmptyFrontierHasNoNextPair) {
  const Frontier frontier(FrontierOrder::kNewestFirst);
  EXPECT_THROW(frontier.next(), CheckFailure);
}

TEST(NarrowPhasePreconditions, ARefinementKnowsOnlyPairsThatWereAdded) {
  Refinement refinement(RefinementOrder::kLargestFirst);
  EXPECT_THROW(refinement.At(0), CheckFailure);
  EXPECT_THROW(refinement.Result(0), CheckFailure);
}

}  // namespace
}  // namespace collision::narrow_phase
