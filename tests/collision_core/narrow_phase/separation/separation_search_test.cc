// Goal:   a search may stop and go on at any moment, overruns a budget by one step at most, and
//         gives the same bits whatever the pauses and whatever the processor's vectors; a decision
//         is right; a bracket is as narrow as asked.
// Method: random poses of surfaces of all kinds and sizes, near to and far from the reference
//         points, against brute force over all pairs of triangles in long double.
#include "collision_core/narrow_phase/separation/separation_search.h"

#include <gtest/gtest.h>

#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 40;

/// Two bodies that overlap, touch nearly, or are apart.
struct Pair {
  Posed a, b;
  BodySegment of_a, of_b;
  BodyTree surface_a, surface_b;
  RelativePose pose;

  Pair(Posed first, Posed second)
      : a(std::move(first)),
        b(std::move(second)),
        of_a(a.Segment()),
        of_b(b.Segment()),
        surface_a(of_a),
        surface_b(of_b),
        pose(PoseBetween(of_a, of_b)) {}

  double size() const { return a.radius + b.radius; }
};

Pair RandomPair(std::uint64_t seed) {
  Random random(seed);
  const double size = random.LogUniform(1e-5, 1e5);
  const double other = std::clamp(size * random.LogUniform(0.1, 10), 1e-6, 1e6);
  const Posed a = RandomBody(random, size, Vector::Zero());
  Posed b = RandomBody(random, other, (size + other) * random.Uniform(0, 2) * RandomUnit(random));
  if (!a.shape && !b.shape) b.shape = shape::Shape::Build(Scaled(Frame(), other));
  if (b.shape) b.radius = b.shape->facts().radius;
  // Leaves of several blocks.
  if (b.shape && seed % 2 == 0) {
    b.shape =
        shape::Shape::Build(b.shape->mesh(), sphere_tree::ShapeOptions{.triangles_per_leaf = 11});
  }
  return {a, b};
}

void ExpectSame(const SeparationBracket& x, const SeparationBracket& y) {
  EXPECT_EQ(x.lower, y.lower);
  EXPECT_EQ(x.upper, y.upper);
  EXPECT_EQ(x.crossing_margin, y.crossing_margin);
  EXPECT_EQ(x.point, y.point);
  EXPECT_EQ(x.point_error, y.point_error);
  EXPECT_EQ(x.witness.elements, y.witness.elements);
  EXPECT_EQ(x.witness.nodes, y.witness.nodes);
  EXPECT_EQ(x.ways.size(), y.ways.size());
  EXPECT_EQ(x.level, y.level);
  EXPECT_EQ(x.exhausted, y.exhausted);
}

struct SearchQuery {
  Goal goal;
  std::optional<BracketTolerance> narrow;
  SearchOrder order = SearchOrder::kAsGoal;
};

std::vector<SearchQuery> Queries(double size) {
  return {{Goal::kDecision, {}},
          {Goal::kContact, {}},
          {Goal::kNearest, {}},
          {Goal::kYesNo, {}},
          {Goal::kDecision, BracketTolerance{0, 1e-6}},
          {Goal::kDecision, BracketTolerance{0.01 * size, 0}},
          {Goal::kDecision, BracketTolerance{0, 1e-6}, SearchOrder::kNearest}};
}

TEST(SeparationSearch, PausesChangeNothingAndOverrunsAreBounded) {
  std::uint64_t most = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Pair pair = RandomPair(seed);
    for (const SearchQuery& query : Queries(pair.size())) {
      const auto search = [&] {
        return std::make_unique<SeparationSearch>(
            PosedPair{pair.surface_a, pair.surface_b, pair.pose}, query.goal, query.narrow,
            query.order);
      };
      const auto at_once = search(), in_steps = search();
      WorkBudget unlimited(kUnlimited), first(1);
      at_once->Start(&unlimited);
      at_once->Refine(&unlimited);
      in_steps->Start(&first);
      std::uint64_t spent = first.spent(), pause = 1;
      double lower = in_steps->lower(), upper = in_steps->upper();
      while (!in_steps->done()) {
        WorkBudget step(pause);
        in_steps->Refine(&step);
        EXPECT_LE(step.spent(), pause + kBatchUnits - 1);
        if (step.spent() > pause) most = std::max(most, step.spent() - pause);
        spent += step.spent();
        EXPECT_GE(in_steps->lower(), lower);
        EXPECT_LE(in_steps->upper(), upper);
        lower = in_steps->lower(), upper = in_steps->upper();
        pause = pause % 50 + 1;
      }
      EXPECT_EQ(spent, unlimited.spent());
      ExpectSame(in_steps->Result(), at_once->Result());
    }
  }
  EXPECT_GT(most, 8u);
}

TEST(SeparationSearch, SameBitsForEveryWidthOfVectors) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Pair pair = RandomPair(seed);
    if (seed % 3 == 0) pair.pose.chord_A = 1e-3, pair.pose.chord_B = 0.1;
    for (const SearchQuery& query : Queries(pair.size())) {
      const auto look_with = [&](const SpherePairKernel& scan, std::uint64_t* spent) {
        SeparationSearch search({pair.surface_a, pair.surface_b, pair.pose}, query.goal,
                                query.narrow, query.order, scan);
        WorkBudget work(kUnlimited);
        search.Start(&work);
        search.Refine(&work);
        *spent = work.spent();
        return search.Result();
      };
      std::uint64_t plain_units = 0, wide_units = 0;
      const SeparationBracket plain = look_with(*PlainSpherePairKernel(), &plain_units);
      for (const SpherePairKernel* scan : {Avx2SpherePairKernel(), Avx512SpherePairKernel()}) {
        if (scan == nullptr) continue;
        ExpectSame(plain, look_with(*scan, &wide_units));
        EXPECT_EQ(plain_units, wide_units);
      }
    }
  }
}

TEST(SeparationSearch, BracketsAreAsNarrowAsAsked) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const Pair pair = RandomPair(seed);
    const Real truth = SurfaceDistance(pair.a.Body(), pair.b.Body());
    const Real floor = 1e-14L * (pair.size() + pair.b.pose.p.norm());
    for (const double width : {0.1, 0.01, 1e-4, 0.0}) {
      for (const double share : {0.0, 1e-6, 0.1}) {
        WorkBudget work(kUnlimited);
        const SeparationBracket bracket = BracketSeparation(
            {pair.surface_a, pair.surface_b, pair.pose}, {width * pair.size(), share}, &work);
        EXPECT_FALSE(bracket.exhausted);
        if (bracket.upper <= 0) continue;  // one inside the other, or in contact
        EXPECT_LE(bracket.lower, truth + floor);
        EXPECT_GE(bracket.upper, SolidDistance(pair.a.Body(), pair.b.Body()) - floor);
        EXPECT_LE(bracket.upper - bracket.lower,
                  std::max<Real>(std::max(width * pair.size(), share * bracket.lower), 10 * floor));
        ++apart;
      }
    }
  }
  EXPECT_GT(apart, 500);
}

/// Poses and meshes that are far from their reference points.
Posed Away(const Posed& body, const Eigen::Vector3d& by) {
  Posed away = body;
  if (!body.shape) return body;
  away.shape = shape::Shape::Build(Moved(body.shape->mesh(), by));
  away.radius = away.shape->facts().radius;
  away.pose.p -= body.pose.q * by.cast<Real>();
  return away;
}

TEST(SeparationSearch, DecisionsAreRight) {
  int apart = 0, touching = 0, undecided = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed + 1000);
    const Pair near = RandomPair(seed);
    const Eigen::Vector3d by = near.size() * random.LogUniform(1e-2, 1e3) * random.UnitVector();
    const bool is_away = near.a.shape && near.b.shape && random.Chance(0.3);
    const Pair pair = is_away ? Pair(Away(near.a, by), Away(near.b, -by)) : near;
    const Real truth = SolidDistance(pair.a.Body(), pair.b.Body());
    const Real floor = 1e-13L * (pair.size() + pair.b.pose.p.norm());
    WorkBudget work(kUnlimited);
    const Decision decision = DecideAt({pair.surface_a, pair.surface_b, pair.pose}, &work);
    switch (decision.verdict) {
      case Verdict::kApart:
        ++apart;
        EXPECT_GT(truth, 0);
        EXPECT_LE(decision.bracket.lower, truth + floor);
        EXPECT_GT(decision.bracket.lower, 0);
        break;
      case Verdict::kTouching:
        ++touching;
        EXPECT_EQ(truth, 0);
        break;
      case Verdict::kUndecided:
        ++undecided;
        EXPECT_LE(truth, floor) << "apart by more than the floor is decidable";
    }
  }
  EXPECT_GT(apart, 150);
  EXPECT_GT(touching, 100);
  EXPECT_LT(undecided, 4);
}

// What is not known of the motion counts as it does in the old words: apart only if the bodies are
// apart wherever they may be, touching only if they touch wherever they may be.
TEST(SeparationSearch, DecisionsCountUncertaintyIn) {
  int decided = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Pair pair = RandomPair(seed);
    pair.pose.translation = pair.size() * random.LogUniform(1e-3, 0.3);
    WorkBudget work(kUnlimited);
    const Decision decision = DecideAt({pair.surface_a, pair.surface_b, pair.pose}, &work);
    if (decision.verdict == Verdict::kUndecided) continue;
    ++decided;
    for (int i = 0; i < 10; ++i) {
      const Vector by = (0.999L * pair.pose.translation) * RandomUnit(random);
      const Real there = SolidDistance(pair.a.Body(), pair.b.Body().Moved(by));
      EXPECT_EQ(decision.verdict == Verdict::kApart, there > 0);
    }
  }
  EXPECT_GT(decided, 100);
}

// At most one unit each: bodies far from each other are separated by their roots.
TEST(SeparationSearch, FarApartIsSeenAtOnce) {
  const Pair near = RandomPair(3);
  for (const double away : {1e3, 1e9, 1e14, 1e16, 1e30, 1e200}) {
    const RelativePose pose =
        PoseOf(Eigen::Matrix3d::Identity(), Eigen::Vector3d(away * near.size(), 0, 0));
    WorkBudget work(kUnlimited);
    const Decision decision = DecideAt({near.surface_a, near.surface_b, pose}, &work);
    EXPECT_EQ(decision.verdict, Verdict::kApart);
    EXPECT_EQ(work.spent(), 1u);
    EXPECT_LE(decision.bracket.lower, away * near.size());
    if (away > 1e100) continue;  // squares overflow: less is known, nothing wrong
    const SeparationBracket bracket =
        BracketSeparation({near.surface_a, near.surface_b, pose}, {0, 1e-6}, &work);
    EXPECT_LE(bracket.upper - bracket.lower, 1.1e-6 * bracket.lower);
    EXPECT_LE(bracket.lower, away * near.size());
    EXPECT_GE(bracket.upper, (away - 1) * near.size());
  }
}

TEST(SeparationSearch, WhatIsNotANumberIsUndecided) {
  const Pair pair = RandomPair(4);
  RelativePose pose = pair.pose;
  pose.p_AB.x() = std::numeric_limits<double>::quiet_NaN();
  WorkBudget work(kUnlimited);
  EXPECT_EQ(DecideAt({pair.surface_a, pair.surface_b, pose}, &work).verdict, Verdict::kUndecided);
  EXPECT_LT(work.spent(), 1000u);
}

// Goal:   every triangle of a leaf is tested, in whichever block of either body it stands.
// Method: eleven triangles in a row in one leaf, three blocks; a single one above each in turn, and
//         beside it another row, all of it too high to matter but for one.
TEST(SeparationSearch, EveryBlockOfALeafIsLookedAt) {
  constexpr std::uint32_t kTriangles = 11;
  const auto row = [](std::uint32_t low, double height) {
    geometry::TriangleMesh mesh;
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      const double x = 4.0 * i, z = i == low ? height / 2 : height;
      mesh.vertices.insert(mesh.vertices.end(), {{x, 0, z}, {x + 1, 0, z}, {x, 1, z}});
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
  };
  const sphere_tree::ShapeOptions one_leaf{.triangles_per_leaf = kTriangles};
  const auto body = [&](const geometry::TriangleMesh& mesh) {
    return BodyOf(shape::Shape::Build(mesh, one_leaf));
  };
  const BodySegment flat = body(row(kTriangles, 0));
  ASSERT_EQ(flat.shape->tree().nodes.size(), 1u);
  for (std::uint32_t low = 0; low < kTriangles; ++low) {
    const BodySegment above = body(row(low, 2));
    for (const bool swapped : {false, true}) {
      const BodyTree a(swapped ? above : flat), b(swapped ? flat : above);
      WorkBudget work(1'000'000);
      const SeparationBracket bracket = BracketSeparation(
          {a, b, PoseOf(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0))}, {0, 1e-9}, &work);
      EXPECT_LE(bracket.lower, 1) << low << swapped;
      EXPECT_GE(bracket.lower, 1 - 1e-9) << low << swapped;
      EXPECT_GE(bracket.upper, 1) << low << swapped;
      EXPECT_LE(bracket.upper, 1 + 1e-9) << low << swapped;
    }
  }
}

}  // namespace
}  // namespace collision::narrow_phase
