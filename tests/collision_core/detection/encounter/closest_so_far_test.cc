// Goal:   the closest approach of a pair is followed from segment to segment without a gap, and
//         begins anew where nothing is known.
// Method: a ball that passes another one, states each quarter of a second; the least distance is 1
//         m at 2 s.
#include "collision_core/detection/encounter/closest_so_far.h"

#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr std::uint64_t kPlenty = 100000;

History Moving(const Vector3d& p, const Vector3d& v, double acceleration_max, double broken = -1) {
  History history;
  for (int k = 0; k <= 16; ++k) {
    const double t = 0.25 * k;
    motion::SpaceTimeBound bound;
    bound.state = State(t, p + v * t, v);
    bound.limits = {.radius = 1, .acceleration_max = acceleration_max};
    history.Push({.bound = bound, .link = t == broken ? Link::kBroken : Link::kFollows}, 64);
  }
  return history;
}

PublishedEvent From(double seconds) {
  PublishedEvent published;
  published.announced = true;
  published.followed_until = At(seconds);
  return published;
}

class ClosestOfLines : public testing::TestWithParam<bool> {};

TEST_P(ClosestOfLines, IsThatOfAllSegmentsTogether) {
  for (const double acceleration_max : {0.0, 0.5}) {
    const History a = Moving({0, 0, 0}, {0, 0, 0}, acceleration_max);
    const History b = Moving({-4, 3, 0}, {2, 0, 0}, acceleration_max);
    PublishedEvent published = From(0.5);
    for (double t = 0.75; t <= 4; t += 0.25) {
      const bool approaching = GetParam() && t < 4;
      FollowClosest(a, b, {At(t), approaching, kPlenty}, &published);
      const Instant until = At(approaching ? t - 0.25 : t);
      EXPECT_EQ(published.followed_until, until);
      if (until == At(0.5)) continue;
      ASSERT_TRUE(published.closest);
      EXPECT_EQ(published.closest->from, At(0.5));
      EXPECT_EQ(published.closest->until, until);
    }
    EXPECT_LE(published.closest->distance.lower, 1);
    EXPECT_GE(published.closest->distance.upper, 1);
    // Half-way between two states each is known to within M/8 · (1/4)², of which the search may
    // leave an eighth.
    EXPECT_LE(published.closest->distance.width(), 1e-5 + 6 * acceleration_max / 128);
    EXPECT_LE(published.closest->at.earliest, At(2));
    EXPECT_GE(published.closest->at.latest, At(2));
    EXPECT_LE(published.closest->at.latest, At(acceleration_max == 0 ? 2.02 : 2.3));
  }
}

INSTANTIATE_TEST_SUITE_P(AtOnceAndLater, ClosestOfLines, testing::Bool());

// Of two that come nearer all the time each segment is bounded once.
TEST(ClosestSoFar, WhatComesNearerCostsNextToNothing) {
  const History a = Moving({0, 0, 0}, {0, 0, 0}, 0.5), b = Moving({-9, 3, 0}, {2, 0, 0}, 0.5);
  PublishedEvent published = From(0);
  std::uint64_t units = 0;
  for (double t = 0.25; t <= 4; t += 0.25) {
    units += FollowClosest(a, b, {At(t), /*approaching=*/true, kPlenty}, &published);
  }
  EXPECT_EQ(published.closest->until, At(3.75));
  EXPECT_LE(units, 2u * 15);
}

TEST(ClosestSoFar, WhatComesLaterAndIsFartherCostsNextToNothing) {
  const History a = Moving({0, 0, 0}, {0, 0, 0}, 0), b = Moving({-4, 3, 0}, {2, 0, 0}, 0);
  PublishedEvent published = From(0);
  FollowClosest(a, b, {.until = At(2.5), .shape_units = kPlenty}, &published);
  const ClosestApproach before = *published.closest;
  EXPECT_LT(FollowClosest(a, b, {.until = At(3.5), .shape_units = kPlenty}, &published), 40u);
  EXPECT_EQ(published.closest->at, before.at);
  EXPECT_EQ(published.closest->until, At(3.5));
}

TEST(ClosestSoFar, WhatClosesAnEventTellsItToTheEnd) {
  Line line;
  line.Add(1, {0, 0, 0}, {0, 0, 0});
  line.Add(2, {-6, 3.5, 0}, {2, 0, 0});
  line.RunTo(8);
  const auto dismissed = line.With(EventStatus::kDismissed);
  ASSERT_EQ(dismissed.size(), 1u);
  ASSERT_TRUE(dismissed[0].closest);
  EXPECT_EQ(dismissed[0].closest->until, dismissed[0].now);
  EXPECT_LE(dismissed[0].closest->distance.lower, 1.5);
  EXPECT_GE(dismissed[0].closest->distance.upper, 1.5);
  EXPECT_LE(dismissed[0].closest->distance.width(), 0.01);
}

TEST(ClosestSoFar, BeginsAnewAfterABrokenBound) {
  const History a = Moving({0, 0, 0}, {0, 0, 0}, 0, 2.25);
  const History b = Moving({-4, 3, 0}, {2, 0, 0}, 0);
  PublishedEvent published = From(0);
  FollowClosest(a, b, {.until = At(4), .shape_units = kPlenty}, &published);
  ASSERT_TRUE(published.closest);
  EXPECT_EQ(published.closest->from, At(2.25)) << "from 2 to 2.25 s nothing is known";
  EXPECT_GT(published.closest->distance.lower, 1.01);
}

}  // namespace
}  // namespace collision::detection
