// Goal:   whatever a mesh looks like, it gets a tree, and every query about it an answer that
//         holds, within the work allowed: brackets contain the true distance, what is said to be
//         free is, what is said to touch does.
// Method: dirty meshes by the thousand, built either way, in pairs and beside balls, at rest and in
//         motion, with budgets from nothing to plenty; against all pairs of triangles in long
//         double.
#include "tests/support/dirty_meshes.h"

#include "collision_core/narrow_phase/separation/separation_search.h"
#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/collision_core/narrow_phase/posed_body.h"
#include "tests/support/sanitized.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint32_t kMeshes = kSanitized ? 10 * kDirtKinds : 80 * kDirtKinds;

// Brute force over more pairs of triangles than this takes too long.
constexpr std::size_t kPairsMax = 6000;

std::shared_ptr<const shape::Shape> NextShape(std::uint32_t* kind, Random& random) {
  for (;;) {
    const geometry::TriangleMesh mesh = DirtyMesh((*kind)++, random);
    if (mesh.triangles.empty() || RefusalOf(mesh, 100000)) continue;
    sphere_tree::ShapeOptions options;
    if (*kind % 2 == 0) options.builder = sphere_tree::TreeBuilder::kFitted;
    options.nodes_max = 2000;
    return shape::Shape::Build(mesh, options);
  }
}

// About where it is, so that pairs are often near: its middle at the reference point of the pose.
Posed PosedNear(std::shared_ptr<const shape::Shape> shape, Random& random, const Vector& p) {
  Posed posed{shape, shape->facts().radius, {}};
  posed.pose.q = RandomTurn(random);
  const Vector3d middle = (shape->facts().lower + shape->facts().upper) / 2;
  posed.pose.p = p - posed.pose.q * middle.cast<Real>();
  return posed;
}

double SizeOf(const shape::Shape& shape) {
  return (shape.facts().upper - shape.facts().lower).norm();
}

void ExpectLook(const Posed& a, const Posed& b, std::uint64_t units, bool brute) {
  const BodySegment of_a = a.Segment(), of_b = b.Segment();
  const BodyTree surface_a(of_a), surface_b(of_b);
  const RelativePose pose = PoseBetween(of_a, of_b);
  WorkBudget work(units);
  const SeparationBracket bracket =
      QuerySeparation({surface_a, surface_b, pose}, Goal::kDecision, &work);
  EXPECT_LE(work.spent(), units + kBatchUnits);
  EXPECT_FALSE(std::isnan(bracket.lower) || std::isnan(bracket.upper));
  WorkBudget more(units);
  const Decision decision = DecideAt({surface_a, surface_b, pose}, &more);
  if (!brute) return;
  const TrueBody body_a = a.Body(), body_b = b.Body();
  const Real surfaces = SurfaceDistance(body_a, body_b), solids = SolidDistance(body_a, body_b);
  const Real tolerance = 1e-15L * (surface_a.reach() + surface_b.reach());
  if (bracket.upper > 0) {
    EXPECT_LE(bracket.lower, surfaces + tolerance);
  }
  EXPECT_GE(std::max(0.0, bracket.upper), solids - tolerance);
  if (decision.verdict == Verdict::kApart) {
    EXPECT_GT(solids, 0);
  }
  if (decision.verdict == Verdict::kTouching) {
    EXPECT_LE(solids, tolerance);
  }
}

Body Moving(const Posed& posed, const Vector3d& v, const Vector3d& w) {
  Body body{posed.shape, posed.radius, posed.pose.p.cast<double>(), v, w};
  body.q = posed.pose.q.cast<double>();
  return body;
}

TrueBody After(const Body& body, double seconds) {
  TruePose pose;
  const Real s = seconds;
  pose.p = body.p.cast<Real>() + s * body.v.cast<Real>();
  pose.q = Exponential(Vector(s * body.w.cast<Real>())) * body.q.cast<Real>();
  return {body.shape.get(), body.radius, pose};
}

void ExpectMotion(const Body& a, const Body& b, std::uint64_t units, bool brute) {
  const TimeOfContactResult found = Find(a, b, 1, Result::kAtStart, {1e-4, 0}, units);
  EXPECT_LE(found.begin.lower, found.begin.upper);
  EXPECT_LE(found.end.lower, found.end.upper);
  if (!brute) return;
  const double until = found.status == ContactStatus::kFree ? 1 : found.begin.lower;
  for (int i = 0; i < 4; ++i) {
    const double at = until * i / 4;
    if (!(at < until)) break;
    EXPECT_GT(SolidDistance(After(a, at), After(b, at)), 0) << at;
  }
  if (found.status == ContactStatus::kContact) {
    const Real near = SolidDistance(After(a, found.begin.upper), After(b, found.begin.upper));
    EXPECT_LE(near, 1e-12L * (After(a, 0).centre.norm() + After(b, 0).centre.norm() + 1));
  }
}

TEST(DirtyMeshes, EveryAnswerHolds) {
  Random random(77);
  std::uint32_t kind = 0;
  int compared = 0;
  std::shared_ptr<const shape::Shape> last = NextShape(&kind, random);
  while (kind < kMeshes && !HasFailure()) {
    SCOPED_TRACE(kind);
    const std::shared_ptr<const shape::Shape> shape = NextShape(&kind, random);
    const double size = SizeOf(*shape), other = SizeOf(*last);
    const Posed a = PosedNear(shape, random, Vector::Zero());
    const Vector off = random.Uniform(0, 1) * (size + other) * RandomUnit(random);
    Posed b = PosedNear(last, random, off);
    if (random.Chance(0.1)) b = {nullptr, other / 4, {}}, b.pose.p = off;
    const std::size_t of_b = b.shape ? b.shape->mesh().triangles.size() : 1;
    const bool brute = shape->mesh().triangles.size() * of_b <= kPairsMax;
    compared += brute;
    for (const std::uint64_t units : {0, 30, 1000, 100000}) ExpectLook(a, b, units, brute);
    const Vector3d v = -2 * random.Uniform(0, 1) * off.cast<double>();
    const Body moving_a = Moving(a, Vector3d::Zero(), random.Uniform(0, 1) * random.UnitVector());
    const Body moving_b = Moving(b, v, random.Uniform(0, 1) * random.UnitVector());
    ExpectMotion(moving_a, moving_b, 20000, brute);
    last = shape;
  }
  EXPECT_GT(compared, static_cast<int>(kMeshes / 4));
}

}  // namespace
}  // namespace collision::narrow_phase
