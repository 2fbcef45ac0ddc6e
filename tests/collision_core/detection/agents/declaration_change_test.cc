// Goal:   what a new declaration allows more is in force at once, what it allows less from the next
//         state on; whether answers stay valid is told exactly: never a widening missed, and none
//         reported where nothing widens.
// Method: one agent with one state; declarations that differ in one respect at a time.
#include "collision_core/detection/agents/declaration_change.h"

#include <gtest/gtest.h>

#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

constexpr motion::MotionLimits kLimits{.radius = 4,
                                       .acceleration_max = 2,
                                       .time_step = 0.5,
                                       .speed_max = 10,
                                       .angular_acceleration_max = 1};

class DeclarationChangeTest : public testing::Test {
 protected:
  /// The declaration of the agent before the change, with its state under it.
  void Declare(const AgentDeclaration& declaration) {
    record_.declaration = declaration;
    record_.history.Clear();
    Store();
  }
  void Store() {
    const AgentDeclaration& declared = record_.declaration;
    record_.history.Push({.bound = {State(0, {0, 0, 0}, {1, 0, 0}), declared.limits, 0},
                          .filter = declared.filter,
                          .shape = declared.shape,
                          .shape_awaited = declared.shape_awaited},
                         8);
    record_.shape_redeclared = false;
  }

  /// The change from kLimits to `limits` of an agent with this shape.
  BoundChange ChangeTo(const motion::MotionLimits& limits,
                       const std::shared_ptr<const shape::Shape>& shape = nullptr) {
    Declare({.limits = kLimits, .shape = shape});
    return ApplyDeclaration({.limits = limits, .shape = shape}, &record_);
  }
  const motion::MotionLimits& InForce() const { return record_.bound().limits; }
  const History::Sample& newest() const { return record_.history.newest(); }

  const std::shared_ptr<const shape::Shape> cube_ = shape::Shape::Build(Cube(1));
  const std::shared_ptr<const shape::Shape> rod_ = shape::Shape::Build(Rod(2, 0.5));
  AgentRecord record_;
};

TEST_F(DeclarationChangeTest, TheSameDeclarationIsNoWidening) {
  EXPECT_EQ(ChangeTo(kLimits), BoundChange::kWithin);
  EXPECT_EQ(InForce(), kLimits);
  EXPECT_EQ(ChangeTo(kLimits, cube_), BoundChange::kWithin);
  EXPECT_EQ(newest().shape, cube_);
}

TEST_F(DeclarationChangeTest, EachWiderLimitIsAWideningThatIsInForceAtOnce) {
  for (double motion::MotionLimits::*const limit :
       {&motion::MotionLimits::radius, &motion::MotionLimits::acceleration_max,
        &motion::MotionLimits::time_step, &motion::MotionLimits::speed_max}) {
    motion::MotionLimits wider = kLimits;
    wider.*limit *= 2;
    EXPECT_EQ(ChangeTo(wider), BoundChange::kWidened);
    EXPECT_EQ(InForce(), wider);
    EXPECT_EQ(record_.declaration.limits, wider);
  }
}

TEST_F(DeclarationChangeTest, EachNarrowerLimitWaitsForTheNextState) {
  for (double motion::MotionLimits::*const limit :
       {&motion::MotionLimits::radius, &motion::MotionLimits::acceleration_max,
        &motion::MotionLimits::time_step, &motion::MotionLimits::speed_max,
        &motion::MotionLimits::angular_acceleration_max}) {
    motion::MotionLimits narrower = kLimits;
    narrower.*limit /= 2;
    EXPECT_EQ(ChangeTo(narrower), BoundChange::kWithin);
    EXPECT_EQ(InForce(), kLimits);
    EXPECT_EQ(record_.declaration.limits, narrower) << "the next state's";
  }
}

TEST_F(DeclarationChangeTest, OfAMixedChangeTheWiderOfEachLimitIsInForce) {
  motion::MotionLimits mixed = kLimits;
  mixed.radius = 8;
  mixed.acceleration_max = 1;
  EXPECT_EQ(ChangeTo(mixed), BoundChange::kWidened);
  EXPECT_EQ(InForce().radius, 8);
  EXPECT_EQ(InForce().acceleration_max, 2);
}

TEST_F(DeclarationChangeTest, AFasterTurnWidensABodyAndNoBall) {
  for (const double angular : {2.0, -1.0}) {  // −1: not declared, any turn is possible
    motion::MotionLimits faster = kLimits;
    faster.angular_acceleration_max = angular;
    EXPECT_EQ(ChangeTo(faster), BoundChange::kWithin);
    EXPECT_EQ(InForce().angular_acceleration_max, angular);
    EXPECT_EQ(ChangeTo(faster, cube_), BoundChange::kWidened);
    EXPECT_EQ(InForce().angular_acceleration_max, angular);
  }
}

TEST_F(DeclarationChangeTest, AFilterIsInForceAtOnceAndWidensIfItAddsAGroup) {
  const broad_phase::CollisionFilter before{.group = 3, .mask = 3};
  const auto change_to = [&](const broad_phase::CollisionFilter& filter) {
    Declare({.limits = kLimits, .filter = before});
    const BoundChange change = ApplyDeclaration({.limits = kLimits, .filter = filter}, &record_);
    EXPECT_EQ(newest().filter, filter);
    return change;
  };
  EXPECT_EQ(change_to({.group = 3, .mask = 3}), BoundChange::kWithin);
  EXPECT_EQ(change_to({.group = 1, .mask = 2}), BoundChange::kWithin);
  EXPECT_EQ(change_to({.group = 5, .mask = 3}), BoundChange::kWidened);
  EXPECT_EQ(change_to({.group = 3, .mask = 4}), BoundChange::kWidened);
}

TEST_F(DeclarationChangeTest, AShapeThatArrivesIsInForceFromTheStateThatAwaitedIt) {
  Declare({.limits = kLimits, .shape_awaited = true});
  EXPECT_EQ(ApplyDeclaration({.limits = kLimits, .shape = cube_}, &record_), BoundChange::kWithin)
      << "it was somewhere within the ball";
  EXPECT_EQ(newest().shape, cube_);
  EXPECT_FALSE(newest().shape_awaited);
}

TEST_F(DeclarationChangeTest, AnotherShapeIsAwaitedUntilTheNextState) {
  Declare({.limits = kLimits, .shape = cube_});
  EXPECT_EQ(ApplyDeclaration({.limits = kLimits, .shape = rod_}, &record_), BoundChange::kWidened);
  EXPECT_EQ(newest().shape, nullptr);
  EXPECT_TRUE(newest().shape_awaited);
  EXPECT_EQ(record_.declaration.shape, rod_);
  EXPECT_TRUE(record_.shape_redeclared);
  Store();
  EXPECT_EQ(newest().shape, rod_);
}

TEST_F(DeclarationChangeTest, ABodyThatBecomesItsBallIsAWideningAndABallThatGetsAShapeIsNot) {
  Declare({.limits = kLimits, .shape = cube_});
  EXPECT_EQ(ApplyDeclaration({.limits = kLimits}, &record_), BoundChange::kWidened);
  EXPECT_TRUE(newest().shape_awaited);
  Declare({.limits = kLimits});
  EXPECT_EQ(ApplyDeclaration({.limits = kLimits, .shape = cube_}, &record_), BoundChange::kWithin);
  EXPECT_TRUE(newest().shape_awaited) << "the ball was there before";
}

// The one that arrives may be another than the one that was awaited with the newest state.
TEST_F(DeclarationChangeTest, AShapeAwaitedAnewIsNotInForceBeforeTheNextState) {
  Declare({.limits = kLimits, .shape_awaited = true});
  ApplyDeclaration({.limits = kLimits, .shape_awaited = true}, &record_);
  EXPECT_TRUE(record_.shape_redeclared);
  ApplyDeclaration({.limits = kLimits, .shape = cube_}, &record_);
  EXPECT_EQ(newest().shape, nullptr);
  EXPECT_TRUE(newest().shape_awaited);
  Store();
  EXPECT_EQ(newest().shape, cube_);
}

TEST_F(DeclarationChangeTest, AnotherTreeOfTheSameBodyTakesThePlaceOfTheFormerOne) {
  const std::shared_ptr<const shape::Shape> other = shape::Shape::Build(Cube(1), {}, cube_.get());
  ASSERT_NE(other, cube_);
  ASSERT_TRUE(other->IsSameBodyAs(*cube_));
  Declare({.limits = kLimits, .shape = cube_});
  Store();
  EXPECT_EQ(ApplyDeclaration({.limits = kLimits, .shape = other}, &record_), BoundChange::kWithin);
  EXPECT_EQ(newest().shape, other);
  EXPECT_FALSE(newest().shape_awaited);
  EXPECT_FALSE(record_.shape_redeclared);
  EXPECT_EQ(record_.history.Uninterrupted(At(0))->shape, other) << "in the whole history";
}

TEST_F(DeclarationChangeTest, AnAwaitedShapeThatIsThereIsRefused) {
  Declare({.limits = kLimits});
  EXPECT_THROW(ApplyDeclaration({.shape = cube_, .shape_awaited = true}, &record_), CheckFailure);
}

TEST(DeclarationChange, LimitsAreNarrowerIfOneOfThoseThatKeepPartnersApartIs) {
  EXPECT_FALSE(IsNarrower(kLimits, kLimits));
  for (double motion::MotionLimits::*const limit :
       {&motion::MotionLimits::radius, &motion::MotionLimits::acceleration_max,
        &motion::MotionLimits::time_step}) {
    motion::MotionLimits next = kLimits;
    next.*limit *= 2;
    EXPECT_FALSE(IsNarrower(kLimits, next));
    EXPECT_TRUE(IsNarrower(next, kLimits));
  }
}

}  // namespace
}  // namespace collision::detection
