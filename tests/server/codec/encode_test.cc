// Goal:   what the core says reaches the wire whole: every field, unrounded, in its own place.
// Method: values that all differ, some of which no shorter number type holds.
#include "server/codec/encode.h"

#include <gtest/gtest.h>

#include <numbers>

namespace collision::server {
namespace {

constexpr std::int64_t kLong = (std::int64_t{1} << 60) + 1;

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

detection::AgentId Id(std::uint32_t n) {
  return {.simulator = 0xf000'0000'0000'0000 + n, .slot = n + 2, .run = n + 1, .generation = n + 3};
}

void ExpectId(const v1::AgentId& wire, std::uint32_t n) {
  EXPECT_EQ(wire.simulator_id(), 0xf000'0000'0000'0000 + n);
  EXPECT_EQ(wire.run(), n + 1);
  EXPECT_EQ(wire.slot(), n + 2);
  EXPECT_EQ(wire.generation(), n + 3);
}

TEST(Encode, AnEventKeepsIdentityTimesAndStatus) {
  detection::CollisionEvent event;
  event.lower = Id(10);
  event.higher = Id(20);
  event.pair_slot = 31;
  event.contact = 32;
  event.revision = 33;
  event.now = At(kLong);
  event.status = detection::EventStatus::kWithdrawn;
  event.begin = {At(-5), At(kLong + 1)};
  event.end = {At(7), Instant::Never()};
  event.continuous = false;
  event.began_before = true;
  event.evaluated_at = At(8);
  const v1::CollisionEvent wire = Encode(event);
  ExpectId(wire.lower(), 10);
  ExpectId(wire.higher(), 20);
  EXPECT_EQ(wire.pair_slot(), 31u);
  EXPECT_EQ(wire.contact(), 32u);
  EXPECT_EQ(wire.revision(), 33u);
  EXPECT_EQ(wire.now_ns(), kLong);
  EXPECT_EQ(wire.status(), v1::EVENT_WITHDRAWN);
  EXPECT_EQ(wire.begin().earliest_ns(), -5);
  EXPECT_EQ(wire.begin().latest_ns(), kLong + 1);
  EXPECT_EQ(wire.end().earliest_ns(), 7);
  EXPECT_EQ(wire.end().latest_ns(), std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(wire.continuous());
  EXPECT_TRUE(wire.began_before());
  EXPECT_EQ(wire.proximity().at_ns(), 8);
}

TEST(Encode, AnEventKeepsItsGeometryUnrounded) {
  detection::CollisionEvent event;
  event.separation_lower = -0.1;
  event.separation_upper = 1 / 3.0;
  event.depth_lower = 0.7;
  event.p_WC = {1.1, 1e15 + 0.125, -3.3};
  event.point_error = 0.01;
  event.normal = {0.36, 0.48, 0.8};
  event.normal_error = 0.02;
  event.level = 5;
  event.work = 0xf000'0000'0000'0001;
  event.limited_by = narrow_phase::BracketLimit::kGeometry;
  event.evaluated_at = At(kLong);
  event.lower_part = 0;
  event.relative_velocity = {{1.5, -2.5, 3.5}, 0.25};
  const v1::CollisionEvent wire = Encode(event);
  EXPECT_EQ(wire.proximity().separation_m().lower(), -0.1);
  EXPECT_EQ(wire.proximity().separation_m().upper(), 1 / 3.0);
  EXPECT_EQ(wire.proximity().depth_lower_m(), 0.7);
  EXPECT_EQ(wire.proximity().point_m().x(), 1.1);
  EXPECT_EQ(wire.proximity().point_m().y(), 1e15 + 0.125);
  EXPECT_EQ(wire.proximity().point_m().z(), -3.3);
  EXPECT_EQ(wire.proximity().point_error_m(), 0.01);
  EXPECT_EQ(wire.proximity().normal().direction().x(), 0.36);
  EXPECT_EQ(wire.proximity().normal().direction().y(), 0.48);
  EXPECT_EQ(wire.proximity().normal().direction().z(), 0.8);
  EXPECT_EQ(wire.proximity().normal().error_rad(), 0.02);
  EXPECT_EQ(wire.tree_level(), 5u);
  EXPECT_EQ(wire.work_units(), 0xf000'0000'0000'0001);
  EXPECT_EQ(wire.limited_by(), v1::LIMIT_GEOMETRY);
  EXPECT_TRUE(wire.proximity().has_lower_part());
  EXPECT_FALSE(wire.proximity().has_higher_part());
  EXPECT_EQ(wire.proximity().relative_velocity().velocity_m_s().y(), -2.5);
  EXPECT_EQ(wire.proximity().relative_velocity().error_m_s(), 0.25);
}

TEST(Encode, WhatNobodyKnowsIsAbsent) {
  detection::CollisionEvent event;
  const v1::CollisionEvent possible = Encode(event);
  EXPECT_FALSE(possible.has_proximity() || possible.has_expected() || possible.has_closest());
  EXPECT_FALSE(possible.has_lower_state() || possible.has_higher_state());
  event.evaluated_at = At(1);
  event.normal = {1, 0, 0};
  event.normal_error = std::numbers::pi;
  EXPECT_FALSE(Encode(event).proximity().has_normal()) << "it may point anywhere";
  event.normal_error = 3;
  EXPECT_TRUE(Encode(event).proximity().has_normal());
  event.normal.setZero();
  EXPECT_FALSE(Encode(event).proximity().has_normal()) << "there is none";
}

void ExpectVector(const v1::Vector3& wire, double x, double y, double z) {
  EXPECT_EQ(wire.x(), x);
  EXPECT_EQ(wire.y(), y);
  EXPECT_EQ(wire.z(), z);
}

TEST(Encode, AnEventKeepsStatesExpectationAndClosestApproach) {
  detection::CollisionEvent event;
  event.lower_state = {At(1), {1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  event.higher_state = {At(kLong), {11, 12, 13}, {14, 15, 16}, {17, 18, 19}};
  event.closest = {At(2), At(6), {At(3), At(4)}, {0.1, 0.3}};
  event.expected = detection::Expectation{
      .outcome = detection::ExpectedOutcome::kPass,
      .begin = {},
      .closest = detection::ClosestApproach{At(12), At(16), {At(13), At(14)}, {1.1, 1.3}},
      .until = At(17)};
  const v1::CollisionEvent wire = Encode(event);
  EXPECT_EQ(wire.lower_state().stamp_ns(), 1);
  ExpectVector(wire.lower_state().position_m(), 1, 2, 3);
  ExpectVector(wire.lower_state().velocity_m_s(), 4, 5, 6);
  ExpectVector(wire.lower_state().acceleration_m_s2(), 7, 8, 9);
  EXPECT_EQ(wire.higher_state().stamp_ns(), kLong);
  ExpectVector(wire.higher_state().position_m(), 11, 12, 13);
  EXPECT_EQ(wire.closest().from_ns(), 2);
  EXPECT_EQ(wire.closest().until_ns(), 6);
  EXPECT_EQ(wire.closest().at().earliest_ns(), 3);
  EXPECT_EQ(wire.closest().at().latest_ns(), 4);
  EXPECT_EQ(wire.closest().distance_m().lower(), 0.1);
  EXPECT_EQ(wire.closest().distance_m().upper(), 0.3);
  EXPECT_EQ(wire.expected().outcome(), v1::EXPECTED_PASS);
  EXPECT_EQ(wire.expected().begin().earliest_ns(), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(wire.expected().closest().until_ns(), 16);
  EXPECT_EQ(wire.expected().closest().distance_m().lower(), 1.1);
  EXPECT_EQ(wire.expected().until_ns(), 17);
}

TEST(Encode, TheEarliestIntersectionNamesItsPair) {
  const v1::EarliestIntersection wire =
      Encode(detection::EarliestAnswer{true, At(kLong), Id(10), Id(20)});
  EXPECT_TRUE(wire.found());
  EXPECT_EQ(wire.earliest_ns(), kLong);
  ExpectId(wire.lower(), 10);
  ExpectId(wire.higher(), 20);
  EXPECT_FALSE(Encode(detection::EarliestAnswer{}).found());
}

TEST(Encode, AClearanceKeepsEveryInstantApart) {
  detection::AgentClearance clearance;
  clearance.agent = Id(10);
  clearance.clear_until = At(1);
  clearance.not_clear = true;
  clearance.effective_from = At(2);
  clearance.cause = detection::ClearanceCause::kBreach;
  clearance.cause_agent = Id(20);
  clearance.void_from = At(3);
  const v1::AgentClearance wire = Encode(clearance, 44, 55, At(4));
  EXPECT_EQ(wire.slot(), 12u);
  EXPECT_EQ(wire.generation(), 13u);
  EXPECT_EQ(wire.clear_until_ns(), 1);
  EXPECT_TRUE(wire.not_clear());
  EXPECT_FALSE(wire.saturated());
  EXPECT_EQ(wire.acknowledged_sequence(), 44u);
  EXPECT_EQ(wire.acknowledged_revision(), 55u);
  EXPECT_EQ(wire.effective_from_ns(), 2);
  EXPECT_EQ(wire.cause(), v1::CAUSE_BREACH);
  ExpectId(wire.cause_agent(), 20);
  EXPECT_EQ(wire.void_from_ns(), 3);
  EXPECT_EQ(wire.state_wanted_ns(), 4);
}

}  // namespace
}  // namespace collision::server
