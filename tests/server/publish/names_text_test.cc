// Goal:   a text names as many simulators as fit, whole, and says how many it leaves out.
// Method: lists at and around the bound.
#include "server/publish/text/names_text.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

TEST(NamesText, AllThatFitAreNamed) {
  EXPECT_EQ(NamesText({}, 10), "");
  EXPECT_EQ(NamesText({"a"}, 10), "a");
  EXPECT_EQ(NamesText({"a", "b", "cd"}, 8), "a, b, cd");
}

TEST(NamesText, WhatDoesNotFitIsCounted) {
  EXPECT_EQ(NamesText({"alpha", "beta", "gamma"}, 15), "alpha, +2 more");
  EXPECT_EQ(NamesText({"alpha", "beta", "gamma"}, 10), "+3 more");
}

TEST(NamesText, NeverExceedsItsBoundAndNeverCutsAName) {
  const std::vector<std::string> names(1000, std::string(64, 'x'));
  for (std::size_t bound = 0; bound < 600; ++bound) {
    const std::string text = NamesText(names, bound);
    ASSERT_LE(text.size(), bound);
    const std::size_t full = text.rfind('x');
    if (full == text.npos) continue;
    ASSERT_EQ((full + 1) % 66, 64u) << text;
  }
}

}  // namespace
}  // namespace collision::server
