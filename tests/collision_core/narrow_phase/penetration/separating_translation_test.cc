// Goal:   shifted by the answer, two bodies do not overlap; by noticeably less along the same way
//         they would.
// Method: random bodies in each other, against all vertices in long double; cubes that rest in each
//         other.
#include "collision_core/narrow_phase/penetration/separating_translation.h"

#include <gtest/gtest.h>

#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

Real TurningReachOf(const TrueBody& body, const Vector& n) {
  Real reach = body.triangles.empty() ? n.dot(body.centre) + body.radius : -INFINITY;
  for (const auto& triangle : body.triangles) {
    for (const Vector& corner : triangle) reach = std::max(reach, n.dot(corner));
  }
  return reach;
}

TEST(SeparatingTranslationAlong, IsWhatTheVerticesTell) {
  int to_last_bits = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(1e-3, 1e3), other = size * random.LogUniform(0.1, 10);
    const Posed a = RandomBody(random, size, Vector::Zero());
    const Posed b = RandomBody(random, other, random.Uniform(0, 2) * size * RandomUnit(random));
    const BodySegment of_a = a.Segment(), of_b = b.Segment();
    const RelativePose pose = PoseBetween(of_a, of_b);
    const Vector3d n = random.UnitVector();
    WorkBudget work(1'000'000);
    const double shift =
        SeparatingTranslationAlong({BodyTree(of_a), BodyTree(of_b), pose}, n, &work);
    // In the world: A's frame is turned; a ball's is not.
    const Vector own = n.cast<Real>();
    const Vector way = a.shape ? Vector(a.pose.q * own) : own;
    const Real exact = TurningReachOf(a.Body(), way) + TurningReachOf(b.Body(), -way);
    EXPECT_GE(shift, exact);
    EXPECT_LE(shift, exact + 1e-3 * (size + other));
    to_last_bits += shift <= exact + 1e-11 * (size + other);
    WorkBudget none(0);
    EXPECT_EQ(SeparatingTranslationAlong({BodyTree(of_a), BodyTree(of_b), pose}, n, &none),
              a.shape || b.shape ? numeric::kInfinity : shift);
  }
  EXPECT_GE(to_last_bits, 290);
}

// Where thousands of corners reach equally far, a few nodes and the hull tell.
TEST(SeparatingTranslationAlong, CostsLittleOnFlatSides) {
  geometry::TriangleMesh mesh = Subdivided(Box({-20, -20, -8}, {20, 20, 0}), 5);
  Random random(3);
  double highest = 0;
  for (Vector3d& vertex : mesh.vertices) {
    if (vertex.z() == 0) vertex.z() = random.Uniform(0, 1e-5);
    highest = std::max(highest, vertex.z());
  }
  const Body ground{shape::Shape::Build(mesh)};
  const Body cube{UnitCube(), 0, {0.25, 0.125, 0.25}};
  Posed at{ground.shape, 0, {}}, on{cube.shape, 0, {}};
  on.pose.p = cube.p.cast<Real>();
  const BodySegment a = at.Segment(), b = on.Segment();
  WorkBudget work(1'000'000);
  const double shift = SeparatingTranslationAlong({BodyTree(a), BodyTree(b), PoseBetween(a, b)},
                                                  Vector3d::UnitZ(), &work);
  EXPECT_GE(shift, 0.25 + highest);
  EXPECT_LE(shift, 0.2501);
  EXPECT_LT(work.spent(), 200u);
}

double DepthOf(const Body& a, const Body& b) {
  Posed at_a{a.shape, a.radius, {}}, at_b{b.shape, b.radius, {}};
  for (const auto& [posed, body] : {std::pair(&at_a, &a), std::pair(&at_b, &b)}) {
    posed->pose.p = body->p.cast<Real>();
    posed->pose.q = body->q.cast<Real>();
  }
  const BodySegment of_a = at_a.Segment(), of_b = at_b.Segment();
  const BodyTree surface_a(of_a), surface_b(of_b);
  const RelativePose pose = PoseBetween(of_a, of_b);
  WorkBudget work(1'000'000);
  const SeparationBracket bracket =
      QuerySeparation({surface_a, surface_b, pose}, Goal::kContact, &work);
  EXPECT_LE(bracket.upper, 0);
  return SeparatingTranslation({surface_a, surface_b, pose}, bracket.witness, &work);
}

TEST(SeparatingTranslation, IsExactForBodiesThatRestOnFaces) {
  for (const Made made : {Made::kTriangles, Made::kSolid, Made::kHull, Made::kMixed}) {
    for (const double deep : {1e-9, 1e-3, 0.2}) {
      Body a{CubeOf(made)}, b{CubeOf(Made::kTriangles), 0, {0.25, 1 - deep, 0.125}};
      EXPECT_NEAR(DepthOf(a, b), deep, 1e-12);
      EXPECT_NEAR(DepthOf(b, a), deep, 1e-12);
      a.q = Turn(30, {0, 1, 0});
      EXPECT_NEAR(DepthOf(a, b), deep, 1e-12);
      EXPECT_NEAR(DepthOf({nullptr, 0.5}, {b.shape, 0, {1 - deep, 0, 0}}), deep, 1e-12);
    }
  }
  shape::ConvexDescription rounded;
  rounded.core = geometry::ConvexCore::kBox;
  rounded.half = {0.25, 0.25, 0.25};
  rounded.rounding = 0.25;
  const auto pebble = shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(rounded)});
  EXPECT_NEAR(DepthOf({UnitCube()}, {pebble, 0, {0.25, 0.125, 0.75}}), 0.25, 1e-12);
  // On a slanted face, aside of its middle: what shows the contact tells its normal.
  const Body slanted{shape::Shape::Build({{{2, -1, -1}, {-1, 2, -1}, {-1, -1, 2}, {-2, -2, -2}},
                                          {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}})};
  const Vector3d normal = Vector3d(1, 1, 1).normalized();
  const Body ball{nullptr, 1, normal * (1 - 1e-3) + Vector3d(0.25, -0.25, 0)};
  EXPECT_NEAR(DepthOf(slanted, ball), 1e-3, 1e-12);
}

}  // namespace
}  // namespace collision::narrow_phase
