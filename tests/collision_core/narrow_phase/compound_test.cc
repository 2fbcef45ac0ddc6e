// Goal:   a tree over solids and triangles covers them, says nothing too deep, and a look through
//         it says what all pairs of elements say, at every budget.
// Method: compounds by the hundred, of all kinds of solids, with and without a surface, from one
//         solid to many; every pair of elements asked by itself (what is certain of such a pair is
//         tested against exact numbers elsewhere).
#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/narrow_phase/separation/element.h"
#include "collision_core/narrow_phase/separation/refinement.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"
#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

shape::ConvexDescription RandomSolid(Random& random, double size, double spread) {
  shape::ConvexDescription d =
      random.Chance(0.2) ? RandomBox(random, size) : RandomPolytope(random, size);
  if (d.core == geometry::ConvexCore::kBox && random.Chance(0.5))
    d.core = geometry::ConvexCore::kEllipsoid;
  if (d.core == geometry::ConvexCore::kBox && random.Chance(0.5)) Turn(random, &d);
  if (d.core == geometry::ConvexCore::kEllipsoid) d.rounding = 0;
  d.p_BS = spread * random.UnitVector();
  return d;
}

// `most`: solids; a surface beside them every other time.
std::shared_ptr<const shape::Shape> RandomCompound(Random& random, std::size_t most, double size) {
  const std::size_t count = 1 + random.Below(most);
  std::vector<shape::ConvexSolid> solids;
  for (std::size_t i = 0; i < count; ++i) {
    const shape::ConvexDescription d = RandomSolid(random, size * random.Uniform(0.1, 0.5), size);
    EXPECT_EQ(RefusalOf(d), std::nullopt);
    solids.push_back(shape::ConvexSolid::Build(d));
  }
  std::shared_ptr<const shape::Shape> surface;
  if (random.Chance(0.5)) surface = RandomBody(random, size, Vector::Zero()).shape;
  return shape::Shape::Compound(surface, std::move(solids));
}

std::uint32_t ElementCountOf(const shape::Shape& shape) {
  return static_cast<std::uint32_t>(shape.mesh().triangles.size() + shape.solids().size());
}

// How deep the ball's centre is in the solid, or how far from it.
numeric::Interval SignedDistance(const Vector3d& point, const shape::ConvexSolid& solid) {
  WorkBudget work(100000);
  geometry::GjkHint none;
  return SeparationOf(geometry::BallSet(point, 0), solid.set(), {}, &none, &work).separation;
}

void ExpectCovered(const sphere_tree::SphereNode& node, const shape::ConvexSolid& solid) {
  const geometry::ConvexSet& set = solid.set();
  for (int i = 0; i < 26; ++i) {
    const int k = i < 13 ? i : i + 1;
    const Vector3d n = Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized();
    const Vector3d x = set.centre + set.SupportPoint(n) + set.rounding * n;
    EXPECT_LE((x - node.centre).norm(), node.radius);
  }
}

void ExpectTree(const shape::Shape& shape) {
  const sphere_tree::SphereTree& tree = shape.tree();
  EXPECT_EQ(RefusalOf(tree, sphere_tree::TreeElements{.triangles = shape.mesh().triangles.size(),
                                                      .solids = shape.solids().size()}),
            std::nullopt);
  std::vector<int> seen(ElementCountOf(shape), 0);
  std::uint32_t expected_child = 1;
  for (const sphere_tree::SphereNode& node : tree.nodes) {
    if (node.children > 0) {
      EXPECT_EQ(node.first_child, expected_child);
      expected_child += node.children;
      EXPECT_LE(node.children, 8u);
      EXPECT_GE(node.children, 2u);
    }
    double distance = numeric::kInfinity;
    for (const sphere_tree::SphereNode& child : tree.ChildrenOf(node))
      EXPECT_EQ(child.level, node.level + 1);
    for (const ElementIndex element : tree.ElementsOf(node)) {
      ++seen[element.value()];
      if (!shape.IsSolid(element)) continue;
      EXPECT_EQ(node.elements, 1u);
      ExpectCovered(node, shape.SolidAt(element));
    }
    // Everything below is within the ball: the leaves' solids are.
    std::vector<const sphere_tree::SphereNode*> below = {&node};
    bool of_surface = true;
    while (!below.empty()) {
      const sphere_tree::SphereNode& next = *below.back();
      below.pop_back();
      for (const sphere_tree::SphereNode& child : tree.ChildrenOf(next)) below.push_back(&child);
      for (const ElementIndex element : tree.ElementsOf(next)) {
        if (!shape.IsSolid(element)) continue;
        of_surface = false;
        ExpectCovered(node, shape.SolidAt(element));
      }
    }
    for (const shape::ConvexSolid& solid : shape.solids()) {
      distance = std::min(distance, SignedDistance(node.centre, solid).lower);
    }
    if (!shape.mesh().triangles.empty()) {
      const numeric::Interval surface = shape.DistanceTo(node.centre);
      const bool inside = shape.closed() && shape.WindingNumberAt(node.centre).value_or(0) != 0;
      distance = std::min(distance, inside ? -surface.upper : surface.lower);
    }
    if (!of_surface) {
      EXPECT_GE(node.signed_distance, distance);
    }
  }
  EXPECT_EQ(expected_child, tree.nodes.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_GE(seen[i], 1) << i;
}

TEST(Compound, TreesCoverWhatTheyHold) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto shape =
        RandomCompound(random, seed % 3 == 0 ? 100 : 9, random.LogUniform(1e-3, 1e3));
    ExpectTree(*shape);
    const geometry::MeshFacts& facts = shape->facts();
    for (const shape::ConvexSolid& solid : shape->solids()) {
      EXPECT_LE(solid.facts().radius, facts.radius);
      EXPECT_TRUE((facts.lower.array() <= solid.facts().lower.array()).all());
      EXPECT_TRUE((facts.upper.array() >= solid.facts().upper.array()).all());
    }
    EXPECT_EQ(shape->component_points().size(), facts.components);
    EXPECT_GT(shape->bytes(), sizeof(shape::Shape));
  }
}

Posed RandomPosed(Random& random, double size, const Vector& p) {
  Posed posed;
  if (random.Chance(0.15)) {
    posed = RandomBody(random, size, p);
  } else {
    posed.shape = RandomCompound(random, random.Chance(0.3) ? 40 : 4, size);
    posed.radius = posed.shape->facts().radius;
    posed.pose.p = p;
    posed.pose.q = RandomTurn(random);
  }
  return posed;
}

// All pairs, of which none is left out.
numeric::Interval LeastOfAll(const BodyTree& a, const BodyTree& b, const RelativePose& pose) {
  numeric::Interval least{numeric::kInfinity, numeric::kInfinity};
  const std::uint32_t of_a = a.shape() ? ElementCountOf(*a.shape()) : 1;
  const std::uint32_t of_b = b.shape() ? ElementCountOf(*b.shape()) : 1;
  for (std::uint32_t i = 0; i < of_a; ++i) {
    for (std::uint32_t j = 0; j < of_b; ++j) {
      WorkBudget work(10000);
      geometry::GjkHint none;
      const ConvexQuery query{ConvexGoal::kDistance, 1e-12, 0};
      const numeric::Interval pair =
          SeparationOf(PosedA(SetOf(a, ElementIndex(i)), pose),
                       PosedB(SetOf(b, ElementIndex(j)), pose), query, &none, &work)
              .separation;
      least = {std::min(least.lower, pair.lower), std::min(least.upper, pair.upper)};
    }
  }
  return least;
}

TEST(Compound, LooksSayWhatAllPairsSay) {
  int apart = 0, touching = 0, nested = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(1e-3, 1e3), other = size * random.LogUniform(0.1, 10);
    const Posed body_a = RandomPosed(random, size, Vector::Zero());
    const Vector way = random.Uniform(0, 2) * (size + other) * RandomUnit(random);
    const Posed body_b = RandomPosed(random, other, way);
    const BodySegment of_a = body_a.Segment(), of_b = body_b.Segment();
    const BodyTree a(of_a), b(of_b);
    const RelativePose pose = PoseBetween(of_a, of_b);
    const numeric::Interval least = LeastOfAll(a, b, pose);
    const double rounding = 1e-13 * (a.reach() + b.reach() + pose.p_AB.norm());
    WorkBudget plenty(100000000);
    const Decision decision = DecideAt({a, b, pose}, &plenty);
    // One inside the other, with their surfaces apart: then the distance is not that of any pair.
    const bool inside = least.lower > rounding && decision.verdict == Verdict::kTouching;
    numeric::Interval before{-numeric::kInfinity, numeric::kInfinity};
    for (std::uint64_t units = 0;; units = 3 * units + 20) {
      WorkBudget work(units);
      const SeparationBracket bracket = QuerySeparation({a, b, pose}, Goal::kDecision, &work);
      if (bracket.upper > 0 && !inside) {
        EXPECT_LE(bracket.lower, least.upper + rounding);
        EXPECT_GE(bracket.upper, std::max(0.0, least.lower) - rounding);
      }
      EXPECT_GE(bracket.lower, before.lower);
      EXPECT_LE(bracket.upper, before.upper);
      EXPECT_LE(work.spent(), units + kBatchUnits);
      before = {bracket.lower, bracket.upper};
      if (!bracket.exhausted) break;
    }
    if (least.lower > rounding) {
      EXPECT_NE(decision.verdict, Verdict::kUndecided);
      ++(inside ? nested : apart);
      if (inside) continue;
      const SeparationBracket nearest = QuerySeparation({a, b, pose}, Goal::kNearest, &plenty);
      EXPECT_LE(nearest.lower, least.upper);
      EXPECT_GE(nearest.lower, least.lower - 1e-6 * least.lower - rounding);
      const SeparationBracket bracket = BracketSeparation({a, b, pose}, {0, 0.01}, &plenty);
      EXPECT_LE(bracket.upper, 1.0101 * bracket.lower + rounding);
      EXPECT_LE(bracket.lower, least.upper + rounding);
    } else if (least.upper < -rounding) {
      ++touching;
      EXPECT_EQ(decision.verdict, Verdict::kTouching);
    }
  }
  EXPECT_GT(apart, 60);
  EXPECT_GT(touching, 60);
  EXPECT_GT(nested, 0);
}

Posed After(const Posed& posed, const Vector3d& v, const Vector3d& w, double seconds) {
  Posed later = posed;
  const Vector turned = static_cast<Real>(seconds) * w.cast<Real>();
  later.pose.q = Exponential(turned) * posed.pose.q;
  later.pose.p += static_cast<Real>(seconds) * v.cast<Real>();
  return later;
}

motion::SpaceTimeBound BoundOf(const Posed& posed, const Vector3d& v, const Vector3d& w) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = posed.pose.p.cast<double>();
  bound.state.q_WB = posed.pose.q.cast<double>();
  bound.state.v_WA = v;
  bound.state.w_WB = w;
  bound.limits.radius = posed.radius;
  bound.limits.angular_acceleration_max = 0;
  return bound;
}

// What is asked of begin and end [s]; the bodies are about 1 m large and a few m/s fast.
constexpr double kWidth = 1e-11;

// Bodies that tumble through each other's way: apart before the bracket, touching behind it.
TEST(Compound, MeetWhenAllPairsMeet) {
  int met = 0, free = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Posed a = RandomPosed(random, 1, Vector::Zero());
    Posed b = RandomPosed(random, 1, 6 * RandomUnit(random));
    const Vector3d towards =
        -b.pose.p.cast<double>() + random.Uniform(0, 2.5) * random.UnitVector();
    const Vector3d v = random.Uniform(1, 3) * towards;
    const Vector3d spin_a = random.Uniform(0, 3) * random.UnitVector();
    const Vector3d spin_b = random.Uniform(0, 3) * random.UnitVector();
    KnownMotion of_a, of_b;
    of_a.last = BoundOf(a, Vector3d::Zero(), spin_a);
    of_b.last = BoundOf(b, v, spin_b);
    of_a.shape = a.shape, of_b.shape = b.shape;
    WorkBudget work(20'000'000);
    const TimeOfContactResult found = TimeOfContact(
        of_a, of_b, {Instant(), Instant::FromNanoseconds(1'000'000'000)}, {kWidth, 0}, &work);
    const auto separation_at = [&](double seconds) {
      const BodySegment at_a = After(a, Vector3d::Zero(), spin_a, seconds).Segment();
      const BodySegment at_b = After(b, v, spin_b, seconds).Segment();
      return LeastOfAll(BodyTree(at_a), BodyTree(at_b), PoseBetween(at_a, at_b));
    };
    ASSERT_NE(found.status, ContactStatus::kUndecided);
    ASSERT_EQ(found.limited_by, BracketLimit::kNone);
    const bool is_free = found.status == ContactStatus::kFree;
    const double until = is_free ? 1 : found.begin.lower;
    for (int i = 0; i < 50; ++i) EXPECT_GE(separation_at(until * i / 50).upper, 0);
    ++(is_free ? free : met);
    if (is_free) continue;
    EXPECT_LE(found.begin.width(), kWidth);
    EXPECT_GE(separation_at(found.begin.lower).upper, -1e-12);
    // Inside another one the surfaces are apart: then it was so from the start.
    if (found.begin.upper > 0) {
      EXPECT_LE(separation_at(found.begin.upper).lower, 1e-12);
    }
    if (found.end.upper < 1) {
      EXPECT_GE(separation_at(found.end.upper).upper, -1e-12);
    }
  }
  EXPECT_GT(met, 40);
  EXPECT_GT(free, 20);
}

// One body inside the other is never reported as apart, and the cheapest query finds the contact.
TEST(Compound, InsideASolidIsContact) {
  const auto big = shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(RandomBox(
                                                       *[] {
                                                         static Random random(3);
                                                         return &random;
                                                       }(),
                                                       10))});
  Posed around{big, big->facts().radius, {}};
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    Posed within = RandomPosed(random, 0.01, Vector::Zero());
    const BodySegment a = around.Segment(), b = within.Segment();
    WorkBudget work(100);
    EXPECT_EQ(DecideAt({BodyTree(a), BodyTree(b), PoseBetween(a, b)}, &work).verdict,
              Verdict::kTouching);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
