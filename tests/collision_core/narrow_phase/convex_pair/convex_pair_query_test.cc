// The most frequent queries, whichever way they are answered: by the separating axis test, in
// closed form, by the quick search or by the full one.
#include "collision_core/narrow_phase/convex_pair/convex_pair_query.h"

#include <gtest/gtest.h>

#include <cstring>

#include "collision_core/narrow_phase/convex_pair/box_separating_axis.h"
#include "collision_core/narrow_phase/convex_pair/capsule_distance.h"
#include "collision_core/narrow_phase/convex_pair/gjk_small.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Verdict VerdictOf(const ConvexCase& c, const RelativePose& pose) {
  WorkBudget work(1000000);
  return DecideConvexPair(c.OfA(), c.OfB(), pose, &work);
}

Exact SquareOf(const ConvexCase& c) {
  return Square(NearestToZero(Difference(c.CornersA(), c.CornersB())));
}

/// What is said is true. Returns whether something was.
bool VerdictIsTrue(const ConvexCase& c, const RelativePose& pose, const Exact& square) {
  const Verdict verdict = VerdictOf(c, pose);
  const bool touch = square <= c.Rounding() * c.Rounding();
  EXPECT_FALSE(verdict == Verdict::kApart && touch);
  EXPECT_FALSE(verdict == Verdict::kTouching && !touch);
  return verdict != Verdict::kUndecided;
}

numeric::Interval SeparationOf(const ConvexCase& c, const ConvexQuery& query) {
  WorkBudget work(1000000);
  return SeparationOfConvexPair(c.OfA(), c.OfB(), c.pose(), query, &work);
}

/// The exact separation of the cores, less rounding, is contained; depths by their sign only.
void CheckContained(const ConvexCase& c, const ConvexQuery& query, const Exact& square) {
  const numeric::Interval found = SeparationOf(c, query);
  EXPECT_LE(found.lower, found.upper);
  EXPECT_TRUE(IsAtMost(found.lower, square, c.Rounding())) << found.lower;
  if (square > 0 || found.upper >= 0) {
    EXPECT_TRUE(IsAtLeast(found.upper, square, c.Rounding())) << found.upper;
  }
}

/// All of it, and brackets as narrow as asked for, or as the full search makes them.
void CheckAll(const ConvexCase& c, double gap_known) {
  const Exact square = SquareOf(c);
  const bool said = VerdictIsTrue(c, c.pose(), square);
  EXPECT_TRUE(said || gap_known <= 1e-11 * c.Size()) << gap_known;
  for (const double share : {0.0, 1e-6, 0.05}) {
    for (const ConvexGoal goal : {ConvexGoal::kDistance, ConvexGoal::kDepth}) {
      const ConvexQuery query{goal, share, 0};
      CheckContained(c, query, square);
      const numeric::Interval found = SeparationOf(c, query);
      const double least = std::max({0.0, found.lower, -found.upper});
      const double enough = std::max(2.5e-14 * c.Size(), share * least);
      if (goal == ConvexGoal::kDistance && found.upper <= 0) continue;
      EXPECT_LE(found.width(), std::max(enough, c.Ask(query).separation.width()));
    }
  }
  if (testing::Test::HasFailure()) FAIL();
}

// Goal:   yes or no and the bracket are true of any two solids of few faces, from far apart to deep
//         in each other, and as narrow as asked for.
// Method: exact rational arithmetic; any rotations; like and unlike sizes from 1e-4 to 1e6 m.
TEST(ConvexPairQuery, RandomPolytopes) {
  Random random(401);
  for (int i = 0; i < 200; ++i) {
    const double size = i % 2 ? 1 : random.LogUniform(1e-4, 1e6);
    const double other = i % 2 ? 1 : std::clamp(size * random.LogUniform(1e-3, 1e3), 1e-4, 1e6);
    ConvexCase c(RandomPolytope(random, size), RandomPolytope(random, other));
    c.Turn(RandomQuaternion(random),
           random.Uniform(0, 3) * std::max(size, other) * random.UnitVector());
    ASSERT_NO_FATAL_FAILURE(CheckAll(c, 0)) << i;
  }
}

// Goal:   likewise where next to nothing decides, so that every error has to be counted in.
// Method: moved along the shortest way until the two are a given gap apart, or as deep in each
//         other: down to what is nothing but rounding.
TEST(ConvexPairQuery, NearlyTouching) {
  Random random(402);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription a = RandomPolytope(random, 1), b = RandomPolytope(random, 1);
    if (i % 3 == 0) a = RandomBox(random, 1), b = RandomBox(random, 1);
    ConvexCase c(a, b);
    c.Turn(RandomQuaternion(random), 4 * random.UnitVector());
    const double gap = random.LogUniform(1e-17, 1e-2);
    c.MoveTo(i % 2 ? gap : -gap);
    ASSERT_NO_FATAL_FAILURE(CheckAll(c, gap)) << i << " " << gap;
  }
}

// Goal:   likewise of whatever coincides or degenerates, where gaps are exactly nothing.
// Method: measures and places of small whole numbers, turned by rotations that are exact in doubles
//         or by 3-4-5 ones.
TEST(ConvexPairQuery, LatticePolytopes) {
  Random random(403);
  const Quaterniond turns[] = {
      {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 1}, {2, 1, 0, 0}, {3, 0, 1, 0}};
  for (int i = 0; i < 800; ++i) {
    shape::ConvexDescription a = LatticePolytope(random), b = LatticePolytope(random);
    a.q_BS = turns[random.Below(5)];
    b.q_BS = turns[random.Below(5)];
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0},
           Vector3d(static_cast<double>(random.Below(7)), static_cast<double>(random.Below(3)), 0));
    ASSERT_NO_FATAL_FAILURE(CheckAll(c, 0)) << i;
  }
}

// Goal:   needles and plates, and boxes that are parallel but for rounding.
TEST(ConvexPairQuery, NeedlesAndParallels) {
  Random random(404);
  for (int i = 0; i < 240; ++i) {
    shape::ConvexDescription a = RandomBox(random, 1), b = RandomBox(random, 1);
    for (shape::ConvexDescription* d : {&a, &b}) {
      for (int axis = 0; axis < 3; ++axis) {
        if (i % 2 && random.Chance(0.5)) d->half[axis] *= random.LogUniform(1e-6, 1);
      }
    }
    if (i % 4 == 1) b.core = geometry::ConvexCore::kSegment, b.rounding = 0.01;
    if (i % 2 == 0) {
      a.q_BS = b.q_BS = {1, 0, 0, 0};
      b.q_BS.vec() = random.LogUniform(1e-17, 1e-3) * random.UnitVector();
    }
    ConvexCase c(a, b);
    c.Turn(i % 2 ? RandomQuaternion(random) : Quaterniond(1, 0, 0, 0), 3 * random.UnitVector());
    c.MoveTo((i % 3 - 1) * random.LogUniform(1e-16, 1));
    ASSERT_NO_FATAL_FAILURE(CheckAll(c, 0)) << i;
  }
}

// Goal:   far from both reference points only what the placement rounds is lost, but all of it is
//         counted in.
TEST(ConvexPairQuery, FarFromTheOrigin) {
  Random random(405);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription a = RandomPolytope(random, 1), b = RandomPolytope(random, 1);
    const Vector3d far = random.LogUniform(1, 9e6) * random.UnitVector();
    a.p_BS = far;
    b.p_BS = far + random.Uniform(0, 3) * random.UnitVector();
    ConvexCase c(a, b);
    c.Turn({1, 0, 0, 0}, {0, 0, 0});
    if (i % 2) c.MoveTo((i % 4 - 2) * random.LogUniform(1e-12, 1e-6));
    const Exact square = SquareOf(c);
    VerdictIsTrue(c, c.pose(), square);
    CheckContained(c, {ConvexGoal::kDistance, 1e-6, 0}, square);
    ASSERT_FALSE(HasFailure()) << i;
  }
}

/// Corners of g_0 s + g_1 t + g_2 u about a centre, exactly.
ExactPoints CornersOf(const Matrix3d& edges, const Vector3d& centre) {
  ExactPoints corners;
  for (int i = 0; i < 8; ++i) {
    ExactVector corner(centre);
    for (int k = 0; k < 3; ++k) {
      const ExactVector edge(Vector3d(edges.col(k)));
      corner = i >> k & 1 ? corner + edge : corner - edge;
    }
    corners.push_back(corner);
  }
  return corners;
}

// Goal:   the rounding of a glance at boxes is counted in where nothing else hides it.
// Method: edges and centres are what their doubles say; touching but for some units of rounding,
//         on faces and on edges; exact arithmetic.
TEST(ConvexPairQuery, BoxesAsTheyAreWritten) {
  Random random(409);
  int said = 0;
  for (int i = 0; i < 1000; ++i) {
    Matrix3d edges[2];
    for (Matrix3d& m : edges) {
      m = RandomQuaternion(random).normalized().toRotationMatrix();
      for (int k = 0; k < 3; ++k) m.col(k) *= random.Uniform(0.1, 1);
    }
    geometry::ConvexSet a, b;
    a.core = b.core = geometry::ConvexCore::kBox;
    a.generators = edges[0], b.generators = edges[1];
    a.span = b.span = 3;
    b.centre = 2 * random.UnitVector();
    for (int step = 0; step < 3; ++step) {
      WorkBudget work(1000000);
      geometry::GjkHint hint;
      const ConvexSeparation found = collision::narrow_phase::SeparationOf(a, b, {}, &hint, &work);
      const double gap = random.Uniform(-1, 1) * (i % 2 ? 4e-16 : 4e-14);
      b.centre += (gap - found.separation.middle()) * found.normal;
    }
    const Matrix3d still = Matrix3d::Identity();
    const BoxPair pair{a.generators.data(),
                       b.generators.data(),
                       still.data(),
                       {b.centre.x(), b.centre.y(), b.centre.z()},
                       3,
                       3,
                       b.centre.norm() + 6.1,
                       0,
                       0};
    const BoxSeparation glance = TestSeparatingAxes(pair);
    if (glance == BoxSeparation::kUnknown) continue;
    ++said;
    const Exact square = Square(NearestToZero(
        Difference(CornersOf(edges[0], Vector3d::Zero()), CornersOf(edges[1], b.centre))));
    ASSERT_EQ(square > 0, glance == BoxSeparation::kApart) << i;
  }
  EXPECT_GT(said, 50);
}

// Goal:   likewise of what the closed forms and the quick search say of cores, before anything else
//         is counted in.
TEST(ConvexPairQuery, CoresAsTheyAreWritten) {
  Random random(411);
  for (int i = 0; i < 300; ++i) {
    geometry::ConvexSet a, b;
    for (geometry::ConvexSet* set : {&a, &b}) {
      set->core = geometry::ConvexCore::kBox;
      set->generators = RandomQuaternion(random).normalized().toRotationMatrix();
      for (int k = 0; k < 3; ++k) set->generators.col(k) *= random.Uniform(0.1, 1);
      set->span = 3;
    }
    b.centre = random.Uniform(1, 4) * random.UnitVector();
    if (i % 2) a.core = geometry::ConvexCore::kSegment, a.generators.rightCols<2>().setZero();
    SmallGjkPair pair{};
    pair.a.edges = i % 2 ? 1 : 3, pair.b.edges = 3;
    std::memcpy(pair.a.axes, a.generators.data(), sizeof(pair.a.axes));
    std::memcpy(pair.b.axes, b.generators.data(), sizeof(pair.b.axes));
    for (int k = 0; k < 3; ++k) pair.d[k] = b.centre[k];
    pair.size = b.centre.cwiseAbs().sum() + 6.1;
    pair.apart = pair.inside = numeric::kInfinity, pair.near = -numeric::kInfinity;
    const Exact square = Square(NearestToZero(
        Difference(CornersOf(a.generators, a.centre), CornersOf(b.generators, b.centre))));
    const auto check = [&](double lower, double upper) {
      EXPECT_TRUE(lower <= 0 || Exact(lower) * Exact(lower) <= square) << i;
      EXPECT_GE(Exact(upper) * Exact(upper), square) << i;
    };
    const SmallGjkResult quick = RunSmallGjk(pair);
    check(quick.lower, quick.upper);
    if (i % 2) {
      const RelativePose pose;
      const numeric::Interval thin = DistanceOfCores(a, b, PosedCores(a, b, pose), pose);
      check(thin.lower, thin.upper);
    }
  }
}

// Goal:   likewise of the closed forms and the quick search: what they tell of sets that are
//         exactly what they say, at a pose that is exact.
TEST(ConvexPairQuery, SetsAsTheyAreWritten) {
  Random random(410);
  for (int i = 0; i < 600; ++i) {
    shape::ConvexDescription a = RandomBox(random, 1), b = RandomHull(random, 1, 5);
    if (i % 3 == 1) b = RandomBox(random, 1), b.core = geometry::ConvexCore::kSegment;
    if (i % 3 == 2) b = RandomBox(random, 1);
    a.q_BS = b.q_BS = {1, 0, 0, 0};
    b.p_BS = 3 * random.UnitVector();
    for (Vector3d& p : b.points) p += b.p_BS;
    if (!b.points.empty()) b.p_BS.setZero();
    RelativePose pose;
    for (int step = 0; step < 3; ++step) {
      const shape::ConvexSolid solid_a = shape::ConvexSolid::Build(a),
                               solid_b = shape::ConvexSolid::Build(b);
      WorkBudget work(1000000);
      const Exact square = Square(NearestToZero(Difference(ExactCorners(a), ExactCorners(b))));
      const Verdict verdict = DecideConvexPair(solid_a.set(), solid_b.set(), pose, &work);
      ASSERT_FALSE(verdict == Verdict::kApart && square == 0) << i;
      ASSERT_FALSE(verdict == Verdict::kTouching && square > 0) << i;
      const ConvexQuery query{ConvexGoal::kDepth, 0, 0};
      const numeric::Interval found =
          SeparationOfConvexPair(solid_a.set(), solid_b.set(), pose, query, &work);
      ASSERT_TRUE(IsAtMost(found.lower, square, 0)) << i;
      ASSERT_TRUE(square == 0 || IsAtLeast(found.upper, square, 0)) << i;
      geometry::GjkHint hint;
      const ConvexSeparation at =
          collision::narrow_phase::SeparationOf(solid_a.set(), solid_b.set(), {}, &hint, &work);
      const Vector3d further = (random.Uniform(-1, 4) * 2e-16 - at.separation.middle()) * at.normal;
      for (Vector3d& p : b.points) p += further;
      if (b.points.empty()) b.p_BS += further;
    }
  }
}

// Goal:   what the pose is uncertain by, in place and turn of either body, is counted in.
// Method: queries at one pose with its uncertainty, held against the exact answer at another pose
//         within it; near to touching, where that matters.
TEST(ConvexPairQuery, UncertainPoses) {
  Random random(406);
  int said = 0;
  for (int i = 0; i < 240; ++i) {
    shape::ConvexDescription a = RandomPolytope(random, 1), b = RandomPolytope(random, 1);
    if (i % 2) a = RandomBox(random, 1), b = RandomBox(random, 1);
    const double angle = random.LogUniform(1e-6, 0.2);
    const Vector3d axis = random.UnitVector();
    Quaterniond turn(std::cos(angle / 2), 0, 0, 0);
    turn.vec() = std::sin(angle / 2) * axis;
    const Quaterniond q = RandomQuaternion(random).normalized();
    ConvexCase c(a, b);
    c.Turn(q, 4 * random.UnitVector());
    c.MoveTo(random.Uniform(-2, 2) * angle);
    const Vector3d offset = c.pose().p_AB;
    RelativePose uncertain = c.pose();
    const int kind = i % 3;
    if (kind == 0) uncertain.chord_B = 1.001 * angle, c.Turn(q * turn, offset);
    if (kind == 1) {
      uncertain.translation = 1.001 * angle;
      c.Turn(q, offset + angle * axis);
    }
    if (kind == 2) {
      uncertain.chord_A = 1.001 * angle;
      a.q_BS = turn * a.q_BS.normalized();
      a.p_BS = turn * a.p_BS;
      ConvexCase turned(a, b);
      turned.Turn(q, offset);
      said += VerdictIsTrue(c, uncertain, SquareOf(turned));
    } else {
      said += VerdictIsTrue(c, uncertain, SquareOf(c));
    }
    ASSERT_FALSE(HasFailure()) << i;
  }
  EXPECT_GT(said, 40);
}

// Goal:   a spent budget is noticed, and a pair that is decided at once costs little.
TEST(ConvexPairQuery, WorkBudget) {
  Random random(407);
  ConvexCase c(RandomBox(random, 1), RandomBox(random, 1));
  c.Turn(RandomQuaternion(random), {10, 0, 0});
  WorkBudget work(1000);
  EXPECT_EQ(DecideConvexPair(c.OfA(), c.OfB(), c.pose(), &work), Verdict::kApart);
  EXPECT_EQ(work.spent(), kSeparatingAxisUnits);
}

// Goal:   the kernels give the same bits on every processor.
TEST(ConvexPairQuery, KernelsAgree) {
  if (Avx2SeparatingAxisTest() == nullptr) return;  // Nothing to compare with.
  Random random(408);
  for (int i = 0; i < 3000; ++i) {
    double of_a[9], of_b[9], turn[9];
    for (int k = 0; k < 9; ++k) of_a[k] = of_b[k] = turn[k] = 0;
    for (int k = 0; k < 3; ++k) of_a[4 * k] = random.Uniform(0.1, 1);
    for (int k = 0; k < 3; ++k) of_b[4 * k] = random.Uniform(0.1, 1);
    const Matrix3d matrix = RandomQuaternion(random).normalized().toRotationMatrix();
    std::memcpy(turn, matrix.data(), sizeof(turn));
    const Vector3d d = random.Uniform(0, 3) * random.UnitVector();
    const BoxPair boxes{of_a, of_b, turn, {d.x(), d.y(), d.z()}, 3, 3, 12, 0, 0};
    EXPECT_EQ(PlainSeparatingAxisTest()(boxes), Avx2SeparatingAxisTest()(boxes));

    double points[24];
    for (double& x : points) x = random.Uniform(-1, 1);
    SmallGjkPair pair{};
    pair.a.is_hull = true, pair.a.points = points, pair.a.blocks = 2;
    pair.b.edges = static_cast<int>(random.Below(3)) == 0 ? 1 : 3;
    std::memcpy(pair.a.axes, turn, sizeof(turn));
    std::memcpy(pair.b.axes, of_b, sizeof(of_b));
    for (int k = 0; k < 3; ++k) pair.d[k] = d[k], pair.a.reach[k] = pair.b.reach[k] = 1;
    pair.size = 12, pair.apart = numeric::kInfinity, pair.near = -numeric::kInfinity,
    pair.inside = 1e-12;
    const SmallGjkResult x = PlainSmallGjk()(pair), y = Avx2SmallGjk()(pair);
    EXPECT_EQ(x.lower, y.lower);
    EXPECT_EQ(x.upper, y.upper);
    EXPECT_EQ(x.inside, y.inside);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
