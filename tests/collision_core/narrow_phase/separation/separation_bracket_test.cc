// Goal:   a bracket is evidence of contact or of a gap for all displacements up to the given one,
//         and for none beyond.
// Method: margins that are powers of two, displaced by exactly as much and by one bit more.
#include "collision_core/narrow_phase/separation/separation_bracket.h"

#include <gtest/gtest.h>

#include <cmath>

namespace collision::narrow_phase {
namespace {

double JustAbove(double x) { return std::nextafter(x, numeric::kInfinity); }

TEST(SeparationBracket, WithoutAnythingKnownNothingIsCertain) {
  const SeparationBracket bracket;
  EXPECT_FALSE(bracket.CertainlyApart(0));
  EXPECT_FALSE(bracket.CertainlyTouching(0));
}

TEST(SeparationBracket, AGapLastsUntilItIsUsedUp) {
  SeparationBracket bracket;
  bracket.lower = 0.25;
  EXPECT_TRUE(bracket.CertainlyApart(0.125));
  EXPECT_FALSE(bracket.CertainlyApart(0.25)) << "they may touch";
}

TEST(SeparationBracket, AnOverlapLastsUntilItIsUsedUp) {
  SeparationBracket bracket;
  bracket.upper = -0.25;
  EXPECT_TRUE(bracket.CertainlyOverlapping(0.25));
  EXPECT_TRUE(bracket.CertainlyTouching(0.25));
  EXPECT_FALSE(bracket.CertainlyTouching(JustAbove(0.25)));
  EXPECT_FALSE(bracket.CertainlyCrossing(0));
}

TEST(SeparationBracket, ACrossingLastsForTwiceItsMargin) {
  SeparationBracket bracket;
  bracket.crossing_margin = 0.25;
  EXPECT_TRUE(bracket.CertainlyCrossing(0.5));
  EXPECT_TRUE(bracket.CertainlyTouching(0.5));
  EXPECT_FALSE(bracket.CertainlyTouching(JustAbove(0.5)));
  EXPECT_FALSE(bracket.CertainlyOverlapping(0));
}

}  // namespace
}  // namespace collision::narrow_phase
