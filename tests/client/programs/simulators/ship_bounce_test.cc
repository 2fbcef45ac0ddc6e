// Goal:   ships that touch come apart: an elastic push at the point, away from the other ship, once
//         for each contact, and again only if it lasts.
// Method: pushes whose outcome is known; whole sequences of events.
#include "client/programs/simulators/motion/ship_bounce.h"

#include <gtest/gtest.h>

#include <cmath>

namespace collision::client {
namespace {

constexpr double kRadius = 2;
constexpr double kInertia = 0.4 * kRadius * kRadius;  // for a unit mass

RigidState Moving(const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s = {}) {
  RigidState state;
  state.position_m = {10, 0, 0};
  state.velocity_m_s = velocity_m_s;
  state.angular_velocity_rad_s = angular_velocity_rad_s;
  return state;
}

double Energy(const RigidState& state) {
  return Dot(state.velocity_m_s, state.velocity_m_s) +
         kInertia * Dot(state.angular_velocity_rad_s, state.angular_velocity_rad_s);
}

Vector3 PointVelocity(const RigidState& state, const Vector3& point_m) {
  return Sum(state.velocity_m_s,
             Cross(state.angular_velocity_rad_s, Difference(point_m, state.position_m)));
}

TEST(BounceOff, HeadOnReversesTheVelocity) {
  RigidState state = Moving({3, 1, 0});
  EXPECT_TRUE(BounceOff({{12, 0, 0}, {1, 0, 0}}, kRadius, &state));
  EXPECT_EQ(state.velocity_m_s, (Vector3{-3, 1, 0}));
  EXPECT_EQ(state.angular_velocity_rad_s, (Vector3{0, 0, 0}));
}

// A ship hit off centre keeps its energy and turns, and the point leaves as fast as it came. Struck
// at its left it turns to the left: the side that was stopped stays behind.
TEST(BounceOff, OffCentreThePushTurnsTheShipAndKeepsItsEnergy) {
  RigidState state = Moving({20, 0, 0}, {0, 0, 0.25});
  const Vector3 point = {11, 1, 0.5};
  const double before = PointVelocity(state, point)[0], energy = Energy(state);
  EXPECT_TRUE(BounceOff({point, {1, 0, 0}}, kRadius, &state));
  EXPECT_NEAR(PointVelocity(state, point)[0], -before, 1e-12);
  EXPECT_NEAR(Energy(state), energy, 1e-12);
  EXPECT_GT(state.angular_velocity_rad_s[2], 0.25);
  EXPECT_EQ(state.velocity_m_s[1], 0);
}

TEST(BounceOff, TheNormalPointsFromLowerToHigher) {
  Event event;
  event.proximity.emplace().normal.emplace();
  event.proximity->point_m = {11, 0, 0};
  event.proximity->normal->direction = {0, 2, 0};
  event.proximity->at_ns = 100;
  const RigidState state = Moving({});
  EXPECT_EQ(ContactOf(event, true, state, 100).outward, (Vector3{0, 1, 0}));
  EXPECT_EQ(ContactOf(event, false, state, 100).outward, (Vector3{0, -1, 0}));
}

// The event is a tenth of a second old; since then the ship has moved on with the point.
TEST(BounceOff, ThePointMovesAlongWithTheShip) {
  Event event;
  event.proximity.emplace().normal.emplace();
  event.proximity->point_m = {11, 0, 0};
  event.proximity->at_ns = 900'000'000;
  EXPECT_NEAR(ContactOf(event, true, Moving({4, 0, 0}), 1'000'000'000).point_m[0], 11.4, 1e-12);
}

TEST(BounceOff, AnUncertainNormalCountsAsNone) {
  Event event;
  event.proximity.emplace().normal.emplace();
  event.proximity->point_m = {10, 2, 0};
  event.proximity->normal->direction = {1, 0, 0};
  event.proximity->normal->error_rad = kNormalErrorMax * 1.01;
  RigidState state = Moving({0, 3, 0});
  const ShipContact contact = ContactOf(event, true, state, 0);
  EXPECT_EQ(contact.outward, (Vector3{0, 0, 0}));
  EXPECT_TRUE(BounceOff(contact, kRadius, &state));
  EXPECT_EQ(state.velocity_m_s, (Vector3{0, -3, 0}));
  event.proximity->normal->error_rad = kNormalErrorMax * 0.99;
  EXPECT_NE(ContactOf(event, true, state, 0).outward, (Vector3{0, 0, 0}));
}

TEST(BounceOff, LeavesAtTheLeastSpeedAndThenNothingChanges) {
  RigidState state = Moving({0.25, 0, 0});
  const ShipContact contact{{12, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(BounceOff(contact, kRadius, &state));
  EXPECT_EQ(state.velocity_m_s, (Vector3{-kSpeedApart, 0, 0}));
  EXPECT_FALSE(BounceOff(contact, kRadius, &state));
  RigidState drifting = Moving({-0.5, 0, 0});
  EXPECT_TRUE(BounceOff(contact, kRadius, &drifting)) << "it parts too slowly";
  RigidState parting = Moving({-2, 0, 0});
  EXPECT_FALSE(BounceOff(contact, kRadius, &parting));
}

// No normal, the point in the centre, no velocity: the ship moves off all the same.
TEST(BounceOff, WithoutAnyDirectionItStillMoves) {
  RigidState state = Moving({});
  EXPECT_TRUE(BounceOff({{10, 0, 0}, {}}, 0, &state));
  EXPECT_NEAR(Norm(state.velocity_m_s), kSpeedApart, 1e-15);
}

class ContactsToAnswerTest : public testing::Test {
 protected:
  static constexpr AgentId kOwn{5, 1, 0, 1};
  static constexpr AgentId kOther{3, 1, 0, 1};

  void Handle(EventStatus status, std::uint32_t contact, const AgentId& other = kOther) {
    Event event;
    event.status = status;
    event.contact = contact;
    event.lower = std::min(other, kOwn);
    event.higher = std::max(other, kOwn);
    event.proximity.emplace().normal.emplace();
    event.proximity->point_m = {9, 0, 0};
    event.proximity->normal->direction = {1, 0, 0};
    contacts_.Handle(event, kOwn);
  }

  std::vector<ShipContact> TakeAt(double seconds) {
    return contacts_.Take(Moving({}), std::llround(seconds * 1e9));
  }

  ContactsToAnswer contacts_;
};

TEST_F(ContactsToAnswerTest, AContactIsAnsweredOnceAndAgainOnlyIfItLasts) {
  Handle(EventStatus::kPossible, 1);
  EXPECT_TRUE(TakeAt(1.0).empty());
  Handle(EventStatus::kConfirmed, 1);
  const auto answer = TakeAt(1.1);
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_EQ(answer[0].outward, (Vector3{-1, 0, 0})) << "we are the higher one";
  Handle(EventStatus::kConfirmed, 1);
  EXPECT_TRUE(TakeAt(1.2).empty()) << "a later revision";
  const auto again = TakeAt(1.36);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].outward, (Vector3{0, 0, 0})) << "away from the point";
  Handle(EventStatus::kEnded, 1);
  EXPECT_TRUE(TakeAt(9).empty());
}

// A contact of a few milliseconds is over before its owner's next step, and must be answered.
TEST_F(ContactsToAnswerTest, AContactThatIsOverIsAnsweredToo) {
  Handle(EventStatus::kConfirmed, 1);
  Handle(EventStatus::kEnded, 1);
  EXPECT_EQ(TakeAt(1).size(), 1u);
  EXPECT_TRUE(TakeAt(2).empty());
}

// A jump ends a contact and may begin the next one at the same instant: no jump for every step.
TEST_F(ContactsToAnswerTest, TheSamePairIsNotAnsweredAtEveryStep) {
  Handle(EventStatus::kConfirmed, 1);
  EXPECT_EQ(TakeAt(1).size(), 1u);
  Handle(EventStatus::kEnded, 1);
  Handle(EventStatus::kConfirmed, 2);
  EXPECT_TRUE(TakeAt(1.1).empty());
  EXPECT_EQ(TakeAt(1.3).size(), 1u) << "it lasts";
  Handle(EventStatus::kEnded, 1);
  EXPECT_EQ(TakeAt(1.6).size(), 1u) << "an older contact has ended";
  Handle(EventStatus::kWithdrawn, 2);
  EXPECT_TRUE(TakeAt(3).empty());
}

TEST_F(ContactsToAnswerTest, ContactsOfOtherAgentsAreIgnored) {
  Handle(EventStatus::kConfirmed, 1);
  Handle(EventStatus::kConfirmed, 1, {9, 1, 4, 1});
  Event foreign;
  foreign.status = EventStatus::kConfirmed;
  foreign.lower = {1, 1, 0, 1};
  foreign.higher = {2, 1, 0, 1};
  contacts_.Handle(foreign, kOwn);
  const auto answers = TakeAt(1);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].outward, (Vector3{-1, 0, 0}));
  EXPECT_EQ(answers[1].outward, (Vector3{1, 0, 0})) << "of that one we are the lower";
}

}  // namespace
}  // namespace collision::client
