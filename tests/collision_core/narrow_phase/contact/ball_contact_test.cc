#include "collision_core/narrow_phase/contact/ball_contact.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/support/random.h"

namespace collision::narrow_phase {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

motion::SpaceTimeBound Bound(std::int64_t ns, const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                             double radius, double acceleration_max) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(ns);
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

/// Between two known states, seen from the first.
BallSegment Between(const motion::SpaceTimeBound& from, const motion::SpaceTimeBound& to) {
  return {from.limits.radius,
          {ForwardBall(from, from.state.stamp), BackwardBall(to, from.state.stamp)}};
}

/// A motion of pieces of constant acceleration, |a| <= M.
struct Motion {
  static constexpr int kPieces = 4;
  double duration;
  Eigen::Vector3d p[kPieces + 1], v[kPieces + 1], a[kPieces];

  Motion(Random& random, const Eigen::Vector3d& p0, const Eigen::Vector3d& v0,
         double acceleration_max, double length,
         const Eigen::Vector3d& known = Eigen::Vector3d::Zero())
      : duration(length) {
    const double dt = duration / kPieces;
    p[0] = p0, v[0] = v0;
    for (int i = 0; i < kPieces; ++i) {
      a[i] = known + acceleration_max * (1 - 1e-9) * random.UnitVector();
      p[i + 1] = p[i] + dt * v[i] + 0.5 * dt * dt * a[i];
      v[i + 1] = v[i] + dt * a[i];
    }
  }

  Eigen::Vector3d At(double t) const {
    const double dt = duration / kPieces;
    const int i = std::min(kPieces - 1, static_cast<int>(t / dt));
    const double s = t - i * dt;
    return p[i] + s * v[i] + 0.5 * s * s * a[i];
  }
};

// Goal:   the brackets of the scene's two satellites are as narrow as the project promises.
// Method: their states at 599 s and 600 s. The spheres meet at 599.734303 s and part at 599.857266
//         s.
TEST(EvaluateBallSegment, IridiumAndCosmos) {
  const auto bound = [](std::int64_t s, Eigen::Vector3d p, Eigen::Vector3d v) {
    return Bound(s * kSecond, p, v, 500, 7.9);
  };
  const BallSegment iridium = Between(bound(599, {-1461167.894963, 1588343.591612, 6813639.879114},
                                            {-6997.162692641, -2452.373365010, -926.768268524}),
                                      bound(600, {-1468164.258886, 1585890.355353, 6812709.402926},
                                            {-6995.570957019, -2454.098181711, -934.191656532}));
  const BallSegment cosmos = Between(bound(599, {-1469851.386510, 1590661.925891, 6811269.616099},
                                           {3587.992786106, -6164.283214372, 2209.219051206}),
                                     bound(600, {-1466262.594448, 1584496.775750, 6813475.124589},
                                           {3589.588165870, -6166.008478261, 2201.796662406}));
  const SegmentResult verdict = EvaluateBallSegment(iridium, cosmos, 1);
  constexpr double kBegin = 0.734303, kEnd = 0.857266, kGivenTo = 0.5e-6;
  EXPECT_LE(verdict.free_until, kBegin + kGivenTo);
  EXPECT_GE(verdict.contact_from, kBegin - kGivenTo);
  EXPECT_LT(verdict.contact_from - verdict.free_until, 0.2e-3);
  EXPECT_GE(verdict.free_from, kEnd - kGivenTo);
  EXPECT_LE(verdict.contact_to, kEnd + kGivenTo);
  EXPECT_LT(verdict.free_from - verdict.contact_to, 0.1e-3);
  EXPECT_TRUE(verdict.contact_continuous);
}

// Goal:   with gravity known the brackets are fifty times as narrow: the known accelerations of
// both
//         nearly cancel, and little is left unknown.
// Method: as above; gravity at the states, as −μ p / |p|³, with J = 9e-3 m/s³, and D = 0.05 m/s²
// for
//         what the ellipsoid of the Earth adds.
TEST(EvaluateBallSegment, IridiumAndCosmosUnderKnownGravity) {
  const auto bound = [](std::int64_t s, Eigen::Vector3d p, Eigen::Vector3d v, double known) {
    motion::SpaceTimeBound of = Bound(s * kSecond, p, v, 500, known > 0 ? 0.05 : 7.9);
    const double r = p.norm();
    of.state.a_WA = -known * 3.986004418e14 / (r * r * r) * p;
    of.limits.jerk_max = known * 9e-3;
    return of;
  };
  const auto width = [&](double known) {
    const BallSegment iridium =
        Between(bound(599, {-1461167.894963, 1588343.591612, 6813639.879114},
                      {-6997.162692641, -2452.373365010, -926.768268524}, known),
                bound(600, {-1468164.258886, 1585890.355353, 6812709.402926},
                      {-6995.570957019, -2454.098181711, -934.191656532}, known));
    const BallSegment cosmos =
        Between(bound(599, {-1469851.386510, 1590661.925891, 6811269.616099},
                      {3587.992786106, -6164.283214372, 2209.219051206}, known),
                bound(600, {-1466262.594448, 1584496.775750, 6813475.124589},
                      {3589.588165870, -6166.008478261, 2201.796662406}, known));
    const SegmentResult verdict = EvaluateBallSegment(iridium, cosmos, 1);
    constexpr double kBegin = 0.734303, kEnd = 0.857266, kGivenTo = 0.5e-6;
    EXPECT_LE(verdict.free_until, kBegin + kGivenTo);
    EXPECT_GE(verdict.contact_from, kBegin - kGivenTo);
    EXPECT_GE(verdict.free_from, kEnd - kGivenTo);
    EXPECT_LE(verdict.contact_to, kEnd + kGivenTo);
    EXPECT_TRUE(verdict.contact_continuous);
    return (verdict.contact_from - verdict.free_until) + (verdict.free_from - verdict.contact_to);
  };
  EXPECT_LT(width(1), 0.02 * width(0));
}

// Goal:   a ball that falls through one that stands: contact is certified throughout although the
//         path bends, as narrowly as for one that keeps its velocity.
TEST(EvaluateBallSegment, AFallIsCertifiedThroughout) {
  motion::SpaceTimeBound stands = Bound(0, {0, 0, 0}, {0, 0, 0}, 0.5, 0);
  motion::SpaceTimeBound falls = Bound(0, {0, 0, 5}, {0, 0, 0}, 0.5, 0);
  falls.state.a_WA = {0, 0, -9.8};
  const BallSegment of_A = {0.5, {ForwardBall(stands, Instant())}};
  const BallSegment of_B = {0.5, {ForwardBall(falls, Instant())}};
  const SegmentResult verdict = EvaluateBallSegment(of_A, of_B, 2);
  const double begin = std::sqrt(8 / 9.8), end = std::sqrt(12 / 9.8);
  EXPECT_LE(verdict.free_until, begin);
  EXPECT_GE(verdict.contact_from, begin);
  EXPECT_LT(verdict.contact_from - verdict.free_until, 1e-9);
  EXPECT_GE(verdict.free_from, end);
  EXPECT_LE(verdict.contact_to, end);
  EXPECT_LT(verdict.free_from - verdict.contact_to, 1e-9);
  EXPECT_TRUE(verdict.contact_continuous);
}

// Goal:   a path that leaves the contact and comes back is not certified throughout.
// Method: thrown up through a ball's edge: inside at both ends of the second, 0.4 m out between.
TEST(EvaluateBallSegment, ABentPathThatLeavesIsSeen) {
  motion::SpaceTimeBound stands = Bound(0, {0, 0, 0}, {0, 0, 0}, 0.5, 0);
  motion::SpaceTimeBound thrown = Bound(0, {0, 0, 0.9}, {0, 0, 2}, 0.5, 0);
  thrown.state.a_WA = {0, 0, -4};
  const BallSegment of_A = {0.5, {ForwardBall(stands, Instant())}};
  const BallSegment of_B = {0.5, {ForwardBall(thrown, Instant())}};
  const SegmentResult verdict = EvaluateBallSegment(of_A, of_B, 1);
  EXPECT_EQ(verdict.contact_from, 0);
  EXPECT_EQ(verdict.contact_to, 1);
  EXPECT_FALSE(verdict.contact_continuous);
}

// Goal:   no claim is false for any motion, and claims are made: contact, freedom before, freedom
//         after.
// Method: random pieces of full acceleration between exact states, half of them around one that is
//         known; the verdict against the sampled motion.
TEST(EvaluateBallSegment, ClaimsHoldForRandomMotions) {
  Random random(71);
  int contacts = 0, frees = 0, partly = 0;
  for (int i = 0; i < 5000; ++i) {
    const double T = random.LogUniform(0.1, 2),
                 M = random.Chance(0.2) ? 0 : random.LogUniform(0.01, 2);
    const auto known = [&]() -> Eigen::Vector3d {
      if (random.Chance(0.5)) return {0, 0, 0};
      return random.LogUniform(0.1, 10) * random.UnitVector();
    };
    const Eigen::Vector3d known_A = known(), known_B = known();
    const auto motion = [&](const Eigen::Vector3d& of) {
      return Motion(random, 3 * random.Uniform(0, 1) * random.UnitVector(),
                    random.LogUniform(0.1, 10) * random.UnitVector(), M, T, of);
    };
    const Motion a = motion(known_A), b = motion(known_B);
    const auto segment = [&](const Motion& m, double radius, const Eigen::Vector3d& of) {
      const auto ns = static_cast<std::int64_t>(std::ceil(T * 1e9));
      motion::SpaceTimeBound from = Bound(0, m.p[0], m.v[0], radius, M);
      motion::SpaceTimeBound to =
          Bound(ns, m.At(static_cast<double>(ns) / 1e9), m.v[Motion::kPieces], radius, M);
      // What this test's own rounding costs, and the last piece runs on for less than a nanosecond.
      for (motion::SpaceTimeBound* bound : {&from, &to}) {
        bound->state.position_error = 1e-12;
        bound->state.velocity_error = 1e-8;
        bound->state.a_WA = of;
      }
      return Between(from, to);
    };
    const double radii[2] = {random.Uniform(0, 1), random.Uniform(0, 1)};
    const SegmentResult verdict =
        EvaluateBallSegment(segment(a, radii[0], known_A), segment(b, radii[1], known_B), T);
    contacts += verdict.contact_from <= verdict.contact_to;
    frees += verdict.free_until == numeric::kInfinity;
    partly += verdict.free_until > 0 && verdict.contact_from <= verdict.contact_to;
    ASSERT_EQ(verdict.free_until == numeric::kInfinity, verdict.free_from == -numeric::kInfinity);
    const auto separation = [&](double t) {
      return (b.At(t) - a.At(t)).norm() - radii[0] - radii[1];
    };
    for (int sample = 0; sample <= 200; ++sample) {
      const double t = std::min(T, T * sample / 200);
      if (t < verdict.free_until || t > verdict.free_from) {
        ASSERT_GT(separation(t), 0) << i << ": " << t;
      }
      if (verdict.contact_continuous && verdict.contact_from <= t && t <= verdict.contact_to) {
        ASSERT_LE(separation(t), 0) << t;
      }
    }
    if (verdict.contact_from <= verdict.contact_to) {
      ASSERT_LE(separation(verdict.contact_from), 0);
      ASSERT_LE(separation(verdict.contact_to), 0);
    }
  }
  EXPECT_GT(contacts, 500);
  EXPECT_GT(frees, 500);
  EXPECT_GT(partly, 100);
}

// Goal:   brackets are as narrow as the bounds allow: about M T²/8 per agent over the closing
//         speed.
// Method: two that glide through each other uniformly while M would allow more; begin and end at
//         mid-way.
TEST(EvaluateBallSegment, BracketsAreNarrow) {
  const double M = 0.5, speed = 4;
  const auto glide = [&](double x0, double v, double radius) {
    return Between(Bound(0, {x0, 0, 0}, {v, 0, 0}, radius, M),
                   Bound(kSecond, {x0 + v, 0, 0}, {v, 0, 0}, radius, M));
  };
  // Begin at mid-way: the gap of 2 m closes at 4 m/s.
  const SegmentResult begin = EvaluateBallSegment(glide(0, speed, 1), glide(4, 0, 1), 1);
  const double width = 2 * (M / 8) / speed;
  EXPECT_LE(begin.free_until, 0.5);
  EXPECT_GE(begin.free_until, 0.5 - 1.05 * width);
  EXPECT_GE(begin.contact_from, 0.5);
  EXPECT_LE(begin.contact_from, 0.5 + 1.05 * width);
  EXPECT_EQ(begin.contact_to, 1);
  EXPECT_EQ(begin.free_from, 1);
  const SegmentResult end = EvaluateBallSegment(glide(0, -speed, 1), glide(0, 0, 1), 1);
  EXPECT_EQ(end.free_until, 0);
  EXPECT_EQ(end.contact_from, 0);
  EXPECT_LE(end.contact_to, 0.5);
  EXPECT_GE(end.contact_to, 0.5 - 1.05 * width);
  EXPECT_GE(end.free_from, 0.5);
  EXPECT_LE(end.free_from, 0.5 + 1.05 * width);
}

// Goal:   freedom that one choice of bounds certifies at the start and another at the end covers
//         the whole.
// Method: at rest at 1 m, u = ½Mτ² each: apart only before 0.7 s forward and after 0.3 s backward.
TEST(EvaluateBallSegment, ChoicesExtendEachOther) {
  const auto rest = [](double x) {
    return Between(Bound(0, {x, 0, 0}, {0, 0, 0}, 0, 2),
                   Bound(kSecond, {x, 0, 0}, {0, 0, 0}, 0, 2));
  };
  EXPECT_EQ(EvaluateBallSegment(rest(0), rest(1), 1).free_until, numeric::kInfinity);
  BallSegment forward = rest(0), other = rest(1);
  forward.bounds.pop_back();
  other.bounds.pop_back();
  EXPECT_NEAR(EvaluateBallSegment(forward, other, 1).free_until, std::sqrt(0.5), 1e-9);
}

// Goal:   contact at both ends with a middle that is not certified is said to be not continuous; at
//         the exact values of the bounds.
// Method: 0.8 m deep at rest, M = 8: each u reaches 1 m mid-way, and only 0.16 m are needed to
//         leave.
TEST(EvaluateBallSegment, ContactThatMayBreakIsNotContinuous) {
  const auto rest = [](double x) {
    return Between(Bound(0, {x, 0, 0}, {0, 0, 0}, 0.5, 8),
                   Bound(kSecond, {x, 0, 0}, {0, 0, 0}, 0.5, 8));
  };
  const SegmentResult verdict = EvaluateBallSegment(rest(0), rest(0.2), 1);
  EXPECT_EQ(verdict.contact_from, 0);
  EXPECT_EQ(verdict.contact_to, 1);
  EXPECT_FALSE(verdict.contact_continuous);
}

// Goal:   a segment of no duration and a segment with nothing known are defined.
TEST(EvaluateBallSegment, InstantAndUnknown) {
  const auto point = [](double x) {
    return BallSegment{1, {ForwardBall(Bound(0, {x, 0, 0}, {1, 0, 0}, 1, 3), Instant())}};
  };
  const SegmentResult touching = EvaluateBallSegment(point(0), point(1.5), 0);
  EXPECT_EQ(touching.contact_from, 0);
  EXPECT_EQ(touching.contact_to, 0);
  EXPECT_LT(touching.free_until, 0);
  EXPECT_EQ(touching.free_from, 0);
  const SegmentResult apart = EvaluateBallSegment(point(0), point(2.5), 0);
  EXPECT_GT(apart.contact_from, apart.contact_to);
  EXPECT_EQ(apart.free_until, numeric::kInfinity);
  EXPECT_EQ(apart.free_from, -numeric::kInfinity);
  const SegmentResult unknown = EvaluateBallSegment({1, {}}, point(5), 1);
  EXPECT_GT(unknown.contact_from, unknown.contact_to);
  EXPECT_EQ(unknown.free_until, 0);
  EXPECT_EQ(unknown.free_from, 1);
}

// Goal:   what a glance tells is what EvaluateBallSegment() tells, bit for bit, and bodies that
//         rest in each other are decided at a glance.
// Method: random pairs near each other, from hard touching to far apart, with one bound of each or
//         two, true to each other or not; scales from 1e-12 to 1e12, offsets of 1e9 sizes.
TEST(QuickBallContact, IsWhatTheFullRoutineTells) {
  Random random(5);
  int decided = 0, deep = 0;
  for (int i = 0; i < 100000; ++i) {
    const double size = random.LogUniform(1e-12, 1e12), T = random.LogUniform(1e-9, 10);
    const Eigen::Vector3d offset = random.Chance(0.3)
                                       ? Eigen::Vector3d(random.UnitVector() * size * 1e9)
                                       : Eigen::Vector3d::Zero();
    const auto ns = std::max<std::int64_t>(1, std::llround(T * 1e9));
    const double seconds = static_cast<double>(ns) * 1e-9;
    // Depths from nothing to all, in parts of the size; and how much of it motion and doubt may be.
    const double depth = random.Chance(0.3) ? 0 : random.LogUniform(1e-16, 2);
    const double motion = random.Chance(0.3) ? 0 : random.LogUniform(1e-6, 1) * size;
    const double radii[2] = {size * random.Uniform(0, 1), size};
    const auto body = [&](bool second) {
      Eigen::Vector3d p = offset;
      if (second) p += random.UnitVector() * (radii[0] + radii[1]) * std::abs(1 - depth);
      const Eigen::Vector3d v = random.UnitVector() * (motion / seconds) * random.Uniform(0, 1);
      const double M = random.Chance(0.3) ? 0 : motion / (seconds * seconds) * random.Uniform(0, 1);
      motion::SpaceTimeBound from = Bound(0, p, v, radii[second], M);
      motion::SpaceTimeBound to = Bound(ns, p + seconds * v, v, radii[second], M);
      if (random.Chance(0.1)) to.state.p_WA += random.UnitVector() * size * random.Uniform(0, 3);
      if (random.Chance(0.3)) from.state.position_error = motion * random.Uniform(0, 0.5);
      BallSegment segment = Between(from, to);
      if (random.Chance(0.5)) segment.bounds.pop_back();
      if (random.Chance(0.02)) segment.bounds.clear();
      return segment;
    };
    const BallSegment a = body(false), b = body(true);
    const double duration = random.Chance(0.02) ? 0 : seconds;
    const SegmentResult full = EvaluateBallSegment(a, b, duration);
    const std::optional<SegmentResult> glance = QuickBallContact(a, b, duration);
    deep += full.free_until == 0 && full.free_from == duration && full.contact_from == 0 &&
            full.contact_to == duration && full.contact_continuous;
    if (!glance) continue;
    ++decided;
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    ASSERT_EQ(bits(glance->free_until), bits(full.free_until)) << i;
    ASSERT_EQ(bits(glance->contact_from), bits(full.contact_from)) << i;
    ASSERT_EQ(bits(glance->contact_to), bits(full.contact_to)) << i;
    ASSERT_EQ(bits(glance->free_from), bits(full.free_from)) << i;
    ASSERT_EQ(glance->contact_continuous, full.contact_continuous) << i;
  }
  EXPECT_GT(decided, 20000);
  // The others touch by a hair, or one of their bounds is far from the other.
  EXPECT_GT(decided, 0.8 * deep);
}

// Goal:   the separation at an instant is the best that all bounds together allow.
// Method: mid-way of 1 s with M = 8: u = 1 each; 10 m apart, radii 1: 8 ± 2. A breach crosses the
//         bounds.
TEST(EvaluateBallsAt, BestOverTheBounds) {
  const auto rest = [](double x, double then) {
    return Between(Bound(0, {x, 0, 0}, {0, 0, 0}, 1, 8),
                   Bound(kSecond, {then, 0, 0}, {0, 0, 0}, 1, 8));
  };
  const SeparationAt middle = EvaluateBallsAt(rest(0, 0), rest(10, 10), 0.5);
  EXPECT_NEAR(middle.separation.lower, 6, 1e-12);
  EXPECT_NEAR(middle.separation.upper, 10, 1e-12);
  EXPECT_EQ(middle.p_WB.x(), 10);
  EXPECT_NEAR(middle.error_B, 1, 1e-12);
  const SeparationAt early = EvaluateBallsAt(rest(0, 0), rest(10, 10), 0.25);
  EXPECT_NEAR(early.error_A, 0.25, 1e-12);
  EXPECT_NEAR(early.separation.lower, 7.5, 1e-12);
  const SeparationAt breach = EvaluateBallsAt(rest(0, 0), rest(10, 20), 0.5);
  EXPECT_GT(breach.separation.lower, breach.separation.upper);
}

// Goal:   contact is found where squares of speeds would underflow.
// Method: head on, the radii a millionth of the way, from 1e-250 m down to the denormals; contact
//         is half-way.
TEST(EvaluateBallSegment, ContactIsFoundAtSpeedsWhoseSquaresUnderflow) {
  for (const double unit : {1e-250, 1e-300, 1e-310}) {
    motion::SpaceTimeBound a, b;
    a.limits.radius = 1e-6 * unit;
    b.state.p_WA = {-unit, 0, 0};
    b.state.v_WA = {unit, 0, 0};
    const SegmentResult verdict = EvaluateBallSegment(
        {a.limits.radius, {ForwardBall(a, Instant())}}, {0, {ForwardBall(b, Instant())}}, 2);
    EXPECT_LE(verdict.contact_from, 1) << unit;
    EXPECT_GE(verdict.contact_to, 1) << unit;
    EXPECT_LE(verdict.contact_from - verdict.free_until, 1e-7) << unit;
  }
}

}  // namespace
}  // namespace collision::narrow_phase
