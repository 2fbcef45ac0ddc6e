// Goal:   a stated precondition that does not hold throws.
// Method: the canonical routine is asked with margins that are none.
#include <gtest/gtest.h>

#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/intersection/earliest_intersection.h"

namespace collision::intersection {
namespace {

TEST(IntersectionPreconditions, AMarginIsFiniteAndNotBelowZero) {
  const motion::SpaceTimeBound a, b;
  for (const double margin : {-1.0, numeric::kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(EarliestIntersection(a, b, Instant(), Instant::Never(), margin), CheckFailure);
  }
}

}  // namespace
}  // namespace collision::intersection
