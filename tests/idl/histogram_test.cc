// Goal:   the classes of a histogram end at 1, 2, 5, 10, ..., each value is in the least class that
//         is not below it, and a quantile is never told too small, nor by more than a class.
#include "idl/histogram.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace collision::wire {
namespace {

TEST(Histogram, ClassesEndAtOneTwoFive) {
  const std::vector<std::uint64_t> first = {1, 2, 5, 10, 20, 50, 100};
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(ClassEnd(i), first[i]);
  EXPECT_EQ(ClassEnd(kHistogramCountsMax - 1), 5'000'000'000'000'000u);
}

TEST(Histogram, AValueIsInTheLeastClassThatIsNotBelowIt) {
  EXPECT_EQ(ClassOf(std::numeric_limits<std::int64_t>::min()), 0u);
  EXPECT_EQ(ClassOf(0), 0u);
  for (std::size_t i = 0; i + 1 < kHistogramCountsMax; ++i) {
    const auto end = static_cast<std::int64_t>(ClassEnd(i));
    EXPECT_EQ(ClassOf(end), i);
    EXPECT_EQ(ClassOf(end + 1), i + 1);
  }
  EXPECT_EQ(ClassOf(std::numeric_limits<std::int64_t>::max()), kHistogramCountsMax - 1u);
}

TEST(Histogram, AQuantileIsTheEndOfItsClass) {
  EXPECT_EQ(QuantileAtMost(std::vector<std::uint64_t>{}, 0.5), 0u);
  // 2 values up to 1, 5 up to 5, 3 up to 20.
  const std::vector<std::uint64_t> counts = {2, 0, 5, 0, 3};
  EXPECT_EQ(QuantileAtMost(counts, 0), 1u);
  EXPECT_EQ(QuantileAtMost(counts, 0.2), 1u);
  EXPECT_EQ(QuantileAtMost(counts, 0.21), 5u);
  EXPECT_EQ(QuantileAtMost(counts, 0.7), 5u);
  EXPECT_EQ(QuantileAtMost(counts, 0.71), 20u);
  EXPECT_EQ(QuantileAtMost(counts, 1), 20u);
}

}  // namespace
}  // namespace collision::wire
