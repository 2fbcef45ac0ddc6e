// Goal:   what is expected of a pair is what its states say if both keep their motion.
// Method: two balls, and two boxes, whose meeting or passing is known in closed form, with wide
//         bounds that must not matter.
#include "collision_core/detection/encounter/expectation.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"
#include "tests/support/solids.h"

namespace collision::detection {
namespace {

constexpr std::uint64_t kPlenty = 100000;

History Of(const motion::MotionState& state,
           const std::shared_ptr<const shape::Shape>& shape = nullptr) {
  motion::SpaceTimeBound bound;
  bound.state = state;
  bound.state.position_error = 0.5;
  bound.limits = {.radius = 1, .acceleration_max = 100, .jerk_max = 3};
  bound.skew = 0.01;
  if (shape) bound.limits.radius = shape->facts().radius;
  History history;
  history.Push({.bound = bound, .shape = shape}, 4);
  return history;
}

Expectation Expect(const History& a, const History& b, double from = 0, double ahead = 4) {
  WorkBudget work(kPlenty);
  const std::optional<Expectation> expected = ExpectationOf(a, b, At(from), ahead, &work);
  EXPECT_TRUE(expected);
  return expected.value_or(Expectation());
}

void ExpectBracket(const TimeBracket& bracket, double truth, double width) {
  EXPECT_LE(bracket.earliest, At(truth + 1e-9));
  EXPECT_GE(bracket.latest, At(truth - 1e-9));
  EXPECT_LE(bracket.latest.nanoseconds() - bracket.earliest.nanoseconds(), width * 1e9);
}

TEST(Expectation, SaysWhenTwoBallsTouch) {
  const Expectation expected =
      Expect(Of(State(0, {0, 0, 0}, {1, 0, 0})), Of(State(0, {7, 0, 0}, {-1, 0, 0})));
  EXPECT_EQ(expected.outcome, ExpectedOutcome::kTouch);
  ExpectBracket(expected.begin, 2.5, 1e-6);
  EXPECT_FALSE(expected.closest);
}

TEST(Expectation, CountsFromTheNewerOfTwoStates) {
  const Expectation expected =
      Expect(Of(State(1, {1, 0, 0}, {1, 0, 0})), Of(State(0.5, {6.5, 0, 0}, {-1, 0, 0})), 0.25);
  EXPECT_EQ(expected.outcome, ExpectedOutcome::kTouch);
  ExpectBracket(expected.begin, 2.5, 1e-6);
  EXPECT_EQ(expected.until, At(5));
}

// The known acceleration alone brings them together: 5 = 2 + ½ 2 t².
TEST(Expectation, KeepsTheAccelerationThatIsKnown) {
  motion::MotionState still = State(0, {0, 0, 0}, {0, 0, 0});
  still.a_WA = {2, 0, 0};
  const Expectation expected = Expect(Of(still), Of(State(0, {5, 0, 0}, {0, 0, 0})));
  EXPECT_EQ(expected.outcome, ExpectedOutcome::kTouch);
  ExpectBracket(expected.begin, std::sqrt(3), 1e-6);
}

TEST(Expectation, SaysHowNearTwoBallsPass) {
  const Expectation expected =
      Expect(Of(State(0, {0, 0, 0}, {1, 0, 0})), Of(State(0, {4, 3, 0}, {-1, 0, 0})));
  EXPECT_EQ(expected.outcome, ExpectedOutcome::kPass);
  EXPECT_TRUE(expected.begin.earliest.is_never());
  ASSERT_TRUE(expected.closest);
  ExpectBracket(expected.closest->at, 2, 0.04);
  EXPECT_LE(expected.closest->distance.lower, 1);
  EXPECT_GE(expected.closest->distance.upper, 1);
  EXPECT_LE(expected.closest->distance.width(), 1e-5);
}

TEST(Expectation, LooksNoFartherThanAsked) {
  const History a = Of(State(0, {0, 0, 0}, {1, 0, 0})), b = Of(State(0, {7, 0, 0}, {-1, 0, 0}));
  const Expectation expected = Expect(a, b, 0, 2);
  EXPECT_EQ(expected.outcome, ExpectedOutcome::kPass) << "they meet after 2.5 s";
  ASSERT_TRUE(expected.closest);
  ExpectBracket(expected.closest->at, 2, 0.04);
  EXPECT_NEAR(expected.closest->distance.upper, 1, 1e-5);
}

// Balls about the boxes touch; the boxes pass each other's corners 0.2 m apart, or meet.
TEST(Expectation, OfBoxesIsThatOfTheirFaces) {
  const auto box = shape::Shape::Compound(
      nullptr, {SolidBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5))});
  const History a = Of(State(0, {0, 0, 0}, {1, 0, 0}), box);
  const Expectation pass = Expect(a, Of(State(0, {5, 1.2, 0}, {-1, 0, 0}), box));
  EXPECT_EQ(pass.outcome, ExpectedOutcome::kPass);
  ASSERT_TRUE(pass.closest);
  EXPECT_LE(pass.closest->distance.lower, 0.2 + 1e-12);
  EXPECT_GE(pass.closest->distance.upper, 0.2 - 1e-12);
  EXPECT_LE(pass.closest->distance.width(), 0.02);
  const Expectation touch = Expect(a, Of(State(0, {5, 0.8, 0}, {-1, 0, 0}), box));
  EXPECT_EQ(touch.outcome, ExpectedOutcome::kTouch);
  ExpectBracket(touch.begin, 2, 2e-6);
}

TEST(Expectation, IsUndecidedWithoutWork) {
  const auto box = shape::Shape::Compound(
      nullptr, {SolidBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5))});
  WorkBudget none(0);
  const auto expected = ExpectationOf(Of(State(0, {0, 0, 0}, {1, 0, 0}), box),
                                      Of(State(0, {5, 0.8, 0}, {-1, 0, 0}), box), At(0), 4, &none);
  ASSERT_TRUE(expected);
  EXPECT_EQ(expected->outcome, ExpectedOutcome::kUndecided);
}

TEST(Expectation, NoneWhileAShapeIsAwaitedOrAnAgentHasExpired) {
  History awaited = Of(State(0, {0, 0, 0}, {1, 0, 0}));
  awaited.newest().shape_awaited = true;
  const History b = Of(State(0, {7, 0, 0}, {-1, 0, 0}));
  WorkBudget work(kPlenty);
  EXPECT_FALSE(ExpectationOf(awaited, b, At(0), 4, &work));
  motion::MotionState expires = State(0, {0, 0, 0}, {1, 0, 0});
  expires.expiry = At(1);
  EXPECT_FALSE(ExpectationOf(Of(expires), b, At(1), 4, &work));
  EXPECT_EQ(Expect(Of(expires), b).until, At(1));
}

}  // namespace
}  // namespace collision::detection
