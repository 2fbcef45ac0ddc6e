// Goal:   contact that is over sooner than the tolerance asked for is found all the same, both
//         brackets as narrow as asked for; what passes by is free.
// Method: fast balls, cubes and bars with closed answers, in contact for a millisecond down to
//         nanoseconds, at tolerances up to the whole segment; also one brief contact after another,
//         and after a near miss.
#include "tests/collision_core/narrow_phase/contact_cases.h"

namespace collision::narrow_phase {
namespace {

constexpr ContactTolerance kTolerances[] = {{1, 0},    {0.1, 0},  {1e-3, 0},   {1e-5, 0},
                                            {1e-9, 0}, {0, 1e-3}, {1e-3, 1e-6}};

void ExpectAsAsked(numeric::Interval bracket, Real truth, const ContactTolerance& tolerance) {
  const double width = std::max(tolerance.absolute, tolerance.relative * bracket.upper);
  ExpectWithin(bracket, truth, (1 + 1e-9) * width / static_cast<double>(truth), "bracket");
}

// Both ends contain the truth and are as narrow as asked for, at every tolerance.
void ExpectBrief(const Body& a, const Body& b, double duration, Real begin, Real end) {
  for (const Result states_at : {Result::kAtStart, Result::kAtEnd, Result::kAtBoth}) {
    for (const ContactTolerance& tolerance : kTolerances) {
      for (const bool swapped : {false, true}) {
        const TimeOfContactResult found = swapped ? Find(b, a, duration, states_at, tolerance)
                                                  : Find(a, b, duration, states_at, tolerance);
        SCOPED_TRACE(testing::Message() << tolerance.absolute << ' ' << tolerance.relative);
        ASSERT_EQ(found.status, ContactStatus::kContact);
        EXPECT_EQ(found.limited_by, BracketLimit::kNone);
        EXPECT_EQ(found.within, 0);
        ExpectAsAsked(found.begin, begin, tolerance);
        ExpectAsAsked(found.end, end, tolerance);
        EXPECT_LE(found.begin.upper, found.end.lower);
      }
    }
  }
}

void ExpectFree(const Body& a, const Body& b, double duration) {
  for (const ContactTolerance& tolerance : kTolerances) {
    const TimeOfContactResult found = Find(a, b, duration, Result::kAtBoth, tolerance);
    EXPECT_EQ(found.status, ContactStatus::kFree) << tolerance.absolute;
  }
}

class BriefContactOf : public testing::TestWithParam<Made> {
 protected:
  std::shared_ptr<const shape::Shape> PlateOf(double half) const {
    return BoxOf(GetParam(), {-half, -1, -1}, {half, 1, 1});
  }
};

INSTANTIATE_TEST_SUITE_P(Made, BriefContactOf,
                         testing::Values(Made::kTriangles, Made::kSolid, Made::kHull, Made::kSolids,
                                         Made::kMixed));

TEST_P(BriefContactOf, BallThroughAThinPlate) {
  const Body ball{nullptr, 0.25, {-5000, 0.1, 0.2}, {10000, 0, 0}};
  for (const double half : {1e-6, 1e-3, 0.1}) {
    const Real reach = 0.25L + static_cast<Real>(half);
    ExpectBrief(ball, {PlateOf(half)}, 1, (5000 - reach) / 10000, (5000 + reach) / 10000);
  }
  ExpectFree(ball, {PlateOf(1e-3), 0, {0, 1.351, 0}}, 1);
}

TEST_P(BriefContactOf, CubesThatPassThroughEachOther) {
  const auto cube = CubeOf(GetParam());
  const Body a{cube, 0, {-4000, 0.9, 0.9}, {10000, 0, 0}};
  ExpectBrief(a, {cube}, 1, 0.3999L, 0.4001L);
  ExpectBrief(a, {UnitCube()}, 1, 0.3999L, 0.4001L);
  ExpectFree(a, {cube, 0, {0, -0.101, 0}}, 1);
}

// Past an edge, in it for a millisecond: r² − (r − d)² = (5e-4)².
TEST_P(BriefContactOf, BallThatGrazesAnEdge) {
  const Body cube{CubeOf(GetParam())};
  for (const double chord : {5e-4, 5e-6}) {
    const double deep = 0.25 - std::sqrt(0.0625 - chord * chord), slope = std::sqrt(0.5);
    const double off = 0.25 - deep;
    const Body ball{nullptr,
                    0.25,
                    {0.5 + off * slope - slope, 0.5 + off * slope + slope, 0},
                    {slope, -slope, 0}};
    const Real d = (static_cast<Real>(ball.p.x()) + ball.p.y() - 1) * std::sqrt(0.5L);
    const Real half = std::sqrt(0.0625L - d * d);
    const Real middle = (static_cast<Real>(ball.p.y()) - ball.p.x()) * std::sqrt(0.5L);
    const Real speed = static_cast<Real>(slope) * std::sqrt(2.0L);
    for (const ContactTolerance& tolerance : kTolerances) {
      const TimeOfContactResult found = Find(ball, cube, 2, Result::kAtStart, tolerance);
      ASSERT_EQ(found.status, ContactStatus::kContact) << tolerance.absolute;
      // Rounding moves the ends by its share of the depth.
      EXPECT_LE(found.begin.lower, (middle - half) / speed + 1e-11);
      EXPECT_GE(found.begin.upper, (middle - half) / speed - 1e-11);
      EXPECT_LE(found.end.lower, (middle + half) / speed + 1e-11);
      EXPECT_GE(found.end.upper, (middle + half) / speed - 1e-11);
      // The gap closes at 4 / s times the chord: 1e-14 m of it, what is rounded, take half a
      // nanosecond.
      if (tolerance.absolute == 1e-9 && chord < 1e-5) continue;
      EXPECT_EQ(found.limited_by, BracketLimit::kNone) << tolerance.absolute;
    }
  }
}

// A thin bar passes a small ball far out: for 2 (r + h) / (ω d) about.
TEST_P(BriefContactOf, BarThatSweepsPastABall) {
  Body bar{BoxOf(GetParam(), {-2, -1e-4, -1e-4}, {2, 1e-4, 1e-4})};
  bar.w = {0, 0, 3};
  const Real angle = std::asin(3e-4L / 1.5L);
  const Body ball{nullptr, 2e-4, {0, 1.5, 0}};
  ExpectBrief(bar, ball, 1, (M_PIl / 2 - angle) / 3, (M_PIl / 2 + angle) / 3);
  ExpectFree(bar, {nullptr, 2e-4, {0, 0, 0.5}}, 1);
}

// Two plates and a wall: the first contact is brief, the last one ends with the segment.
TEST(BriefContact, BeforeAContactThatLasts) {
  const Body ball{nullptr, 0.25, {-500, 0, 0}, {1000, 0, 0}};
  const geometry::TriangleMesh plates =
      Joined(Box({-1e-3, -1, -1}, {1e-3, 1, 1}), Box({99, -1, -1}, {99.001, 1, 1}));
  const Body scene{shape::Shape::Build(Joined(plates, Box({250, -1, -1}, {900, 1, 1})))};
  ExpectBrief(ball, scene, 1, 0.5L - 0.251e-3L, 1);
}

// The first and the last of many, each of them brief: plates in a row, and a bar that passes again
// and again.
TEST(BriefContact, OneAfterTheOther) {
  geometry::TriangleMesh plates;
  for (int i = 0; i < 40; ++i) {
    const double x = 10 * i;
    plates = Joined(plates, Box({x - 1e-3, -1, -1}, {x + 1e-3, 1, 1}));
  }
  const Body ball{nullptr, 0.25, {-5000, 0, 0}, {10000, 0, 0}};
  ExpectBrief(ball, {shape::Shape::Build(plates)}, 1, 0.5L - 0.251e-4L, 0.539L + 0.251e-4L);
  Body bar{shape::Shape::Build(Box({-2, -0.01, -0.01}, {2, 0.01, 0.01}))};
  bar.w = {0, 0, 200};
  const Real angle = std::asin(0.03L / 1.9L);
  const int passes = static_cast<int>(std::floor((200 - kPi / 2) / kPi));
  ExpectBrief(bar, {nullptr, 0.02, {0, 1.9, 0}}, 1, (M_PIl / 2 - angle) / 200,
              (M_PIl / 2 + passes * M_PIl + angle) / 200);
}

// Contact of open surfaces is certain where they cross.
TEST(BriefContact, OfOpenSurfaces) {
  const Body sheet{shape::Shape::Build(Sheet(1, 3))};
  const Body ball{nullptr, 0.25, {0.1, 0.2, 5000}, {0, 0, -10000}};
  ExpectBrief(sheet, ball, 1, 0.499975L, 0.500025L);
  Body across{shape::Shape::Build(Sheet(1, 2)), 0, {0.1, 0.2, 5000}, {0, 0, -10000}};
  across.q = Turn(90, {1, 0, 0});
  ExpectBrief(sheet, across, 1, 0.4999L, 0.5001L);
}

// It comes as near as a nanometre to one, then through another.
TEST(BriefContact, AfterNearMisses) {
  const Body ball{nullptr, 0.25, {-500, 0, 0}, {1000, 0, 0}};
  for (const double off : {1e-3, 1e-6, 1e-9}) {
    const geometry::TriangleMesh plates =
        Joined(Box({-100, 0.25 + off, -1}, {-99, 1, 1}), Box({99, 0.25 + off, -1}, {99.5, 1, 1}));
    const Body scene{shape::Shape::Build(Joined(plates, Box({10, -1, -1}, {10.002, 1, 1})))};
    ExpectBrief(ball, scene, 1, 0.50975L, 0.510252L);
  }
}

// It grazes one, touching by nothing for a while, which is neither free nor contact; the next one
// it meets for certain.
TEST(BriefContact, AfterATouchThatIsUndecided) {
  const Body ball{nullptr, 0.25, {-500, 0, 0}, {1000, 0, 0}};
  const geometry::TriangleMesh plates =
      Joined(Box({-300, 0.25, -1}, {-299, 1, 1}), Box({100, -1, -1}, {100.002, 1, 1}));
  const Body scene{shape::Shape::Build(plates)};
  for (const ContactTolerance& tolerance : kTolerances) {
    const TimeOfContactResult found = Find(ball, scene, 1, Result::kAtStart, tolerance);
    ASSERT_EQ(found.status, ContactStatus::kContact) << tolerance.absolute;
    EXPECT_LE(found.begin.lower, 0.2 + 1e-12);
    EXPECT_GE(found.begin.upper, 0.59975 - 1e-12);
    EXPECT_LE(found.begin.upper, 0.600252 + 1e-12);
    ExpectAsAsked(found.end, 0.600252L, tolerance);
  }
}

// A fifth of a nanosecond.
TEST_P(BriefContactOf, AsBriefAsCanBe) {
  const Body ball{nullptr, 1e-3, {-5e6, 0.1, 0.2}, {1e7, 0, 0}};
  ExpectBrief(ball, {PlateOf(1e-6)}, 1, 0.5L - 1.001e-10L, 0.5L + 1.001e-10L);
}

// Over at once, or just begun.
TEST_P(BriefContactOf, AtTheEndsOfTheSegment) {
  const Body plate{PlateOf(1e-3)};
  for (const ContactTolerance& tolerance : kTolerances) {
    const Body leaving{nullptr, 0.25, {0.25, 0, 0}, {100, 0, 0}};
    const TimeOfContactResult found = Find(leaving, plate, 1, Result::kAtBoth, tolerance);
    ASSERT_EQ(found.status, ContactStatus::kContact);
    EXPECT_EQ(found.begin.upper, 0);
    EXPECT_LE(found.end.lower, 1e-5 * (1 + 1e-9));
    EXPECT_GE(found.end.upper, 1e-5 * (1 - 1e-9));
    EXPECT_EQ(found.limited_by, BracketLimit::kNone);
    const Body coming{nullptr, 0.25, {-100.25, 0, 0}, {100, 0, 0}};
    const TimeOfContactResult last = Find(coming, plate, 1, Result::kAtBoth, tolerance);
    ASSERT_EQ(last.status, ContactStatus::kContact);
    EXPECT_LE(last.begin.lower, 1 - 1e-5 * (1 - 1e-9));
    EXPECT_GE(last.begin.upper, 1 - 1e-5 * (1 + 1e-9));
    EXPECT_EQ(last.end.lower, 1);
    EXPECT_EQ(last.limited_by, BracketLimit::kNone);
  }
}

// Stars that tumble past each other, with and without something unknown of their motion: what is
// found at the finest tolerance is found at all of them, at less than its cost but where the motion
// limits it.
TEST(BriefContact, FoundWheneverAFinerToleranceFindsIt) {
  int contacts = 0, frees = 0, unknown = 0;
  std::uint64_t finest = 0, coarsest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Body a{shape::Shape::Build(Star(2, random))};
    Body b{seed % 2 == 0 ? UnitCube() : shape::Shape::Build(Star(2, random))};
    if (seed % 5 == 0) b = {nullptr, 0.3};
    const double speed = random.LogUniform(10, 1e4);
    b.v = speed * random.UnitVector();
    b.p = -0.5 * b.v + random.Uniform(0.3, 4) * b.v.unitOrthogonal();
    a.w = random.LogUniform(0.1, 20) * random.UnitVector();
    b.w = random.LogUniform(0.1, 20) * random.UnitVector();
    if (seed % 3 == 0) a.acceleration_max = b.acceleration_max = random.LogUniform(1e-9, 1e-2);
    const TimeOfContactResult best = Find(a, b, 1);
    contacts += best.status == ContactStatus::kContact;
    frees += best.status == ContactStatus::kFree;
    unknown += best.limited_by == BracketLimit::kMotion;
    for (const ContactTolerance& tolerance : kTolerances) {
      const TimeOfContactResult found = Find(a, b, 1, Result::kAtStart, tolerance);
      EXPECT_EQ(found.status, best.status) << tolerance.absolute;
      if (best.status != ContactStatus::kContact) continue;
      EXPECT_LE(found.begin.lower, best.begin.upper);
      EXPECT_GE(found.begin.upper, best.begin.lower);
      EXPECT_LE(found.end.lower, best.end.upper);
      EXPECT_GE(found.end.upper, best.end.lower);
      if (best.limited_by == BracketLimit::kNone) {
        EXPECT_EQ(found.limited_by, BracketLimit::kNone);
      }
      finest += best.work;
      coarsest += found.work;
      EXPECT_LT(found.work, 4 * best.work);
    }
  }
  EXPECT_GT(contacts, 40);
  EXPECT_GT(frees, 20);
  EXPECT_GT(unknown, 10);
  EXPECT_LT(coarsest, finest);
}

}  // namespace
}  // namespace collision::narrow_phase
