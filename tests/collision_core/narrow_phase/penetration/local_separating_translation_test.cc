// Goal:   shifted by the answer, or by more, a body meets nothing of the other; a little before
//         it does.
// Method: closed cases of ground with a far summit; random bodies against their distance at the
//         shifted pose.
#include "collision_core/narrow_phase/penetration/local_separating_translation.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/penetration/separating_translation.h"
#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

struct Pair {
  BodySegment a, b;
  BodyTree surface_a{a}, surface_b{b};
  RelativePose pose = PoseBetween(a, b);

  double Past(const Vector3d& n, double known, const ContactWitness& witness = {},
              std::uint64_t units = kPlenty) const {
    WorkBudget work(units);
    return LocalSeparatingTranslation({surface_a, surface_b, pose}, n, known, witness, &work);
  }
  double Along(const Vector3d& n) const {
    WorkBudget work(kPlenty);
    return SeparatingTranslationAlong({surface_a, surface_b, pose}, n, &work);
  }
  double Apart() const {
    WorkBudget work(kPlenty);
    return SeparatingTranslation({surface_a, surface_b, pose}, Touching().witness, &work);
  }
  SeparationBracket Touching() const {
    WorkBudget work(kPlenty);
    return QuerySeparation({surface_a, surface_b, pose}, Goal::kContact, &work);
  }
  Verdict ShiftedBy(const Vector3d& shift) const {
    RelativePose shifted = pose;
    shifted.p_AB += shift;
    WorkBudget work(kPlenty);
    return DecideAt({surface_a, surface_b, shifted}, &work).verdict;
  }
};

Pair PairOf(const Body& a, const Body& b) {
  Posed at_a{a.shape, a.radius, {}}, at_b{b.shape, b.radius, {}};
  for (const auto& [posed, body] : {std::pair(&at_a, &a), std::pair(&at_b, &b)}) {
    posed->pose.p = body->p.cast<Real>();
    posed->pose.q = body->q.cast<Real>();
  }
  return {at_a.Segment(), at_b.Segment()};
}

const Vector3d kUp = Vector3d::UnitZ();

// Flat at z = 0, 40 m wide, but for a summit of 10 m in one corner.
Body GroundWithSummit() {
  geometry::TriangleMesh mesh = Subdivided(Box({-20, -20, -8}, {20, 20, 0}), 4);
  for (Vector3d& vertex : mesh.vertices) {
    if (vertex == Vector3d(20, 20, 0)) vertex.z() = 10;
  }
  return {shape::Shape::Build(mesh)};
}

/// The answer is less than so many times the true translation.
constexpr double kNear = 4.0 / 3 + 1e-9;

TEST(LocalSeparatingTranslation, SummitsAsideDoNotCount) {
  const Body ground = GroundWithSummit();
  for (const Made made : {Made::kTriangles, Made::kSolid, Made::kHull, Made::kMixed}) {
    for (const double deep : {0.25, 1e-3}) {
      const Pair pair = PairOf(ground, {CubeOf(made), 0, {0.25, 0.125, 0.5 - deep}});
      EXPECT_GE(pair.Along(kUp), 10);
      EXPECT_GE(pair.Past(kUp, 10.5), deep);
      EXPECT_LE(pair.Past(kUp, 10.5), deep * kNear);
      EXPECT_GE(pair.Apart(), deep);
      EXPECT_LE(pair.Apart(), deep * kNear);
    }
  }
  const Pair ball = PairOf({nullptr, 0.5, {-3, 5, 0.25}}, ground);
  EXPECT_GE(ball.Apart(), 0.25);
  EXPECT_LE(ball.Apart(), 0.25 * kNear);
}

// Walls of 45° that end 20 m above: a ball that is 1/4 deep in both leaves upwards after √2/4.
TEST(LocalSeparatingTranslation, OutOfAValley) {
  geometry::TriangleMesh valley;
  valley.vertices = {{0, -20, 0},  {0, 20, 0},     {20, -20, 20},
                     {20, 20, 20}, {-20, -20, 20}, {-20, 20, 20}};
  valley.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
  const Body ground{shape::Shape::Build(valley)};
  const double root = std::sqrt(2.0), exact = 0.25 * root;
  const Pair pair = PairOf(ground, {nullptr, 1, {0, 3, 0.75 * root}});
  EXPECT_GE(pair.Past(kUp, 20), exact * (1 - 1e-15));
  EXPECT_LE(pair.Past(kUp, 20), exact * kNear);
  EXPECT_GE(pair.Apart(), exact * (1 - 1e-15));
  EXPECT_LE(pair.Apart(), exact * kNear);
  // Through one wall, which is a surface and no solid, it would be 1.75 m.
  EXPECT_GE(pair.Past(Vector3d(-1, 0, -1).normalized(), 20), 1);
}

// What is inside has to come out, though the surfaces are apart on the way.
TEST(LocalSeparatingTranslation, NothingIsLeftInside) {
  const Pair inside = PairOf({shape::Shape::Build(Cube(4))}, {UnitCube(), 0, {1, 1, 1}});
  EXPECT_GE(inside.Past(kUp, 20), 3.5);
  EXPECT_LE(inside.Past(kUp, 20), 3.5 * kNear);
  EXPECT_NEAR(inside.Apart(), 3.5, 1e-9);
  const Pair outside = PairOf({UnitCube()}, {shape::Shape::Build(Cube(4)), 0, {-1, -1, -1}});
  EXPECT_GE(outside.Past(-kUp, 20), 3.5);
  EXPECT_LE(outside.Past(-kUp, 20), 3.5 * kNear);
  // In a hole a body is apart from what is around it.
  const Pair hole = PairOf({shape::Shape::Build(HollowCube(4, 2))}, {UnitCube(), 0, {1.75, 0, 0}});
  const Vector3d back = -Vector3d::UnitX();
  EXPECT_GE(hole.Past(back, 20), 0.25);
  EXPECT_LE(hole.Past(back, 20), 0.25 * kNear);
}

TEST(LocalSeparatingTranslation, TheTranslationSeparatesTheBodies) {
  int shorter = 0, found = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(1e-3, 1e3), other = size * random.LogUniform(0.1, 10);
    const Posed a = RandomBody(random, size, Vector::Zero());
    const Posed b = RandomBody(random, other, random.Uniform(0, 1) * size * RandomUnit(random));
    const Pair pair{a.Segment(), b.Segment()};
    const Vector3d n = random.UnitVector();
    const double along = pair.Along(n), past = pair.Past(n, along, pair.Touching().witness);
    EXPECT_LE(past, along);
    if (past == along) continue;
    ++found;
    shorter += past < 0.5 * along;
    EXPECT_EQ(pair.ShiftedBy(past * (1 + 1e-9) * n), Verdict::kApart);
  }
  EXPECT_GE(found, 150);
  EXPECT_GE(shorter, 50);
}

TEST(LocalSeparatingTranslation, WhatIsUncertainCounts) {
  const Pair exact = PairOf(GroundWithSummit(), {UnitCube(), 0, {0.25, 0.125, 0.25}});
  Pair pair = exact;
  pair.pose.chord_B = 0.125;
  EXPECT_GE(pair.Past(kUp, 10), 0.25 + 0.125 * std::sqrt(0.75));
  EXPECT_LE(pair.Past(kUp, 10), (0.25 + 0.125) * kNear);
  pair.pose.chord_B = 0;
  pair.pose.offset_error = 0.125;
  EXPECT_GE(pair.Past(kUp, 10), 0.375);
  EXPECT_LE(pair.Past(kUp, 10), 0.375 * kNear);
  // Translation is left to the caller.
  pair.pose = exact.pose;
  pair.pose.translation = 3;
  EXPECT_EQ(pair.Past(kUp, 10), exact.Past(kUp, 10));
}

TEST(LocalSeparatingTranslation, EndsWithTheWorkAndWithWhatIsKnown) {
  const Pair pair = PairOf(GroundWithSummit(), {UnitCube(), 0, {0.25, 0.125, 0.25}});
  EXPECT_EQ(pair.Past(kUp, 0.3), 0.3);
  EXPECT_EQ(pair.Past(kUp, numeric::kInfinity), numeric::kInfinity);
  EXPECT_EQ(pair.Past(kUp, 0), 0);
  double before = 100;
  for (const std::uint64_t units : {0, 100, 1000, 10'000}) {
    const double past = pair.Past(kUp, 100, {}, units);
    EXPECT_GE(past, 0.25);
    EXPECT_LE(past, before);
    if (units == 0) {
      EXPECT_EQ(past, 100);
    }
    before = past;
  }
  EXPECT_LE(before, 0.25 * kNear);
}

}  // namespace
}  // namespace collision::narrow_phase
