// Goal:   a bracket is as narrow as the motion allows, costs no more than asked for, and says what
//         limited it.
// Method: closed cases with accelerations, budgets of every size, turns by the thousand, contacts
//         that only graze.
#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/support/truth/true_distance.h"

namespace collision::narrow_phase {
namespace {

TEST(ContactLimits, AsNarrowAsAskedForAndNoWorkBeyond) {
  const Body a{UnitCube()}, b{UnitCube(), 0, {5, 0.3, 0.2}, {-10, 0, 0}};
  std::uint64_t before = ~std::uint64_t{0};
  for (const double relative : {1e-12, 1e-9, 1e-6, 1e-3}) {
    const TimeOfContactResult found = Find(a, b, 1, Result::kAtStart, {0, relative});
    ExpectContact(found, 0.4L, 0.6L, relative);
    EXPECT_LE(found.work, before);
    before = found.work;
  }
  const TimeOfContactResult absolute = Find(a, b, 1, Result::kAtStart, {1e-7, 0});
  ExpectContact(absolute, 0.4L, 0.6L, 1e-7 / 0.4);
}

// What is not known of the motion: u(t) = ½ (M_A + M_B) t². The two may touch as soon as 10 t + u =
// 4, and do for certain as soon as 10 t − u = 4.
TEST(ContactLimits, AsNarrowAsTheMotionAllows) {
  for (const double M : {1e-6, 0.01, 1.0}) {
    Body a{UnitCube()}, b{UnitCube(), 0, {5, 0.3, 0.2}, {-10, 0, 0}};
    a.acceleration_max = b.acceleration_max = M;
    const Real first = (std::sqrt(25 + 4 * Real(M)) - 5) / M;
    const Real sure = (5 - std::sqrt(25 - 4 * Real(M))) / M;
    for (const Result states_at : {Result::kAtStart, Result::kAtBoth}) {
      const TimeOfContactResult found = Find(a, b, 1, states_at);
      ASSERT_EQ(found.status, ContactStatus::kContact);
      EXPECT_EQ(found.limited_by, BracketLimit::kMotion);
      EXPECT_LE(found.begin.lower, first * (1 + kStated));
      EXPECT_GE(found.begin.upper, sure * (1 - kStated));
      EXPECT_LE(found.begin.width(), 1.1 * static_cast<double>(sure - first));
    }
  }
}

// A bar that may turn sooner or later by θ(t) = ½ α t².
TEST(ContactLimits, AsNarrowAsTheTurningAllows) {
  for (const double alpha : {1e-6, 0.01}) {
    Body bar{shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1}))};
    bar.w = {0, 0, 1};
    bar.angular_acceleration_max = alpha;
    const Body ball{nullptr, 0.2, {0, 1, 0}};
    const TimeOfContactResult found = Find(bar, ball, 2);
    ASSERT_EQ(found.status, ContactStatus::kContact);
    EXPECT_EQ(found.limited_by, BracketLimit::kMotion);
    const double truth = std::acos(0.3), off = alpha * truth * truth / 2;
    EXPECT_LE(found.begin.lower, truth - 0.9 * off);
    EXPECT_GE(found.begin.upper, truth + 0.9 * off);
    // About the reference point points move by θ |x|, whatever the axis: the bar's whole triangles
    // (2.002 m) count where the ball is 0.95 m away.
    EXPECT_LE(found.begin.width(), 5 * off);
  }
}

// At any limit the bracket contains the truth, says what limited it, and never stops by itself.
TEST(ContactLimits, TheWorkLimitIsTheOnlyOne) {
  Random random(7);
  const auto star = shape::Shape::Build(Star(2, random));
  Body a{star}, b{star, 0, {4, 0.1, 0.2}, {-2, 0, 0}};
  a.w = {0.1, 0.2, 3};
  b.w = {0, 3, 0.1};
  const TimeOfContactResult best = Find(a, b, 3);
  ASSERT_EQ(best.status, ContactStatus::kContact);
  ASSERT_EQ(best.limited_by, BracketLimit::kNone);
  int limited = 0;
  for (std::uint64_t units = 0; units < 2 * best.work; units = units * 5 / 4 + 1) {
    const TimeOfContactResult found = Find(a, b, 3, Result::kAtStart, {}, units);
    EXPECT_LE(found.begin.lower, best.begin.upper) << units;
    EXPECT_GE(found.end.upper, best.end.lower) << units;
    ASSERT_NE(found.status, ContactStatus::kFree);
    if (found.status == ContactStatus::kContact) {
      EXPECT_GE(found.begin.upper, best.begin.lower) << units;
      EXPECT_LE(found.end.lower, best.end.upper) << units;
    }
    if (found.limited_by == BracketLimit::kNone) {
      EXPECT_LE(found.begin.width(), 1e-12 * found.begin.upper);
      continue;
    }
    EXPECT_EQ(found.limited_by, BracketLimit::kBudget) << units;
    EXPECT_GE(found.work, units / 8) << units;
    ++limited;
  }
  EXPECT_GT(limited, 5);
}

// What turns over and over without meeting anything costs no more than one turn.
TEST(ContactLimits, WorkDoesNotGrowWithTurnsThatMatterNothing) {
  Body bar{shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1}))};
  const Body ball{nullptr, 0.2, {0.5, 0, 0.35}}, cube{UnitCube(), 0, {0.5, 0.3, 0.65}, {0.1, 0, 0}};
  for (const double turns : {10.0, 1000.0, 100000.0}) {
    bar.w = {0, 0, 2 * kPi * turns};
    for (const Body& other : {ball, cube}) {
      const TimeOfContactResult found = Find(bar, other, 1, Result::kAtStart, {}, 200000);
      EXPECT_EQ(found.status, ContactStatus::kFree) << turns;
    }
  }
  // What comes down on it meets it within the turn in which it comes near enough.
  bar.w = {0, 0, 2 * kPi * 1000};
  const Body falling{nullptr, 0.2, {0.3, 0.2, 2}, {0, 0, -2}};
  const TimeOfContactResult found = Find(bar, falling, 1);
  ASSERT_EQ(found.status, ContactStatus::kContact);
  EXPECT_GE(found.begin.lower, 0.85 - 1e-9);
  EXPECT_LE(found.begin.upper, 0.85 + 5e-4);
  EXPECT_LE(found.begin.width(), 1e-12);
}

// Turned by more than kRotationAngleMax a body may be turned any way, as if no bound were declared:
// that is what limits the answer, whatever the budget.
TEST(ContactLimits, TurnsBeyondAllMeasureAreNotKnown) {
  Random random(3);
  const auto star = shape::Shape::Build(Subdivided(Star(3, random), 3));
  Body bar{shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1}))};
  for (const Body& other :
       {Body{nullptr, 0.2, {-5, 0, 0}, {10, 0, 0}}, Body{UnitCube(), 0, {-5, 0, 0}, {10, 0, 0}},
        Body{star, 0, {-5, 0, 0}, {10, 0, 0}}}) {
    Body undeclared = bar;
    undeclared.angular_acceleration_max = -1;
    for (const std::uint64_t units : {std::uint64_t{10'000}, std::uint64_t{200'000}}) {
      const TimeOfContactResult least = Find(undeclared, other, 1, Result::kAtStart, {}, units);
      EXPECT_EQ(least.limited_by, BracketLimit::kMotion);
      for (const double rate : {10 * numeric::kRotationAngleMax, 1e9, 1e15, 1e150}) {
        bar.w = {0, 0, rate};
        for (const Result states_at : {Result::kAtStart, Result::kAtBoth}) {
          const TimeOfContactResult found = Find(bar, other, 1, states_at, {}, units);
          EXPECT_NE(found.status, ContactStatus::kFree);
          EXPECT_EQ(found.limited_by, BracketLimit::kMotion) << rate;
          EXPECT_GE(found.begin.lower, least.begin.lower - 1e-12);
          EXPECT_LE(found.end.upper, least.end.upper + 1e-12);
          if (found.status != ContactStatus::kContact) continue;
          EXPECT_LE(found.begin.upper, 0.5);  // the other passes through the middle
          EXPECT_GE(found.end.lower, 0.5);
        }
      }
    }
  }
  // Near to a state it is known, whichever comes first.
  bar.w = {0, 0, 1.5 * numeric::kRotationAngleMax};
  const Body passing{nullptr, 0.2, {-5, 0, 0}, {10, 0, 0}};
  const TimeOfContactResult found = Find(bar, passing, 1, Result::kAtBoth);
  EXPECT_EQ(found.status, ContactStatus::kContact);
  EXPECT_EQ(found.limited_by, BracketLimit::kNone);
  EXPECT_LE(found.begin.width(), 1e-12);
  EXPECT_LE(found.end.width(), 1e-12);
}

// A bar's corners, one after the other, come up to a wall and no farther: the nearer, the slower.
TEST(ContactLimits, GrazingEndsWithABracketAndItsReason) {
  Body bar{shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1}))};
  bar.w = {0, 0, 1};
  const double reach = std::sqrt(2 * 2 + 0.1 * 0.1);
  const double first = kPi / 2 - std::atan2(0.1, 2), last = kPi - first;
  for (const double off : {-1e-9, 0.0, 1e-9}) {
    const Body wall{shape::Shape::Build(Box({-4, 0, -1}, {4, 1, 1})), 0, {0, reach + off, 0}};
    const TimeOfContactResult found = Find(bar, wall, 2, Result::kAtStart, {}, 2'000'000);
    if (off > 0) {
      EXPECT_EQ(found.status, ContactStatus::kFree);
      continue;
    }
    // √(2 · 1e-9 / 2) of a radian earlier they touch already.
    const double early = std::sqrt(-off);
    EXPECT_NEAR(found.begin.lower, first - early, 1e-6);
    EXPECT_NEAR(found.end.upper, last + early, 1e-6);
    EXPECT_EQ(found.status == ContactStatus::kContact, off < 0);
    if (off < 0) {
      EXPECT_LE(found.begin.width(), 1e-8);
    } else {
      EXPECT_EQ(found.limited_by, BracketLimit::kGeometry);
      EXPECT_LE(found.within, 1e-13);
    }
  }
}

Real TrueDistance(const Body& a, const Body& b, double t) {
  const auto at = [t](const Body& body) {
    TruePose pose;
    pose.p = body.p.cast<Real>() + t * body.v.cast<Real>();
    pose.q = Exponential(t * body.w.cast<Real>().eval()) * body.q.cast<Real>().normalized();
    return TrueBody(body.shape.get(), body.radius, pose);
  };
  return SolidDistance(at(a), at(b));
}

// A cube on a long arm and a ball beside it, as fast as it: only that circles bend inward brings
// them together.
TEST(ContactLimits, TheBendOfACircleCounts) {
  Body cube{shape::Shape::Build(Moved(Cube(0.125), {4, 0, 0}))};
  cube.w = {0, 0, 1};
  for (const double gap : {0.25, 1e-2, 1e-4}) {
    const Body ball{nullptr, 0.25, {4 - 0.375 - gap, 0.05, 0}, {0, 4, 0}};
    const TimeOfContactResult found = Find(cube, ball, 1);
    ASSERT_EQ(found.status, ContactStatus::kContact) << gap;
    EXPECT_LE(found.begin.width(), 1e-11) << gap;  // the last of it closes at 7 mm/s
    EXPECT_GT(TrueDistance(cube, ball, found.begin.lower - 1e-10), 0) << gap;
    EXPECT_EQ(TrueDistance(cube, ball, found.begin.upper + 1e-10), 0) << gap;
  }
}

// Stars that tumble: corners, edges and notches, none of them aligned.
TEST(ContactLimits, TumblingStars) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    Body a{shape::Shape::Build(Star(2, random))};
    Body b{seed % 2 == 0 ? UnitCube() : shape::Shape::Build(Star(2, random)), 0,
           4 * random.UnitVector()};
    b.v = -2 * (b.p + random.UnitVector()).normalized();
    a.w = 5 * random.UnitVector();
    b.w = random.Uniform(0, 20) * random.UnitVector();
    const TimeOfContactResult found = Find(a, b, 3);
    if (found.status == ContactStatus::kFree) continue;
    ASSERT_EQ(found.status, ContactStatus::kContact) << seed;
    EXPECT_EQ(found.limited_by, BracketLimit::kNone) << seed;
    EXPECT_LE(found.begin.width(), 1e-12 * found.begin.upper) << seed;
    // Just before they are apart, just after together, by the true distance.
    EXPECT_GT(TrueDistance(a, b, found.begin.lower - 1e-10), 0) << seed;
    EXPECT_EQ(TrueDistance(a, b, found.begin.upper + 1e-10), 0) << seed;
  }
}

}  // namespace
}  // namespace collision::narrow_phase
