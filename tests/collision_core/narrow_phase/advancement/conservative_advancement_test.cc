// Goal:   a sweep never says a time later than the first touch of any motion within the bounds, and
//         says it exactly where nothing is uncertain and nothing turns.
// Method: two bodies that move and turn with constant velocities, disturbed by as much as the sweep
//         was given, in long double; the distance of the surfaces just before the time that was
//         said, and at many times before it.
#include "collision_core/narrow_phase/advancement/conservative_advancement.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/truth/true_distance.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kPlenty = 10'000'000;

// Great triangles that stand in many leaves each, because small ones stand at their corner.
geometry::TriangleMesh PlateWithKnob() {
  return Joined(Sheet(1, 1), Moved(Scaled(Sphere(2), 0.05), {1, 1, 0.1}));
}

std::shared_ptr<const shape::Shape> RandomShape(Random& random, double size) {
  const sphere_tree::ShapeOptions options{.triangles_per_leaf = random.Chance(0.5) ? 1u : 4u};
  switch (random.Below(8)) {
    case 0:
      return shape::Shape::Build(Scaled(Cube(1), size), options);
    case 1:
      return shape::Shape::Build(Scaled(Tetrahedron(1), size), options);
    case 2:
      return shape::Shape::Build(Scaled(LShape(), size), options);
    case 3:
      return shape::Shape::Build(Scaled(Rod(2, 0.1), size), options);
    case 4:
      return shape::Shape::Build(Scaled(Sheet(1, 2), size), options);
    case 5:
      return shape::Shape::Build(Scaled(Star(1, random), size), options);
    case 6:
      return shape::Shape::Build(Scaled(PlateWithKnob(), size), options);
    default:
      return nullptr;
  }
}

// The inputs of a sweep, and the motions for which its answer must hold.
struct Case {
  BodySegment a, b;
  SweptPose swept;
  Quaternion q_AB = Quaternion::Identity();
  double duration = 1;
  // θ of each body, without the tangents' deviation.
  SweptPose::Growth angle_A, angle_B;

  static Real At(const SweptPose::Growth& growth, Real h) {
    return growth.c0 + h * (growth.c1 + h * growth.c2);
  }

  // `about_A`, `about_B`: the axes of the disturbance, each as great as allowed.
  Real Distance(Real h, const Vector& about_A, const Vector& about_B) const {
    TruePose pose_A, pose_B;
    pose_A.q =
        Exponential(At(angle_A, h) * about_A) * Exponential(h * swept.spin_A.cast<Real>().eval());
    pose_B.q = Exponential(At(angle_B, h) * about_B) *
               Exponential(h * swept.spin_B.cast<Real>().eval()) * q_AB;
    pose_B.p = swept.pose.p_AB.cast<Real>() + h * swept.velocity.cast<Real>();
    return SurfaceDistance(TrueBody(a.shape.get(), a.ball.radius, pose_A),
                           TrueBody(b.shape.get(), b.ball.radius, pose_B));
  }
  Real Distance(Real h) const { return Distance(h, Vector::UnitX(), Vector::UnitX()); }

  ImpactBound Touch(std::uint64_t units = kPlenty) const {
    WorkBudget work(units);
    return LowerBoundOfImpact({BodyTree(a), BodyTree(b), swept}, duration, &work);
  }

  double size() const { return a.ball.radius + b.ball.radius; }
};

void Turn(Case* c, const Quaternion& q) {
  c->q_AB = q.normalized();
  const numeric::Rotation rotation = RotationOf(numeric::UnitQuaternion(c->q_AB.cast<double>()));
  c->swept.pose.R_AB = rotation.matrix;
  c->swept.pose.matrix_error = rotation.error + 0x1p-48;
}

SweptPose::Growth TurningOf(const SweptPose::Growth& angle, const Eigen::Vector3d& spin) {
  return {angle.c0, angle.c1, angle.c2 + 0.5 * spin.squaredNorm() * (1 + 1e-14)};
}

struct Wish {
  bool turning = false, uncertain = false;
};

Case RandomCase(Random& random, Wish wish) {
  Case c;
  const double size = random.LogUniform(1e-3, 1e5);
  c.a = BodyOf(RandomShape(random, size), 0.7 * size);
  c.b = BodyOf(RandomShape(random, size * random.LogUniform(0.1, 4)), 0.4 * size);
  if (!c.a.shape && !c.b.shape) c.b = BodyOf(shape::Shape::Build(Scaled(LShape(), size)));
  Turn(&c, RandomTurn(random));
  c.duration = random.LogUniform(1e-6, 1e3);
  const double pace = 1 / c.duration;
  if (wish.turning) {
    if (c.a.shape) c.swept.spin_A = random.LogUniform(1e-3, 2) * pace * random.UnitVector();
    if (c.b.shape) c.swept.spin_B = random.LogUniform(1e-3, 2) * pace * random.UnitVector();
  }
  if (wish.uncertain) {
    const double u = random.LogUniform(1e-6, 0.3);
    // Beside growing ones those that shrink to nothing at the end, as they do towards a state.
    const double shrinks = random.Chance(0.5) ? -1 : 1;
    const double c0 = shrinks < 0 ? 1 : random.Uniform(0, 0.1);
    c.swept.translation = {u * size * c0, u * size * (shrinks < 0 ? -2 : 1) * pace,
                           u * size * pace * pace};
    if (c.a.shape) c.angle_A = {u * random.Uniform(0, 1), u * pace, u * pace * pace};
    if (c.b.shape) c.angle_B = {u * random.Uniform(0, 1), u * pace, u * pace * pace};
  }
  if (c.a.shape) c.swept.turning_A = TurningOf(c.angle_A, c.swept.spin_A);
  if (c.b.shape) c.swept.turning_B = TurningOf(c.angle_B, c.swept.spin_B);
  const double apart = c.size() * random.Uniform(0.3, 2.5);
  c.swept.pose.p_AB = apart * random.UnitVector();
  // Towards each other, or past.
  const Eigen::Vector3d aim = -c.swept.pose.p_AB + 0.7 * c.size() * random.UnitVector();
  c.swept.velocity = random.LogUniform(0.3, 3) * pace * aim;
  return c;
}

// Before, and just before, the time that was said no motion touches.
void ExpectNotLate(const Case& c, const ImpactBound& touch, Random& random) {
  const Real until = std::min<Real>(touch.seconds, c.duration);
  if (!(until > 0)) return;
  for (int trial = 0; trial < 2; ++trial) {
    const Vector about_A = RandomUnit(random), about_B = RandomUnit(random);
    const auto expect_apart = [&](Real h) {
      EXPECT_GT(c.Distance(h, about_A, about_B),
                Case::At(c.swept.translation, h) - 1e-13L * c.size())
          << "at " << static_cast<double>(h) << " of " << touch.seconds;
    };
    for (int k = 1; k <= 40; k += 3) expect_apart(until * (1 - std::ldexp(Real(1), -k)));
    for (int i = 0; i < 12; ++i) expect_apart(until * random.Uniform(0, 1 - 1e-12));
    if (touch.seconds == numeric::kInfinity) expect_apart(c.duration);
  }
}

struct Count {
  int touching = 0, never = 0;
};

Count ExpectNeverLate(Wish wish, std::uint64_t first, int cases, std::uint64_t units) {
  Count count;
  for (std::uint64_t seed = first; seed < first + cases && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Case c = RandomCase(random, wish);
    const ImpactBound touch = c.Touch(units);
    EXPECT_GE(touch.seconds, 0);
    EXPECT_TRUE(touch.seconds <= c.duration || touch.seconds == numeric::kInfinity);
    if (touch.seconds == numeric::kInfinity) ++count.never;
    if (touch.seconds > 0 && touch.seconds <= c.duration) ++count.touching;
    ExpectNotLate(c, touch, random);
  }
  return count;
}

TEST(ConservativeAdvancement, NeverLate) {
  for (const Wish wish :
       {Wish{false, false}, Wish{true, false}, Wish{false, true}, Wish{true, true}}) {
    constexpr int kCases = kSanitized ? 30 : 120;
    const Count count = ExpectNeverLate(wish, 1, kCases, kPlenty);
    EXPECT_GT(count.touching, kCases / 4);
    EXPECT_GT(count.never, kCases / 12);
  }
}

TEST(ConservativeAdvancement, NeverLateWhenTheWorkIsSpent) {
  for (const std::uint64_t units : {0, 1, 20, 200, 2000}) {
    ExpectNeverLate({true, true}, 1000, 25, units);
  }
}

// What is spent less says less, never another thing.
TEST(ConservativeAdvancement, ExhaustionIsSaidAndEarlier) {
  Random random(3);
  Case c = RandomCase(random, {});
  c.a = BodyOf(shape::Shape::Build(Sphere(4)));
  c.b = BodyOf(shape::Shape::Build(Moved(Sphere(4), {0.1, 0, 0})));
  c.duration = 1;
  c.swept.pose.p_AB = {2.5, 0.1, 0.2};
  c.swept.velocity = {-1, 0, 0};
  const ImpactBound whole = c.Touch();
  ASSERT_LT(whole.seconds, 1);
  EXPECT_FALSE(whole.exhausted);
  EXPECT_TRUE(whole.resolved);
  double before = 0;
  for (const std::uint64_t units : {1, 30, 100, 300, 1000}) {
    const ImpactBound touch = c.Touch(units);
    EXPECT_TRUE(touch.exhausted) << units;
    EXPECT_FALSE(touch.resolved) << units;
    EXPECT_GE(touch.seconds, before);
    EXPECT_LE(touch.seconds, whole.seconds);
    before = touch.seconds;
  }
}

// Nothing uncertain, nothing turns: at the time that is said the surfaces are together, or so near
// as steps of a thousandth of the duration, the last of which is not taken, allow.
TEST(ConservativeAdvancement, TellsTheFirstTouchExactly) {
  int touching = 0, exact = 0;
  for (std::uint64_t seed = 1; seed <= 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Case c = RandomCase(random, {});
    const ImpactBound touch = c.Touch();
    if (touch.seconds == numeric::kInfinity) {
      Real least = INFINITY;
      for (int i = 0; i <= 64; ++i) least = std::min(least, c.Distance(c.duration * i / Real(64)));
      EXPECT_GT(least, 0);
      continue;
    }
    ++touching;
    const Real speed = c.swept.velocity.cast<Real>().norm() * c.duration;
    EXPECT_LE(c.Distance(touch.seconds), 1e-3L * speed);
    exact += c.Distance(touch.seconds) <= 1e-6L * speed;
  }
  EXPECT_GT(touching, 50);
  EXPECT_GT(exact, touching * 95 / 100) << touching;
}

struct Pass {
  const char* name;
  std::shared_ptr<const shape::Shape> a, b;  // null: a ball of radius 1
  Eigen::Vector3d offset;
  double touch;  // at 2 m/s towards −x
};

std::vector<Pass> Passes() {
  const auto cube = shape::Shape::Build(Cube(1)), ship = shape::Shape::Build(LShape());
  const auto sheet = shape::Shape::Build(Sheet(1, 3)), rod = shape::Shape::Build(Rod(2, 0.1));
  return {{"faces", cube, cube, {5, 0.3, -0.4}, 1.5},
          {"past by a thousandth", cube, cube, {5, 2.002, 0}, numeric::kInfinity},
          {"by a hair", cube, cube, {5, 1.9999999, 0}, 1.5},
          // Behind the arm of the first L, above which the second passes, lies its stem's side.
          {"into the corner", ship, shape::Shape::Build(Cube(0.25)), {4, 0.5, 0}, 1.875},
          {"over the arm", ship, shape::Shape::Build(Cube(0.25)), {4, -0.5, 0}, 1.375},
          {"a ball and a face", cube, nullptr, {6, 0.5, 0.5}, 2},
          {"a face and a ball", nullptr, cube, {6, 0.5, 0.5}, 2},
          {"a ball and an edge", cube, nullptr, {5, 1.6, 0}, 1.6},
          {"edge of a sheet", sheet, cube, {5, 0.2, 0}, 1.5},
          {"sheets that slide", sheet, sheet, {5, 0, 0.001}, numeric::kInfinity},
          {"a rod through nothing", rod, cube, {5, 0, 1.2}, numeric::kInfinity},
          {"head on", rod, rod, {9, 0.1, 0.1}, 2.5}};
}

TEST(ConservativeAdvancement, ExactPasses) {
  for (const double scale : {1e-5, 1.0, 1e6}) {
    for (const Pass& pass : Passes()) {
      SCOPED_TRACE(pass.name);
      const auto scaled = [&](const std::shared_ptr<const shape::Shape>& shape) {
        return BodyOf(shape ? shape::Shape::Build(Scaled(shape->mesh(), scale)) : nullptr, scale);
      };
      Case c;
      c.a = scaled(pass.a);
      c.b = scaled(pass.b);
      c.duration = 4;
      c.swept.pose.p_AB = scale * pass.offset;
      c.swept.velocity = {-2 * scale, 0, 0};
      const ImpactBound touch = c.Touch();
      if (pass.touch == numeric::kInfinity) {
        EXPECT_EQ(touch.seconds, numeric::kInfinity);
        continue;
      }
      EXPECT_LE(touch.seconds, pass.touch + 1e-15);
      EXPECT_GE(touch.seconds, pass.touch - 1e-6);
      EXPECT_TRUE(touch.resolved);
    }
  }
}

// Small bodies pass far off while what is not known of them grows: several tangents, each at a time
// at which the uncertainty grows faster than before. Touch is where |offset + velocity h| = sizes +
// growth h².
TEST(ConservativeAdvancement, TangentsOfAPassWhileTheUncertaintyGrows) {
  Case c;
  c.a = BodyOf(shape::Shape::Build(Cube(0.001)));
  c.b = BodyOf(nullptr, 0.001);
  c.duration = 3;
  c.swept.velocity = {-10, 0, 0};
  for (const double aside : {1.0, 3.0, 6.0, 9.0}) {
    for (const double growth : {1.0, 4.0, 16.0}) {
      c.swept.pose.p_AB = {10, aside, 0};
      c.swept.translation = {0, 0, growth};
      double apart = 0, touching = numeric::kInfinity;
      for (double h = 0; h <= c.duration && touching == numeric::kInfinity; h += 1e-3) {
        const double distance = (c.swept.pose.p_AB + h * c.swept.velocity).norm();
        (distance > 0.002 + growth * h * h ? apart : touching) = h;
      }
      const ImpactBound touch = c.Touch();
      EXPECT_LE(touch.seconds, touching) << aside << " " << growth;
      EXPECT_GE(touch.seconds, apart - 0.05) << aside << " " << growth;
    }
  }
}

// The end of the duration belongs to it; nothing after it does.
TEST(ConservativeAdvancement, TheEndIncluded) {
  Case c;
  c.a = c.b = BodyOf(shape::Shape::Build(Cube(1)));
  c.swept.pose.p_AB = {5, 0, 0};
  c.swept.velocity = {-2, 0, 0};
  for (const double duration : {1.5, 1.50000001}) {
    c.duration = duration;
    EXPECT_LE(c.Touch().seconds, 1.5);
  }
  c.duration = 1.4999;
  EXPECT_EQ(c.Touch().seconds, numeric::kInfinity);
  c.duration = 0;
  EXPECT_EQ(c.Touch().seconds, numeric::kInfinity);
  c.swept.pose.p_AB = {1, 0.5, 0.25};
  EXPECT_EQ(c.Touch().seconds, 0);
  c.duration = 1.5;
  EXPECT_EQ(c.Touch().seconds, 0);
}

// Where bodies overlap everything may touch at once: one pair that does is enough.
TEST(ConservativeAdvancement, OverlapIsSeenWithoutOpeningEverything) {
  Case c;
  c.a = c.b = BodyOf(shape::Shape::Build(Sphere(5)));
  c.swept.pose.p_AB = {0.5, 0.25, 0.125};
  c.swept.velocity = {-1, 0, 0};
  WorkBudget work(kPlenty);
  EXPECT_EQ(LowerBoundOfImpact({BodyTree(c.a), BodyTree(c.b), c.swept}, 1, &work).seconds, 0);
  EXPECT_LE(work.spent(), 10u);
}

// Beyond the range of squares nothing is known, and nothing is said to be free.
TEST(ConservativeAdvancement, OverflowIsNotFreedom) {
  Case c;
  c.a = c.b = BodyOf(shape::Shape::Build(Cube(1)));
  c.swept.pose.p_AB = {5, 0, 0};
  c.duration = 1;
  for (const double speed : {1e150, 1e160, 1e200, 1e300}) {
    c.swept.velocity = {speed, 0, 0};         // away from each other, but
    c.swept.translation = {0, 0, 2 * speed};  // uncertain by more
    EXPECT_LE(c.Touch().seconds, 0.51) << speed;
    c.swept.velocity = {-speed, 0, 0};
    c.swept.translation = {};
    EXPECT_LE(c.Touch().seconds, 1) << speed;
  }
}

}  // namespace
}  // namespace collision::narrow_phase
