// Goal:   the brackets of the closest approach contain the true one for every motion within the
//         bounds, whatever the work allowed; with enough work they are nearly as narrow as what is
//         known of the motion.
// Method: two balls on known lines and parabolas, in closed form or by a fine search in long
//         double; balls that deviate at random within their bounds; boxes that pass each other
//         parallel to their faces, and turning shapes of one ball off their reference point, whose
//         distance is that of two points.
#include "collision_core/narrow_phase/approach/closest_approach.h"

#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/support/random.h"

namespace collision::narrow_phase {
namespace {

constexpr double kDuration = 2;
constexpr double kInfinity = numeric::kInfinity;

ClosestApproach Search(const BodyPair& bodies, std::uint64_t units = kPlenty,
                       double beyond = kInfinity) {
  WorkBudget work(units);
  return FindClosestApproach(bodies.a, bodies.b, {.duration = kDuration, .beyond = beyond}, &work);
}

BodyPair Segments(const Body& a, const Body& b, Result states_at = Result::kAtStart) {
  return SegmentsOf(Known(a, kDuration, states_at), Known(b, kDuration, states_at), Instant());
}

struct TrueApproach {
  Real at, distance;
};

// The least of a distance with one or a few smooth minima: samples, then thirds about the least.
template <typename Distance>
TrueApproach LeastOf(const Distance& distance) {
  constexpr int kSamples = 2000;
  int least = 0;
  for (int i = 1; i <= kSamples; ++i) {
    if (distance(kDuration * i / Real(kSamples)) < distance(kDuration * least / Real(kSamples))) {
      least = i;
    }
  }
  Real from = kDuration * Real(std::max(0, least - 1)) / kSamples;
  Real to = kDuration * Real(std::min(kSamples, least + 1)) / kSamples;
  for (int i = 0; i < 100; ++i) {
    const Real x = from + (to - from) / 3, y = to - (to - from) / 3;
    (distance(x) < distance(y) ? to : from) = distance(x) < distance(y) ? y : x;
  }
  const Real at = (from + to) / 2;
  return {at, distance(at)};
}

constexpr Real kRounding = 1e-12L;

void ExpectContains(const ClosestApproach& found, const TrueApproach& truth, int round) {
  EXPECT_LE(found.distance.lower, truth.distance + kRounding) << round;
  EXPECT_GE(found.distance.upper, truth.distance - kRounding) << round;
  // Where the distance is flat the search of the truth finds the time to a few billionths only.
  EXPECT_LE(found.at.lower, truth.at + 1e-7L) << round;
  EXPECT_GE(found.at.upper, truth.at - 1e-7L) << round;
}

// A ball of a shape, off the reference point.
std::shared_ptr<const shape::Shape> BallAt(const Vector3d& centre, double radius) {
  shape::ConvexDescription ball;
  ball.rounding = radius;
  ball.p_BS = centre;
  return shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(ball)});
}

Body RandomBall(Random& random) {
  Body ball{nullptr, random.Uniform(0.1, 1)};
  ball.p = random.UnitVector() * random.Uniform(0, 20);
  ball.v = random.UnitVector() * random.Uniform(0, 20);
  return ball;
}

Vector Along(const Body& body, const Vector3d& a, Real t) {
  return body.p.cast<Real>() + t * body.v.cast<Real>() + t * t / 2 * a.cast<Real>();
}

TEST(ClosestApproach, IsNearlyExactForBallsOnKnownPaths) {
  Random random(1);
  for (int round = 0; round < 500; ++round) {
    const Body a = RandomBall(random), b = RandomBall(random);
    const Vector3d bend = round % 2 == 0 ? Vector3d::Zero().eval()
                                         : (random.UnitVector() * random.Uniform(0, 10)).eval();
    KnownMotion of_b = Known(b, kDuration, Result::kAtStart);
    of_b.last->state.a_WA = bend;
    const ClosestApproach found =
        Search(SegmentsOf(Known(a, kDuration, Result::kAtStart), of_b, Instant()));
    const TrueApproach truth = LeastOf([&](Real t) {
      return (Along(b, bend, t) - Along(a, Vector3d::Zero(), t)).norm() - a.radius - b.radius;
    });
    ExpectContains(found, truth, round);
    EXPECT_LE(found.distance.width(), 3e-6 * (1 + std::abs(static_cast<double>(truth.distance))))
        << round;
    EXPECT_LE(found.at.width(), 0.25) << round << ": those who are slow are near for long";
  }
}

TEST(ClosestApproach, ContainsThatOfEveryMotionWithinTheBounds) {
  Random random(2);
  for (int round = 0; round < 300; ++round) {
    Body a = RandomBall(random), b = RandomBall(random);
    a.acceleration_max = random.Uniform(0, 2);
    b.acceleration_max = random.Uniform(0, 2);
    const ClosestApproach found = Search(Segments(a, b));
    for (int motion = 0; motion < 10; ++motion) {
      const Vector3d of_a = random.UnitVector() * a.acceleration_max;
      const Vector3d of_b = random.UnitVector() * b.acceleration_max;
      const TrueApproach truth = LeastOf([&](Real t) {
        return (Along(b, of_b, t) - Along(a, of_a, t)).norm() - a.radius - b.radius;
      });
      ExpectContains(found, truth, round);
    }
    // Not much less than what is not known of the distance.
    const double unknown = 0.5 * (a.acceleration_max + b.acceleration_max);
    const TrueApproach nearest = LeastOf([&](Real t) {
      const Vector3d zero = Vector3d::Zero();
      return (Along(b, zero, t) - Along(a, zero, t)).norm() - a.radius - b.radius - unknown * t * t;
    });
    const double width = found.distance.upper - static_cast<double>(nearest.distance);
    EXPECT_GE(found.distance.lower, static_cast<double>(nearest.distance) - width / 4 - 1e-4);
  }
}

// 2 m apart in y from face to face, nearest for as long as the faces stand beside each other.
TEST(ClosestApproach, OfBoxesThatPassIsTheGapOfTheirFaces) {
  for (const Made made : {Made::kTriangles, Made::kSolid, Made::kHull, Made::kMixed}) {
    const Body a{CubeOf(made)}, b{CubeOf(Made::kSolid), 0, {-10, 3, 0}, {10, 0, 0}};
    const ClosestApproach found = Search(Segments(a, b));
    EXPECT_LE(found.distance.lower, 2);
    EXPECT_GE(found.distance.upper, 2);
    EXPECT_LE(found.distance.width(), 0.05);
    EXPECT_LE(found.at.lower, 0.9);
    EXPECT_GE(found.at.upper, 1.1);
    EXPECT_LE(found.at.width(), 0.4);
  }
}

TEST(ClosestApproach, OfTurningShapesIsThatOfTheirPoints) {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    const Vector3d off_a = random.UnitVector(), off_b = random.UnitVector();
    Body a = RandomBall(random), b = RandomBall(random);
    const double r_a = a.radius, r_b = b.radius;
    a.shape = BallAt(off_a, r_a);
    b.shape = BallAt(off_b, r_b);
    a.w = random.UnitVector() * random.Uniform(0, 3);
    b.w = random.UnitVector() * random.Uniform(0, 3);
    const auto point = [](const Body& body, const Vector3d& off, Real t) -> Vector {
      return Along(body, Vector3d::Zero(), t) +
             Exponential(t * body.w.cast<Real>()) * off.cast<Real>().eval();
    };
    const TrueApproach truth = LeastOf(
        [&](Real t) { return (point(b, off_b, t) - point(a, off_a, t)).norm() - r_a - r_b; });
    const ClosestApproach found = Search(Segments(a, b));
    EXPECT_LE(found.distance.lower, truth.distance + 1e-9L) << round;
    EXPECT_GE(found.distance.upper, std::min(Real(0), truth.distance) - 1e-9L) << round;
    if (truth.distance > 0) {
      ExpectContains(found, truth, round);
      EXPECT_LE(found.distance.width(), 0.03 * static_cast<double>(truth.distance) + 1e-6) << round;
    }
  }
}

// Each answer is certain, however early the search ends; and more work makes none wider.
TEST(ClosestApproach, IsCertainWithAnyWork) {
  Random random(4);
  for (int round = 0; round < 40; ++round) {
    const Body a = RandomBall(random), b = RandomBall(random);
    const TrueApproach truth = LeastOf([&](Real t) {
      return (Along(b, Vector3d::Zero(), t) - Along(a, Vector3d::Zero(), t)).norm() - a.radius -
             b.radius;
    });
    double width = kInfinity;
    for (std::uint64_t units = 0; units < 300; units += 7) {
      const ClosestApproach found = Search(Segments(a, b), units);
      ExpectContains(found, truth, round);
      EXPECT_LE(found.distance.width(), width) << round << " with " << units;
      width = found.distance.width();
    }
  }
}

TEST(ClosestApproach, DoesNotSearchWhatIsFartherThanAsked) {
  const Body a{nullptr, 1}, b{nullptr, 1, {-10, 12, 0}, {10, 0, 0}};
  WorkBudget work(kPlenty);
  const BodyPair bodies = Segments(a, b);
  const ClosestApproach found =
      FindClosestApproach(bodies.a, bodies.b, {.duration = kDuration, .beyond = 0.5}, &work);
  EXPECT_GT(found.distance.lower, 0.5);
  EXPECT_LT(work.spent(), 20u);
  const ClosestApproach nearer = Search(bodies, kPlenty, 11);
  EXPECT_LE(nearer.distance.lower, 10);
  EXPECT_GE(nearer.distance.upper, 10);
  EXPECT_LE(nearer.at.lower, 1);
  EXPECT_GE(nearer.at.upper, 1);
}

// Two that approach each other all the time, 3 m apart in the end.
TEST(ClosestApproach, AtAnEndTheTimeIsNarrowedOnlyWhereNoSegmentFollows) {
  const BodyPair bodies = Segments({nullptr, 1}, {nullptr, 1, {25, 0, 0}, {-10, 0, 0}});
  const auto search = [&](bool continued) {
    WorkBudget work(kPlenty);
    const ClosestApproach found = FindClosestApproach(
        bodies.a, bodies.b, {.duration = kDuration, .continued = continued}, &work);
    EXPECT_EQ(found.at.upper, kDuration);
    EXPECT_LE(found.distance.lower, 3);
    EXPECT_GE(found.distance.upper, 3);
    EXPECT_LE(found.distance.width(), 1e-5);
    return std::pair(found.at.width(), work.spent());
  };
  EXPECT_LE(search(false).first, kDuration / 128);
  EXPECT_LE(search(true).second, 4u);
}

TEST(ClosestApproach, OfAnAwaitedShapeIsOnlyBoundedByItsBall) {
  BodyPair bodies = Segments({nullptr, 1}, {nullptr, 1, {-10, 12, 0}, {10, 0, 0}});
  bodies.b.awaited = true;
  const ClosestApproach found = Search(bodies, 1000);
  EXPECT_LE(found.distance.lower, 10);
  EXPECT_GE(found.distance.lower, 9.9);
  EXPECT_EQ(found.distance.upper, kInfinity);
}

}  // namespace
}  // namespace collision::narrow_phase
