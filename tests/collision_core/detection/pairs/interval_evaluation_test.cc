// Goal:   the evaluation of a pair of balls brackets the contact that the motions have, claims no
//         contact where a shape is awaited, and nothing where a bound was broken.
// Method: two balls on a line whose contact is known in closed form: 2 m/s towards each other's
//         place, in touch from 1 s to 3 s.
#include "collision_core/detection/pairs/interval_evaluation.h"

#include <gtest/gtest.h>

#include "collision_core/detection/encounter/proximity_at.h"
#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr double kBegin = 1, kEnd = 3;  // |4 - 2 t| <= 2

motion::SpaceTimeBound BoundAt(double t, double x, double v, double acceleration_max) {
  motion::SpaceTimeBound bound;
  bound.state = State(t, {x + v * t, 0, 0}, {v, 0, 0});
  bound.limits.radius = 1;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

/// States each quarter of a second from 0 to 5 s.
History Moving(double x, double v, double acceleration_max) {
  History history;
  for (int k = 0; k <= 20; ++k) {
    history.Push({.bound = BoundAt(0.25 * k, x, v, acceleration_max),
                  .link = k == 0 ? Link::kJumped : Link::kFollows},
                 64);
  }
  return history;
}

ContactTracker Evaluated(const History& a, const History& b, double until) {
  ContactTracker tracker(At(0), Past::kKnown);
  WorkBudget work(100000);
  const SegmentCount count = EvaluateSegments(a, b, At(until), &work, &tracker);
  EXPECT_EQ(count.segments, static_cast<std::uint64_t>(4 * until));
  EXPECT_GE(work.spent(), count.segments);
  return tracker;
}

TEST(IntervalEvaluation, BracketsTheContactOfTwoBalls) {
  for (const double acceleration_max : {0.0, 0.1, 2.0}) {
    const ContactTracker tracker =
        Evaluated(Moving(0, 0, acceleration_max), Moving(4, -2, acceleration_max), 5);
    EXPECT_TRUE(tracker.free());
    ASSERT_EQ(tracker.finished().size(), 1u) << acceleration_max;
    const ContactEpisode& contact = tracker.finished().front();
    EXPECT_TRUE(contact.contact && contact.continuous);
    EXPECT_LE(contact.begin.earliest, At(kBegin));
    EXPECT_GE(contact.begin.latest, At(kBegin));
    EXPECT_LE(contact.end.earliest, At(kEnd));
    EXPECT_GE(contact.end.latest, At(kEnd));
    // Halfway between states each is off by at most M/8 · (1/4)²; the gap changes by 2 m/s.
    const double width = 1e-8 + 4 * acceleration_max / 128;
    EXPECT_LE(numeric::SecondsBetween(contact.begin.earliest, contact.begin.latest).upper, width);
    EXPECT_LE(numeric::SecondsBetween(contact.end.earliest, contact.end.latest).upper, width);
  }
}

TEST(IntervalEvaluation, ConfirmsNothingWhileAShapeIsAwaited) {
  History awaited;
  for (int k = 0; k <= 20; ++k) {
    awaited.Push({.bound = BoundAt(0.25 * k, 0, 0, 0),
                  .shape_awaited = true,
                  .link = k == 0 ? Link::kJumped : Link::kFollows},
                 64);
  }
  const ContactTracker tracker = Evaluated(awaited, Moving(4, -2, 0), 5);
  ASSERT_EQ(tracker.finished().size(), 1u);
  EXPECT_FALSE(tracker.finished().front().contact);
  EXPECT_LE(tracker.finished().front().begin.earliest, At(kBegin));
  EXPECT_GE(tracker.finished().front().end.latest, At(kEnd));
}

TEST(IntervalEvaluation, IsUndecidedWhereABoundWasBroken) {
  History broken = Moving(0, 0, 0);
  broken.Push({.bound = BoundAt(5.25, 100, 0, 0), .link = Link::kBroken}, 64);
  ContactTracker tracker(At(5), Past::kKnown);
  WorkBudget work(1000);
  EvaluateSegments(broken, Moving(4, -2, 0), At(5.25), &work, &tracker);
  EXPECT_FALSE(tracker.free() && tracker.finished().empty()) << "nothing is known in between";
  for (const ContactEpisode& episode : tracker.finished()) EXPECT_FALSE(episode.contact);
}

TEST(IntervalEvaluation, TheProximityOfTwoBallsIsTheirDistance) {
  WorkBudget work(10);
  const narrow_phase::Proximity found =
      ProximityAt(Moving(0, 0, 0), Moving(4, -2, 0), At(0.5), &work);
  EXPECT_NEAR(found.separation.lower, 1, 1e-9);
  EXPECT_NEAR(found.separation.upper, 1, 1e-9);
  EXPECT_EQ(work.spent(), 1u);
  EXPECT_FALSE(HaveKnownShapes(Moving(0, 0, 0), Moving(4, -2, 0)));
}

}  // namespace
}  // namespace collision::detection
