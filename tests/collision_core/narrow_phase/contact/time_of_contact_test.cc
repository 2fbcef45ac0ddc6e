// Goal:   where a contact has a closed answer, the bracket contains it and is as narrow as asked
//         for: 1e-12 of it.
// Method: cubes, bars and balls whose motion is known exactly, about every axis, at every size,
//         swapped, far from the origin, given by states at either end; the answers in long double.
#include "tests/collision_core/narrow_phase/contact_cases.h"

namespace collision::narrow_phase {
namespace {

// Every case with triangles, solids, and both.
class ClosedContact : public testing::TestWithParam<std::pair<Made, Made>> {
 protected:
  const std::shared_ptr<const shape::Shape> first_ = CubeOf(GetParam().first);
  const std::shared_ptr<const shape::Shape> second_ = CubeOf(GetParam().second);
};

INSTANTIATE_TEST_SUITE_P(Made, ClosedContact,
                         testing::Values(std::pair(Made::kTriangles, Made::kTriangles),
                                         std::pair(Made::kSolid, Made::kSolid),
                                         std::pair(Made::kSolid, Made::kTriangles),
                                         std::pair(Made::kHull, Made::kSolids),
                                         std::pair(Made::kMixed, Made::kHull),
                                         std::pair(Made::kMixed, Made::kMixed)));

Body Scaled(Body body, double by, Made made) {
  body.shape = CubeOf(made, by / 2);
  body.p *= by;
  body.v *= by;
  return body;
}

// Turned so that +x becomes any of the six axes, then anything.
std::vector<Quaterniond> Turns() {
  std::vector<Quaterniond> turns = {Quaterniond::Identity()};
  turns.push_back(Quaterniond(0, 0, 0, 1));
  for (const Vector3d& axis : {Vector3d::UnitY().eval(), Vector3d::UnitZ().eval()}) {
    for (const double sign : {-1.0, 1.0}) turns.push_back(Turn(sign * 90, axis));
  }
  Random random(5);
  for (int i = 0; i < 8; ++i) turns.push_back(RandomTurn(random).cast<double>());
  return turns;
}

// Cubes 5 m apart that close at 10 m/s: faces that meet exactly, with all edges on edges.
TEST_P(ClosedContact, CubesHeadOn) {
  const Body a{first_}, b{second_, 0, {5, 0, 0}, {-10, 0, 0}};
  for (const Quaterniond& turn : Turns()) {
    for (const Result states_at : {Result::kAtStart, Result::kAtEnd, Result::kAtBoth}) {
      ExpectContact(Find(Turned(a, turn), Turned(b, turn), 1, states_at), 0.4L, 0.6L);
      ExpectContact(Find(Turned(b, turn), Turned(a, turn), 1, states_at), 0.4L, 0.6L);
    }
  }
}

TEST_P(ClosedContact, CubesOfAllSizes) {
  for (const double size : {1e-3, 0.1, 30.0, 1e3, 1e6}) {
    const Body a = Scaled({nullptr}, size, GetParam().first);
    const Body b = Scaled({nullptr, 0, {5, 0, 0}, {-10, 0, 0}}, size, GetParam().second);
    ExpectContact(Find(a, b, 1), 0.4L, 0.6L);
  }
}

TEST_P(ClosedContact, CubesThatMeetInPartOfTheirFaces) {
  const Body a{first_};
  for (const Vector3d& off : {Vector3d(5, 0.25, 0), Vector3d(5, -0.5, 0.5), Vector3d(5, 0.75, 0.8),
                              Vector3d(5, 0.999999, 0)}) {
    const Body b{second_, 0, off, {-10, 0, 0}};
    ExpectContact(Find(a, b, 1), 0.4L, 0.6L);
  }
}

// Many triangles meet at once.
TEST_P(ClosedContact, FinelyDividedCubes) {
  const auto fine = shape::Shape::Build(Subdivided(Cube(0.5), 4));
  const Body a{fine}, b{fine, 0, {5, 0, 0}, {-10, 0, 0}}, c{first_, 0, {5, 0, 0}, {-10, 0, 0}};
  ExpectContact(Find(a, b, 1), 0.4L, 0.6L);
  ExpectContact(Find(a, c, 1), 0.4L, 0.6L);
}

TEST_P(ClosedContact, EdgeOnFace) {
  const Real root = std::sqrt(Real(0.5));
  for (const Quaterniond& turn : Turns()) {
    const Body a{first_};
    const Body b{second_, 0, {5, 0, 0}, {-10, 0, 0}, Vector3d::Zero(), Turn(45, {0, 0, 1})};
    const Real begin = (4.5L - root) / 10, end = (5.5L + root) / 10;
    ExpectContact(Find(Turned(a, turn), Turned(b, turn), 1), begin, end);
    ExpectContact(Find(Turned(b, turn), Turned(a, turn), 1, Result::kAtBoth), begin, end);
  }
}

// Edges that coincide, edges that cross, a corner on the diagonal of a face.
TEST_P(ClosedContact, EdgesAndCorners) {
  const Real root = std::sqrt(Real(2));
  const Body z{
      first_, 0, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Turn(45, {0, 0, 1})};
  Body y = z;
  y.q = Turn(45, {0, 1, 0});
  Body moving = z;
  moving.p = {5, 0, 0};
  moving.v = {-10, 0, 0};
  ExpectContact(Find(z, moving, 1), (5 - root) / 10, (5 + root) / 10);
  ExpectContact(Find(y, moving, 1), (5 - root) / 10, (5 + root) / 10);
  moving.q = Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d(-1, 0, 0));
  const Real half = std::sqrt(Real(0.75));
  ExpectContact(Find({first_}, moving, 1), (4.5L - half) / 10, (5.5L + half) / 10);
  ExpectContact(Find(moving, {second_}, 1), (4.5L - half) / 10, (5.5L + half) / 10);
}

TEST_P(ClosedContact, FarFromTheOriginAndFast) {
  const Vector3d far(1e6, -1e6, 1e6), fast(1e4, 1e4, -1e4);
  const Real root = std::sqrt(Real(0.5));
  for (const Result states_at : {Result::kAtStart, Result::kAtBoth}) {
    const Body a{first_, 0, far, fast};
    Body b{second_, 0, far + Vector3d(5, 0, 0), fast + Vector3d(-10, 0, 0)};
    ExpectContact(Find(a, b, 1, states_at), 0.4L, 0.6L);
    ExpectContact(Find(b, a, 1, states_at), 0.4L, 0.6L);
    b.q = Turn(45, {0, 0, 1});
    ExpectContact(Find(a, b, 1, states_at), (4.5L - root) / 10, (5.5L + root) / 10);
    ExpectContact(Find(b, a, 1, states_at), (4.5L - root) / 10, (5.5L + root) / 10);
  }
}

TEST_P(ClosedContact, TurningBarMeetsABall) {
  Body bar{BoxOf(GetParam().first, {-2, -0.1, -0.1}, {2, 0.1, 0.1})};
  bar.w = {0, 0, 1};
  const Body ball{nullptr, 0.2, {0, 1, 0}};
  const Real begin = std::acos(Real(0.3));
  for (const Quaterniond& turn : Turns()) {
    const Body a = Turned(bar, turn), b = Turned(ball, turn);
    ExpectContact(Find(a, b, 2), begin, M_PIl - begin);
    ExpectContact(Find(b, a, 2, Result::kAtBoth), begin, M_PIl - begin);
  }
}

TEST_P(ClosedContact, BarThatTurnsManyTimesBetweenTwoStates) {
  const Body ball{nullptr, 0.2, {0, 1, 0}};
  for (const double degrees : {350.0, -350.0, 3590.0, 36000.0}) {
    Body bar{BoxOf(GetParam().first, {-2, -0.1, -0.1}, {2, 0.1, 0.1})};
    const double step = 0.25, rate = degrees * kPi / 180 / step;
    bar.w = {0, 0, rate};
    const TimeOfContactResult found = Find(bar, ball, step, Result::kAtBoth);
    ASSERT_EQ(found.status, ContactStatus::kContact) << degrees;
    ExpectWithin(found.begin, std::acos(Real(0.3)) / std::abs(Real(rate)), 1e-12, "begin");
    // The last time that it passes: whole half turns later.
    const Real passes = std::floor((std::abs(rate) * step - std::acos(Real(0.3))) / kPi);
    const Real end = ((passes + 1) * M_PIl - std::acos(Real(0.3))) / std::abs(Real(rate));
    ExpectWithin(found.end, std::min(end, Real(step)), 1e-12, "end");
  }
}

TEST_P(ClosedContact, BallsThatPassByAtTenKilometresAStep) {
  const Body a{nullptr, 0.25, {-5000, 0, 0}, {10000, 0, 0}};
  const Real half = std::sqrt(0.25L - 0.499L * 0.499L);
  ExpectContact(Find(a, {nullptr, 0.25, {0, 0.499, 0}}, 1), (5000 - half) / 10000,
                (5000 + half) / 10000);
  EXPECT_EQ(Find(a, {nullptr, 0.25, {0, 0.501, 0}}, 1).status, ContactStatus::kFree);
}

// The same against a mesh, and faster than any sampling would see.
TEST_P(ClosedContact, BallThatPassesACubeAtTenKilometresAStep) {
  const Body ball{nullptr, 0.25, {-5000, 0, 0}, {10000, 0, 0}};
  ExpectContact(
      Find(ball, {second_, 0, {0, 0.749, 0}}, 1),
      0.5L - 0.5L / 10000 -
          [] {
            const Real deep = std::sqrt(0.25L * 0.25L - 0.249L * 0.249L);
            return deep / 10000;
          }(),
      0.5L + (0.5L + std::sqrt(0.25L * 0.25L - 0.249L * 0.249L)) / 10000);
  EXPECT_EQ(Find(ball, {second_, 0, {0, 0.751, 0}}, 1).status, ContactStatus::kFree);
}

// Touching all the time, by nothing: no rounding may make it free, or contact.
TEST_P(ClosedContact, RestingAndSlidingContactsStayUndecided) {
  for (const Vector3d& v : {Vector3d(0, 0, 0), Vector3d(0.3, 0.2, 0), Vector3d(0, 0.5, 0)}) {
    const Body a{first_}, b{second_, 0, {0.125, 0.25, 1}, v};
    const TimeOfContactResult found = Find(a, b, 1);
    ASSERT_EQ(found.status, ContactStatus::kUndecided);
    // Solids: 64 · 2^-53 of the size of the pair.
    const bool triangles = GetParam().first == Made::kTriangles;
    EXPECT_LE(found.within, triangles ? 1e-14 : 4e-14);
    EXPECT_EQ(found.begin.lower, 0);
    EXPECT_EQ(found.end.upper, 1);
    EXPECT_EQ(found.limited_by, BracketLimit::kGeometry);
  }
}

TEST_P(ClosedContact, RestsWithinOrAboveTheOther) {
  const Body a{first_};
  const TimeOfContactResult within = Find(a, {second_, 0, {0.25, 0, 1 - 1e-12}, {0.25, 0, 0}}, 1);
  EXPECT_EQ(within.status, ContactStatus::kContact);
  EXPECT_EQ(within.begin.upper, 0);
  EXPECT_EQ(within.end.lower, 1);
  const TimeOfContactResult above = Find(a, {second_, 0, {0.25, 0, 1 + 1e-12}, {0.25, 0, 0}}, 1);
  EXPECT_EQ(above.status, ContactStatus::kFree);
}

TEST_P(ClosedContact, StartsInOverlapAndLeaves) {
  for (const Quaterniond& turn : Turns()) {
    const Body a = Turned({first_}, turn);
    const Body b = Turned({second_, 0, {0.75, 0.25, 0}, {1, 0, 0}}, turn);
    const TimeOfContactResult found = Find(a, b, 1);
    ASSERT_EQ(found.status, ContactStatus::kContact);
    EXPECT_EQ(found.begin.lower, 0);
    EXPECT_EQ(found.begin.upper, 0);
    ExpectWithin(found.end, 0.25L, 1e-12, "end");
    EXPECT_EQ(found.limited_by, BracketLimit::kNone);
  }
}

TEST_P(ClosedContact, InsideTheOther) {
  const Body big{CubeOf(GetParam().first, 4)}, small{second_, 0, {1, 1, 1}, {0.5, 0, 0}};
  const TimeOfContactResult found = Find(big, small, 1);
  EXPECT_EQ(found.status, ContactStatus::kContact);
  EXPECT_EQ(found.begin.upper, 0);
  EXPECT_EQ(found.end.lower, 1);
  const Body leaving{second_, 0, {1, 1, 1}, {7, 0, 0}};
  ExpectWithin(Find(big, leaving, 1).end, 0.5L, 1e-12, "end");
}

TEST_P(ClosedContact, ThinPlates) {
  const auto plate = BoxOf(GetParam().first, {-1, -1, -1e-6}, {1, 1, 1e-6});
  const auto blade = BoxOf(GetParam().second, {-1e-7, -1, -1}, {1e-7, 1, 1});
  const Body lower{plate};
  ExpectContact(Find(lower, {plate, 0, {0.1, 0.2, 1}, {0, 0, -1000}}, 1), (1 - 2e-6L) / 1000,
                (1 + 2e-6L) / 1000);
  ExpectContact(Find(lower, {blade, 0, {0.1, 0.2, 5}, {0, 0, -1000}}, 1), (4 - 1e-6L) / 1000,
                (6 + 1e-6L) / 1000);
}

// An open surface has no inside: contact is certain by edges that cross its triangles.
TEST_P(ClosedContact, BladeSweepsThroughASheet) {
  const Body sheet{shape::Shape::Build(Sheet(1, 3))};
  const auto blade = BoxOf(GetParam().second, {-1e-7, -1, -1}, {1e-7, 1, 1});
  ExpectContact(Find(sheet, {blade, 0, {0.1, 0.2, 5}, {0, 0, -1000}}, 1), 4 / 1000.0L, 6 / 1000.0L);
}

// An edge comes down on another one by turning and leaves on the other side, all within one step.
TEST_P(ClosedContact, EdgeSweepsThroughInOneStep) {
  Body bar{BoxOf(GetParam().first, {-2, -0.1, -0.1}, {2, 0.1, 0.1})};
  bar.w = {0, 0, 6};
  const Body cube{CubeOf(GetParam().second, 0.125), 0, {0.125, 1, 0}};
  // Its upper side meets the corner (0, 0.875): sin θ = (x sin θ ...) with the corner on the y
  // axis.
  const TimeOfContactResult found = Find(bar, cube, 0.5, Result::kAtBoth);
  ASSERT_EQ(found.status, ContactStatus::kContact);
  // The corner (0.25, 0.875) is met first: cos θ y − sin θ x = 0.1.
  const Real x = 0.25L, y = 0.875L, at = std::atan2(y, x) - std::asin(0.1L / std::hypot(x, y));
  ExpectWithin(found.begin, at / 6, 1e-12, "begin");
}

// Stamps that differ, at 1e4 m/s: the frame that moves along loses nothing.
TEST_P(ClosedContact, StatesOfDifferentStamps) {
  Body a{first_, 0, {1e6, 0, 0}, {8192, 0, 0}}, b{second_, 0, {1e6 + 5, 0, 0}, {8182, 0, 0}};
  KnownMotion of_a, of_b;
  of_a.shape = first_, of_b.shape = second_;
  of_a.last = a.At(0);
  of_b.next = b.At(2);
  WorkBudget work(kPlenty);
  const TimeOfContactResult found =
      TimeOfContact(of_a, of_b, {Instant(), Instant::FromNanoseconds(1000000000)}, {}, &work);
  ExpectContact(found, 0.4L, 0.6L);
}

}  // namespace
}  // namespace collision::narrow_phase
