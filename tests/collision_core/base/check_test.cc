#include "collision_core/base/check.h"

#include <gtest/gtest.h>

#include <string>

namespace collision {
namespace {

// Goal:   a broken invariant says what, where and with which values, in every build type.
// Method: one check that fails, without and with values.
TEST(CoreCheck, TellsConditionPlaceAndValues) {
  const int index = 7, size = 5;
  try {
    CORE_CHECK(index < size, "an index lies within its table", index, size);
    FAIL() << "the check let it pass";
  } catch (const CheckFailure& failure) {
    const std::string text = failure.what();
    EXPECT_EQ(text.rfind("tests/collision_core/base/check_test.cc:", 0), 0u) << text;
    EXPECT_NE(text.find("an index lies within its table"), std::string::npos) << text;
    EXPECT_NE(text.find("(check failed: index < size; 7; 5)"), std::string::npos) << text;
  }
  EXPECT_THROW(CORE_CHECK(false, "never"), CheckFailure);
}

// Goal:   a check that holds costs nothing but its condition: no value is evaluated.
TEST(CoreCheck, EvaluatesTheConditionOnceAndTheValuesNever) {
  int conditions = 0, values = 0;
  CORE_CHECK(++conditions == 1, "evaluated once", ++values);
  EXPECT_EQ(conditions, 1);
  EXPECT_EQ(values, 0);
}

}  // namespace
}  // namespace collision
