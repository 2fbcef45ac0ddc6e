// Query, hint and budget change how wide the answer is, never whether it is right.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

struct Solids {
  shape::ConvexSolid a, b;
};

Solids RandomSolids(Random& random, double apart) {
  shape::ConvexDescription d[2];
  for (int i = 0; i < 2; ++i) {
    d[i] = RandomPolytope(random, 1);
    d[i].p_BS = Vector3d::Zero();
    if (random.Chance(0.3))
      d[i] = RandomBox(random, 1), d[i].core = geometry::ConvexCore::kEllipsoid;
  }
  d[1].p_BS = random.Uniform(0, apart) * random.UnitVector();
  return {shape::ConvexSolid::Build(d[0]), shape::ConvexSolid::Build(d[1])};
}

ConvexSeparation Best(const Solids& s) {
  geometry::GjkHint hint;
  WorkBudget work(1000000);
  return SeparationOf(s.a.set(), s.b.set(), {}, &hint, &work);
}

/// Two brackets of one number have something in common.
void ExpectMeet(const numeric::Interval& x, const numeric::Interval& y) {
  EXPECT_LE(x.lower, y.upper);
  EXPECT_LE(y.lower, x.upper);
}

// Goal:   any work allowed, down to none, gives a bracket that holds the answer; what is left out
//         is reported; and what is spent is no more than a step and the directions tried at the end
//         beyond it.
TEST(ConvexLimits, AnyBudget) {
  Random random(321);
  int exhausted = 0;
  for (int i = 0; i < 400; ++i) {
    const Solids s = RandomSolids(random, 3);
    const numeric::Interval best = Best(s).separation;
    for (const std::uint64_t allowed : {0, 1, 2, 3, 5, 8, 20, 60}) {
      geometry::GjkHint hint;
      WorkBudget work(allowed);
      const ConvexSeparation found = SeparationOf(s.a.set(), s.b.set(), {}, &hint, &work);
      ExpectMeet(found.separation, best);
      EXPECT_LE(found.separation.lower, found.separation.upper);
      EXPECT_LE(work.spent(), allowed + 64);
      exhausted += found.exhausted;
      if (found.separation.width() > 1e-6 && allowed < 5) {
        EXPECT_TRUE(found.exhausted) << i << " " << allowed;
      }
    }
  }
  EXPECT_GT(exhausted, 300);
}

// Goal:   a hint, right or wrong, changes nothing but the work; the right one saves some.
TEST(ConvexLimits, AnyHint) {
  Random random(322);
  std::uint64_t cold = 0, warm = 0;
  geometry::GjkHint other;  // From the last pair.
  for (int i = 0; i < 600; ++i) {
    const Solids s = RandomSolids(random, 4);
    WorkBudget first(1000000), second(1000000), third(1000000);
    geometry::GjkHint hint;
    const ConvexSeparation found = SeparationOf(s.a.set(), s.b.set(), {}, &hint, &first);
    const ConvexSeparation again = SeparationOf(s.a.set(), s.b.set(), {}, &hint, &second);
    geometry::GjkHint wrong = other;
    other = hint;
    const ConvexSeparation misled = SeparationOf(s.a.set(), s.b.set(), {}, &wrong, &third);
    ExpectMeet(found.separation, again.separation);
    ExpectMeet(found.separation, misled.separation);
    cold += first.spent();
    warm += second.spent();
  }
  EXPECT_LT(warm, cold);
}

// Goal:   yes or no is answered wherever the best bracket answers it with some room, and never
//         wrongly.
TEST(ConvexLimits, YesOrNo) {
  Random random(323);
  int yes = 0, no = 0;
  for (int i = 0; i < 2000; ++i) {
    const Solids s = RandomSolids(random, 3);
    const numeric::Interval best = Best(s).separation;
    ConvexQuery query;
    query.goal = ConvexGoal::kYesNo;
    geometry::GjkHint hint;
    WorkBudget work(1000000);
    const numeric::Interval found =
        SeparationOf(s.a.set(), s.b.set(), query, &hint, &work).separation;
    ExpectMeet(found, best);
    no += best.lower > 1e-9;
    yes += best.upper < -1e-9;
    if (best.lower > 1e-9) {
      EXPECT_GT(found.lower, 0) << i;
    }
    if (best.upper < -1e-9) {
      EXPECT_LE(found.upper, 0) << i;
    }
  }
  EXPECT_GT(yes, 300);
  EXPECT_GT(no, 300);
}

// Goal:   a width asked for is reached, absolute or relative, and saves work.
TEST(ConvexLimits, WidthAskedFor) {
  Random random(324);
  std::uint64_t coarse = 0, fine = 0;
  for (int i = 0; i < 500; ++i) {
    const Solids s = RandomSolids(random, 6);
    for (const double width : {1e-1, 1e-3, 1e-6}) {
      ConvexQuery query;
      query.absolute_tolerance = i % 2 ? width : 0;
      query.relative_tolerance = i % 2 ? 0 : width;
      geometry::GjkHint hint;
      WorkBudget work(1000000);
      const ConvexSeparation found = SeparationOf(s.a.set(), s.b.set(), query, &hint, &work);
      const numeric::Interval at = found.separation;
      if (!(at.lower > 1e-3)) continue;
      EXPECT_LE(at.width(),
                std::max(query.absolute_tolerance, query.relative_tolerance * at.lower));
      if (width == 1e-1) coarse += work.spent();
      if (width == 1e-6) fine += work.spent();
    }
  }
  EXPECT_LT(coarse, fine);
}

// Goal:   the same query has the same bits for an answer.
TEST(ConvexLimits, Deterministic) {
  Random random(325);
  for (int i = 0; i < 100; ++i) {
    const Solids s = RandomSolids(random, 3);
    const ConvexSeparation x = Best(s), y = Best(s);
    EXPECT_EQ(x.separation.lower, y.separation.lower);
    EXPECT_EQ(x.separation.upper, y.separation.upper);
    EXPECT_EQ(x.a, y.a);
    EXPECT_EQ(x.normal, y.normal);
  }
}

// Goal:   what the sets themselves are uncertain by widens the bracket by as much, from both sides.
TEST(ConvexLimits, UncertainSets) {
  Random random(326);
  for (int i = 0; i < 300; ++i) {
    const Solids s = RandomSolids(random, 4);
    const numeric::Interval best = Best(s).separation;
    geometry::ConvexSet a = s.a.set(), b = s.b.set();
    a.error += 0.125;
    b.error += 0.25;
    geometry::GjkHint hint;
    WorkBudget work(1000000);
    const ConvexSeparation found = SeparationOf(a, b, {}, &hint, &work);
    EXPECT_LE(found.separation.lower, best.upper - 0.375);
    EXPECT_GE(found.separation.upper, best.lower + 0.375);
    EXPECT_GE(found.separation.lower, best.lower - 0.375 - 1e-12);
    if (best.lower > 0) {
      EXPECT_LE(found.separation.upper, best.upper + 0.375 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace collision::narrow_phase
