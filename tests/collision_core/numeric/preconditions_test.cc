// Goal:   a stated precondition that does not hold throws.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/numeric/cubic.h"
#include "collision_core/numeric/rotation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::numeric {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(NumericPreconditions, AQuaternionIsFiniteAndNotZero) {
  EXPECT_THROW(UnitQuaternion({0, 0, 0, 0}), CheckFailure);
  EXPECT_THROW(UnitQuaternion({1, kNan, 0, 0}), CheckFailure);
  EXPECT_THROW(UnitQuaternion({kInfinity, 0, 0, 0}), CheckFailure);
  EXPECT_NO_THROW(UnitQuaternion({1e-100, 0, 0, 0}));
}

TEST(NumericPreconditions, ATimeIsANumberAndAGapDoesNotCloseEverSlower) {
  EXPECT_THROW(AddRoundedDown(Instant(), kNan), CheckFailure);
  EXPECT_THROW(FirstZero(1, 1, -1), CheckFailure);
}

}  // namespace
}  // namespace collision::numeric
