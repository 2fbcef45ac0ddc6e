// Goal:   the brackets of cylinders and cones contain the true distance and depth, and are narrow.
// Method: a ball beside or inside one, in closed form in its axes (long double); two of any kind
//         beside hulls of points on their circles, which lie within them and come near; two a short
//         way apart along a known direction.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"
#include "tests/support/truth/true_motion.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

shape::ConvexDescription RandomTurned(Random& random) {
  shape::ConvexDescription d = RandomBox(random, 1);
  Turn(random, &d);
  return d;
}

ConvexSeparation Ask(const shape::ConvexDescription& a, const shape::ConvexDescription& b,
                     const ConvexQuery& query) {
  const shape::ConvexSolid solid_a = shape::ConvexSolid::Build(a);
  const shape::ConvexSolid solid_b = shape::ConvexSolid::Build(b);
  geometry::GjkHint hint;
  WorkBudget work(1000000);
  return SeparationOf(solid_a.set(), solid_b.set(), query, &hint, &work);
}

/// Of a point from the segment from (x0, y0) to (x1, y1).
Real ToSegment(Real x, Real y, Real x0, Real y0, Real x1, Real y1) {
  const Real u = x1 - x0, v = y1 - y0;
  const Real t = std::clamp(((x - x0) * u + (y - y0) * v) / (u * u + v * v), Real(0), Real(1));
  return std::hypot(x - x0 - t * u, y - y0 - t * v);
}

/// The signed distance of a point: in the plane of the axis and the point.
Real SignedDistance(const shape::ConvexDescription& d, const Vector3d& point) {
  const Quaternion q = d.q_BS.cast<Real>().normalized();
  const Vector p = q.inverse() * (point - d.p_BS).cast<Real>().eval();
  const Real rho = std::hypot(p.x(), p.y()), z = p.z(), r = d.half.x(), h = d.half.z();
  const Real top = d.core == geometry::ConvexCore::kCylinder ? r : 0;  // radius at +h
  const Real outline = std::min({ToSegment(rho, z, 0, -h, r, -h), ToSegment(rho, z, r, -h, top, h),
                                 ToSegment(rho, z, 0, h, top + Real(1e-300L), h)});
  const bool inside = z > -h && z < h && rho < r + (top - r) * (z + h) / (2 * h);
  return inside ? -outline : outline;
}

TEST(TurnedSolids, BallsOutsideAndInside) {
  Random random(611);
  int inside = 0, wide = 0;
  for (int i = 0; i < 1000; ++i) {
    const shape::ConvexDescription a = RandomTurned(random);
    shape::ConvexDescription b;
    b.rounding = random.Uniform(0.01, 1);
    b.p_BS = random.Uniform(0, 2) * random.UnitVector();
    ConvexQuery query;
    query.relative_tolerance = 1e-6;
    const ConvexSeparation found = Ask(a, b, query);
    const Real distance = SignedDistance(a, b.p_BS);
    const Real truth = distance - b.rounding;
    inside += distance < 0;
    EXPECT_LE(found.separation.lower, truth + 1e-15L) << i;
    EXPECT_GE(found.separation.upper, truth - 1e-15L) << i;
    // The polytope that grows into an overlap has only so many faces for a curved surface.
    EXPECT_LE(found.separation.width(), truth > 0 ? 1e-6 * (1 + found.separation.upper) : 1e-3)
        << i;
    wide += found.separation.width() > 1e-6;
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(wide, 20);
}

/// The hull of points on the circles of the solid: within it, and nowhere farther from its surface
/// than 1 − cos(π / kCorners) of its radius.
constexpr int kCorners = 256;
shape::ConvexDescription Inscribed(const shape::ConvexDescription& d) {
  shape::ConvexDescription hull = d;
  hull.core = geometry::ConvexCore::kHull;
  const bool cone = d.core == geometry::ConvexCore::kCone;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const double x = d.half.x() * std::cos(angle), y = d.half.x() * std::sin(angle);
    hull.points.emplace_back(x, y, -d.half.z());
    if (!cone) hull.points.emplace_back(x, y, d.half.z());
  }
  if (cone) hull.points.emplace_back(0, 0, d.half.z());
  return hull;
}

TEST(TurnedSolids, ComeAsNearAsTheirHulls) {
  Random random(612);
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    shape::ConvexDescription a = RandomTurned(random), b = RandomTurned(random);
    if (i % 3 == 0) b = RandomBox(random, 1);
    if (i % 7 == 0) a.rounding = 0.1;
    b.p_BS = random.Uniform(0.5, 3) * random.UnitVector();
    const bool box = b.core == geometry::ConvexCore::kBox;
    ConvexQuery query;
    query.relative_tolerance = query.absolute_tolerance = 1e-6;
    const ConvexSeparation found = Ask(a, b, query);
    const ConvexSeparation inner = Ask(Inscribed(a), box ? b : Inscribed(b), query);
    const double off = 1 - std::cos(std::numbers::pi / kCorners);
    const double more = off * (a.half.x() + (box ? 0 : b.half.x())) + 1e-9;
    EXPECT_LE(found.separation.lower, inner.separation.upper + 1e-12) << i;
    EXPECT_GE(found.separation.upper, inner.separation.lower - more) << i;
    if (found.separation.lower < 0) continue;
    ++apart;
    EXPECT_LE(found.separation.width(), 1e-5 * (1 + found.separation.upper)) << i;
  }
  EXPECT_GT(apart, 100);
}

TEST(TurnedSolids, NearContactIsKnown) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const shape::ConvexDescription turned = RandomTurned(random);
    shape::ConvexDescription other = RandomTurned(random);
    if (seed % 3 == 1) other = RandomBox(random, 1);
    if (seed % 3 == 2) other = RandomHull(random, 1, 20);
    ConvexCase scene(turned, other);
    scene.Turn(RandomQuaternion(random), 3 * random.UnitVector());
    const double gap = random.LogUniform(1e-6, 1e-2);
    scene.MoveTo(gap);
    const ConvexSeparation found = scene.Ask();
    EXPECT_NEAR(found.separation.middle(), gap, 1e-9 + 1e-2 * gap);
    EXPECT_LE(found.separation.width(), 1e-7);
  }
}

// A can on the table, on its end, on its side, and leaning on its rim: 1 m above it, in exact
// numbers.
TEST(TurnedSolids, OverABox) {
  shape::ConvexDescription table, can;
  table.core = geometry::ConvexCore::kBox;
  table.half = {10, 10, 1};
  can.core = geometry::ConvexCore::kCylinder;
  can.half = {0.5, 0.5, 2};
  can.p_BS = {0, 0, 4};
  const auto distance = [&] { return Ask(table, can, {}).separation; };
  EXPECT_NEAR(distance().lower, 1, 1e-12);
  EXPECT_NEAR(distance().upper, 1, 1e-12);
  can.q_BS = {1, 1, 0, 0};  // its axis along y
  EXPECT_NEAR(distance().lower, 2.5, 1e-12);
  EXPECT_NEAR(distance().upper, 2.5, 1e-12);
  can.core = geometry::ConvexCore::kCone;
  can.q_BS = {0, 1, 0, 0};  // its apex down
  EXPECT_NEAR(distance().lower, 1, 1e-12);
  EXPECT_NEAR(distance().upper, 1, 1e-12);
}

TEST(TurnedSolids, FactsContainThem) {
  Random random(613);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription d = RandomTurned(random);
    d.p_BS = random.UnitVector();
    d.rounding = i % 2 ? 0 : 0.1;
    const shape::ConvexFacts facts = shape::ConvexSolid::Build(d).facts();
    EXPECT_LE(SignedDistance(d, facts.inner_point), d.rounding - facts.inradius + 1e-15L) << i;
    EXPECT_GT(facts.inradius, 0.02) << i;
    for (const Vector3d& x : Inscribed(d).points) {
      const Vector3d p = d.q_BS.normalized() * x + d.p_BS;
      EXPECT_LE(p.norm() + d.rounding, facts.radius + 1e-12);
      EXPECT_LE((p - facts.ball_centre).norm() + d.rounding, facts.ball_radius + 1e-12);
      EXPECT_TRUE(((p.array() - d.rounding) >= facts.lower.array() - 1e-12).all());
      EXPECT_TRUE(((p.array() + d.rounding) <= facts.upper.array() + 1e-12).all());
    }
  }
}

}  // namespace
}  // namespace collision::narrow_phase
