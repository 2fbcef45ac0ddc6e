// Goal:   each kind of fact narrows the bracket of two convex sets, and no fact makes it wrong.
// Method: cubes and balls whose distance, depth and normal are known.
#include "collision_core/narrow_phase/convex_pair/convex_bracket.h"

#include <gtest/gtest.h>

#include <numbers>

#include "collision_core/narrow_phase/convex_pair/convex_search.h"
#include "tests/support/random.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// convex_distance.h: 64 · 2^-53 of the size of a pair, which is below 12 m here.
constexpr double kTight = 64 * 0x1p-53 * 12;

/// The cube of half edges 1.
geometry::ConvexSet CubeAt(const Vector3d& centre) {
  geometry::ConvexSet cube;
  cube.core = geometry::ConvexCore::kBox;
  cube.generators = Eigen::Matrix3d::Identity();
  cube.centre = centre;
  cube.span = 3;
  return cube;
}

TEST(ConvexBracket, KnowsNothingAtFirst) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 0, 0});
  const ConvexBracket bracket(a, b);
  EXPECT_EQ(bracket.separation_lower(), -numeric::kInfinity);
  EXPECT_EQ(bracket.separation_upper(), numeric::kInfinity);
  EXPECT_EQ(bracket.NormalError(), std::numbers::pi);
  EXPECT_FALSE(bracket.IsGoodEnough({.goal = ConvexGoal::kYesNo}));
}

TEST(ConvexBracket, NoDirectionMakesTheLowerBoundExceedTheDistance) {
  Random random(1);
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 1, 0});
  ConvexBracket bracket(a, b);
  for (int i = 0; i < 1000; ++i) {
    const double before = bracket.lower();
    bracket.TryDirection(random.Uniform(1e-9, 1e9) * random.UnitVector());
    EXPECT_LE(bracket.separation_lower(), 3);
    EXPECT_GE(bracket.lower(), before);
  }
  bracket.TryDirection({1e-3, 0, 0});
  EXPECT_LE(bracket.separation_lower(), 3);
  EXPECT_GE(bracket.separation_lower(), 3 - kTight);
  EXPECT_EQ(bracket.normal(), Vector3d::UnitX());
  bracket.TryDirection({1, 1, 0});  // A lesser gap.
  EXPECT_EQ(bracket.normal(), Vector3d::UnitX());
}

TEST(ConvexBracket, ADirectionOfNoLengthSaysNothing) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 0, 0});
  ConvexBracket bracket(a, b);
  bracket.TryDirection(Vector3d::Zero());
  EXPECT_EQ(bracket.lower(), -numeric::kInfinity);
}

TEST(ConvexBracket, TheShortestWayIsTheUpperBound) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 0, 0});
  ConvexBracket bracket(a, b);
  bracket.TakeWay({4, 0, 0});
  bracket.TakeWay({3, 0, 0});
  bracket.TakeWay({3, 1, 0});
  EXPECT_GE(bracket.separation_upper(), 3);
  EXPECT_LE(bracket.separation_upper(), 3 + kTight);
  bracket.TryDirection({1, 0, 0});
  EXPECT_LT(bracket.NormalError(), 1e-6);
  EXPECT_TRUE(bracket.IsGoodEnough({}));
}

TEST(ConvexBracket, ABallInTheDifferenceIsDepth) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({1.5, 0, 0});
  ConvexBracket bracket(a, b);
  bracket.TakeBallInside(-1);
  EXPECT_EQ(bracket.separation_upper(), numeric::kInfinity);
  bracket.TakeBallInside(0.5);
  bracket.TakeBallInside(0.25);
  EXPECT_EQ(bracket.separation_upper(), -0.5);
  bracket.TryDirection({1, 0, 0});
  EXPECT_LE(bracket.separation_lower(), -0.5);
  EXPECT_GE(bracket.separation_lower(), -0.5 - kTight);
  EXPECT_EQ(bracket.NormalError(), std::numbers::pi);
}

TEST(ConvexBracket, RadiiShiftItAndErrorsWidenIt) {
  geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 0, 0});
  a.rounding = 0.25, b.rounding = 0.5, a.error = 0.125, b.error = 0.0625;
  ConvexBracket bracket(a, b);
  bracket.TryDirection({1, 0, 0});
  bracket.TakeWay({3, 0, 0});
  EXPECT_EQ(bracket.rounding(), 0.75);
  EXPECT_NEAR(bracket.separation_lower(), 3 - 0.75 - 0.1875, kTight);
  EXPECT_NEAR(bracket.separation_upper(), 3 - 0.75 + 0.1875, kTight);
  EXPECT_LE(bracket.separation_lower(), 3 - 0.75 - 0.1875);
  EXPECT_GE(bracket.separation_upper(), 3 - 0.75 + 0.1875);
}

TEST(ConvexBracket, IsGoodEnoughAtTheTolerancesOfTheQuery) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 0, 0});
  ConvexBracket bracket(a, b);
  bracket.TryDirection({1, 0, 0});
  bracket.TakeWay({3.3, 0, 0});
  EXPECT_TRUE(bracket.IsGoodEnough({.goal = ConvexGoal::kYesNo}));
  EXPECT_FALSE(bracket.IsGoodEnough({.goal = ConvexGoal::kDistance}));
  EXPECT_TRUE(bracket.IsGoodEnough({.absolute_tolerance = 0.31}));
  EXPECT_FALSE(bracket.IsGoodEnough({.absolute_tolerance = 0.29}));
  EXPECT_TRUE(bracket.IsGoodEnough({.relative_tolerance = 0.11}));
  EXPECT_FALSE(bracket.IsGoodEnough({.relative_tolerance = 0.09}));
}

TEST(ConvexSearch, AnswersYesOrNoOfBoxesByTheirFacesAlone) {
  for (const double x : {1.5, 5.0}) {
    const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({x, 0.25, 0});
    ConvexBracket bracket(a, b);
    const ConvexQuery query{.goal = ConvexGoal::kYesNo};
    WorkBudget work(100);
    geometry::GjkHint hint;
    ConvexSearch search(query, &bracket, &work);
    search.Run(&hint);
    EXPECT_EQ(work.left(), 100 - kBoxAxesUnits);
    EXPECT_EQ(x > 2, bracket.separation_lower() > 0);
    EXPECT_EQ(x < 2, bracket.separation_upper() <= 0);
    EXPECT_EQ(hint.count, 0);
    EXPECT_FALSE(search.exhausted());
  }
}

TEST(ConvexSearch, ContainsTheDistanceHoweverLittleWorkIsAllowed) {
  const geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({5, 1, 0});
  const ConvexQuery query;
  for (const std::uint64_t units : {0, 1, 2, 100}) {
    ConvexBracket bracket(a, b);
    WorkBudget work(units);
    ConvexSearch search(query, &bracket, &work);
    search.Run(nullptr);
    EXPECT_LE(bracket.separation_lower(), 3);
    EXPECT_GE(bracket.separation_upper(), 3);
    if (units == 100) {
      EXPECT_LE(bracket.separation_upper() - bracket.separation_lower(), kTightestWidth * 12);
    }
  }
}

TEST(ConvexSearch, SaysThatALimitEndedIt) {
  geometry::ConvexSet a = CubeAt({0, 0, 0}), b = CubeAt({0.5, 0.25, 0.125});
  a.core = b.core = geometry::ConvexCore::kEllipsoid;
  b.generators.diagonal() = Vector3d(0.25, 1, 0.5);
  const ConvexQuery query{.relative_tolerance = 1e-2};
  for (const std::uint64_t units : {1, 1000}) {
    ConvexBracket bracket(a, b);
    WorkBudget work(units);
    ConvexSearch search(query, &bracket, &work);
    search.Run(nullptr);
    EXPECT_EQ(search.exhausted(), units == 1);
    EXPECT_LE(bracket.separation_lower(), bracket.separation_upper());
  }
}

}  // namespace
}  // namespace collision::narrow_phase
