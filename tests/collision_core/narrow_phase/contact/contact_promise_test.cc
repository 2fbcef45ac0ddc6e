// Goal:   whatever is said of when two bodies touch holds for every motion within the bounds,
//         however little may be spent on it, and no limit but the work allowed cuts it short.
// Method: motions with random and extreme accelerations, in long double, of two bodies that nearly
//         touch; the true distance before, in and after both brackets.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "tests/collision_core/narrow_phase/promise_scene.h"

namespace collision::narrow_phase {
namespace {

struct Count {
  int free = 0, contact = 0, undecided = 0, budget = 0, narrow = 0;
};

void CheckInstants(const Scene& scene, const TimeOfContactResult& found, Random& random) {
  const Real tolerance = kOracle * (scene.agents[0].limits.radius + scene.agents[1].limits.radius);
  std::vector<Real> instants = {0, scene.duration};
  for (int i = 0; i < 10; ++i) instants.push_back(scene.duration * random.Uniform(0, 1));
  for (const numeric::Interval& bracket : {found.begin, found.end}) {
    for (const double edge : {bracket.lower, bracket.upper}) {
      for (const double off : {-1e-9, 0.0, 1e-9, -1e-3, 1e-3})
        instants.push_back(edge + off * scene.duration);
    }
  }
  for (const Real t : instants) {
    if (!(t >= 0 && t <= scene.duration)) continue;
    const bool free =
        found.status == ContactStatus::kFree || t < found.begin.lower || t > found.end.upper;
    if (free) {
      EXPECT_GT(scene.Distance(t), 0) << "said to be free at " << static_cast<double>(t);
    }
    if (found.status != ContactStatus::kContact) continue;
    if (t == found.begin.upper || t == found.end.lower) {
      EXPECT_LE(scene.Distance(t), tolerance) << "said to touch at " << static_cast<double>(t);
    }
  }
}

void CheckNearest(const Scene& scene, const TimeOfContactResult& found) {
  if (found.status != ContactStatus::kUndecided || found.within == numeric::kInfinity) return;
  Real least = numeric::kInfinity;
  for (int i = 0; i <= 64; ++i) {
    const Real t = found.begin.lower + found.begin.width() * (i / Real(64));
    least = std::min(least, scene.Distance(t));
  }
  // Between two of these instants the bodies move on; the pace of RandomScene() is 3 at most.
  const Real size = scene.agents[0].limits.radius + scene.agents[1].limits.radius;
  const Real moved = 10 * size * found.begin.width() / scene.duration / 64;
  EXPECT_LE(least, found.within + moved + kOracle * size);
}

void Check(const Scene& scene, const TimeOfContactResult& found, Random& random, Count* count) {
  EXPECT_LE(0, found.begin.lower);
  EXPECT_LE(found.begin.lower, found.begin.upper);
  EXPECT_LE(found.end.lower, found.end.upper);
  EXPECT_LE(found.end.upper, scene.duration);
  CheckInstants(scene, found, random);
  CheckNearest(scene, found);
  count->free += found.status == ContactStatus::kFree;
  count->contact += found.status == ContactStatus::kContact;
  count->undecided += found.status == ContactStatus::kUndecided;
  count->budget += found.limited_by == BracketLimit::kBudget;
  count->narrow +=
      found.status == ContactStatus::kContact && found.limited_by == BracketLimit::kNone;
}

Count Judged(std::uint64_t first, int seeds, double tolerance) {
  Count count;
  for (std::uint64_t seed = first;
       seed < first + static_cast<std::uint64_t>(seeds) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = RandomScene(random);
    const BodySegment a = scene.Segment(0), b = scene.Segment(1);
    const std::uint64_t allowed =
        random.Chance(0.5) ? 1000000 : static_cast<std::uint64_t>(random.LogUniform(1, 100000));
    WorkBudget work(allowed);
    const TimeOfContactResult found = TimeOfContact(a, b, scene.duration, {0, tolerance}, &work);
    EXPECT_EQ(found.work, work.spent());
    if (found.limited_by == BracketLimit::kBudget) {
      EXPECT_GE(work.spent(), allowed / 8);
    }
    Check(scene, found, random, &count);
  }
  return count;
}

TEST(ContactPromise, EveryAnswerHoldsForTheTrueMotion) {
  const Count count = Judged(1, 200, 1e-12);
  EXPECT_GT(count.free, 10);
  EXPECT_GT(count.contact, 60);
  EXPECT_GT(count.undecided, 25);
  EXPECT_GT(count.budget, 15);
  EXPECT_GT(count.narrow, 8);
}

TEST(ContactPromise, EveryAnswerHoldsWithAWideTolerance) {
  const Count count = Judged(1001, 100, 1e-3);
  EXPECT_GT(count.contact, 30);
  EXPECT_GT(count.narrow, 10);
}

}  // namespace
}  // namespace collision::narrow_phase
