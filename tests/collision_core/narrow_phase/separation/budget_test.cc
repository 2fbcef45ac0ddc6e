// Goal:   whatever takes a budget overruns it by one batch at most, and the bracket of a look only
//         becomes narrower with the budget.
// Method: meshes, solids, compounds, open and nested bodies, leaves of very many triangles, at rest
//         and in motion, each query with budgets from 0 up to what it would spend.
#include <functional>

#include "collision_core/narrow_phase/advancement/swept_ring.h"
#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "collision_core/narrow_phase/contact/shape_motion.h"
#include "collision_core/narrow_phase/penetration/separating_translation.h"
#include "collision_core/narrow_phase/separation/containment.h"
#include "collision_core/narrow_phase/separation/refinement.h"
#include "tests/collision_core/narrow_phase/contact_cases.h"
#include "tests/collision_core/narrow_phase/posed_body.h"
#include "tests/support/dirty_meshes.h"
#include "tests/support/sanitized.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kMost = 20'000;

/// Some 160 corners about a sphere with bumps and arms: neither convex nor even.
geometry::TriangleMesh Spiky(std::uint64_t seed) {
  Random random(seed);
  return Star(3, random);
}

std::shared_ptr<const shape::Shape> Solids(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<shape::ConvexSolid> solids;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d at = random.UnitVector(), size = Vector3d::Constant(random.Uniform(0.05, 0.4));
    solids.push_back(i % 2 == 0 ? SolidBox(at - size, at + size) : HullBox(at - size, at + size));
  }
  return shape::Shape::Compound(nullptr, std::move(solids));
}

/// Many components.
geometry::TriangleMesh Swarm() {
  geometry::TriangleMesh mesh;
  Random random(3);
  for (int i = 0; i < 24; ++i) {
    mesh = Joined(mesh, Moved(Cube(0.02), random.Uniform(0, 0.6) * random.UnitVector()));
  }
  return mesh;
}

std::vector<std::pair<const char*, Body>> Bodies() {
  const auto solid = shape::Shape::Compound(nullptr, {SolidBox({-1, -1, -1}, {1, 1, 1})});
  const auto hull = shape::Shape::Compound(nullptr, {HullBox({-1, -0.5, -0.2}, {1, 0.5, 0.2})});
  return {
      {"ball", {nullptr, 0.5}},
      {"spiky", {shape::Shape::Build(Spiky(1))}},
      {"blocks", {shape::Shape::Build(Spiky(2), {.triangles_per_leaf = 11})}},
      {"sheet", {shape::Shape::Build(Sheet(1, 6))}},
      {"hollow", {shape::Shape::Build(HollowCube(1.5, 1.4))}},
      {"swarm", {shape::Shape::Build(Swarm())}},
      {"leaves", {shape::Shape::Build(Spiky(3), {.triangles_per_leaf = 60})}},
      {"leaf", {shape::Shape::Build(Cube(0.7), {.triangles_per_leaf = 12})}},
      {"solid", {solid}},
      {"hull", {hull}},
      {"solids", {Solids(120, 5)}},
      {"mixed", {shape::Shape::Compound(shape::Shape::Build(Spiky(4)), Solids(400, 6)->solids())}}};
}

/// Two bodies over a second.
struct Pair {
  BodyPair bodies;
  BodyTree a{bodies.a}, b{bodies.b};
  RelativePose pose = PoseAt(bodies.a, bodies.b, BestBounds(bodies.a, bodies.b, 0.4), 0.4);

  Pair(const Body& first, const Body& second, Result states_at)
      : bodies(SegmentsOf(Known(first, 1, states_at), Known(second, 1, states_at), Instant())) {}

  SegmentResult Balls() const { return EvaluateBallSegment(bodies.a.ball, bodies.b.ball, 1); }
};

/// At rest in each other, meeting, passing by, turning fast, with accelerations.
std::vector<std::pair<Body, Body>> Motions(Body a, Body b) {
  std::vector<std::pair<Body, Body>> motions;
  b.p = {0.3, 0.2, 0.1};
  motions.emplace_back(a, b);
  b.p = {1.2, 0.4, 0.3};
  b.v = {-0.5, 0.1, 0};
  a.w = {0.3, 0.2, 0.5};
  motions.emplace_back(a, b);
  b.p = {4, 0.4, 0.3};
  b.v = {-5, 0.5, 0.1};
  a.w = {0, 0.2, 20};
  b.w = {0, 200, 1};
  motions.emplace_back(a, b);
  b.w = {1, 0, 0};
  a.acceleration_max = 0.1;
  a.angular_acceleration_max = b.angular_acceleration_max = 0.3;
  motions.emplace_back(a, b);
  return motions;
}

/// The last leaf of each.
ContactWitness LastLeaves(const Pair& pair) {
  const auto last = [](const BodyTree& body) {
    return body.shape() ? NodeIndex(body.shape()->tree().nodes.size() - 1) : NodeIndex();
  };
  return ContactWitness::Leaves({last(pair.a), last(pair.b)});
}

using Ask = std::function<void(const Pair&, WorkBudget*)>;

std::vector<std::pair<const char*, Ask>> Queries() {
  std::vector<std::pair<const char*, Ask>> asks;
  for (const Goal goal : {Goal::kDecision, Goal::kContact, Goal::kNearest, Goal::kYesNo}) {
    asks.emplace_back("QuerySeparation", [goal](const Pair& pair, WorkBudget* work) {
      QuerySeparation({pair.a, pair.b, pair.pose}, goal, work);
    });
  }
  asks.emplace_back("QuerySeparation leaves", [](const Pair& pair, WorkBudget* work) {
    QuerySeparation({pair.a, pair.b, pair.pose}, Goal::kDecision, work, LastLeaves(pair));
  });
  asks.emplace_back("RecheckWitness", [](const Pair& pair, WorkBudget* work) {
    RecheckWitness({pair.a, pair.b, pair.pose}, LastLeaves(pair), work);
  });
  asks.emplace_back("BracketSeparation", [](const Pair& pair, WorkBudget* work) {
    BracketSeparation({pair.a, pair.b, pair.pose}, {0, 1e-6}, work);
  });
  asks.emplace_back("DecideAt", [](const Pair& pair, WorkBudget* work) {
    DecideAt({pair.a, pair.b, pair.pose}, work);
  });
  asks.emplace_back("TestContainment", [](const Pair& pair, WorkBudget* work) {
    TestContainment({pair.a, pair.b, pair.pose}, work);
  });
  asks.emplace_back("SeparatingTranslation", [](const Pair& pair, WorkBudget* work) {
    SeparatingTranslation({pair.a, pair.b, pair.pose}, {}, work);
  });
  for (const RefinementOrder order :
       {RefinementOrder::kLevelByLevel, RefinementOrder::kLargestFirst}) {
    asks.emplace_back("Refinement", [order](const Pair& pair, WorkBudget* work) {
      Refinement refinement(order);
      WorkBudget start(0);
      for (const double weight : {1.0, 3.0}) {
        refinement.Add({pair.a, pair.b, pair.pose}, weight, Goal::kDecision,
                       BracketTolerance{0, 1e-6}, &start);
      }
      refinement.Refine(work);
    });
  }
  for (const ContactTolerance& tolerance : {ContactTolerance{}, ContactTolerance{0.1, 0}}) {
    asks.emplace_back("TimeOfContact", [tolerance](const Pair& pair, WorkBudget* work) {
      TimeOfContact(pair.bodies.a, pair.bodies.b, 1, tolerance, work);
    });
  }
  asks.emplace_back("EvaluateShapeSegment", [](const Pair& pair, WorkBudget* work) {
    EvaluateShapeSegment(pair.bodies.a, pair.bodies.b, 1, pair.Balls(), work);
  });
  asks.emplace_back("FreeAhead", [](const Pair& pair, WorkBudget* work) {
    FreeAhead(pair.bodies.a, pair.bodies.b, 0, 1, work);
  });
  asks.emplace_back("NormalAt", [](const Pair& pair, WorkBudget* work) {
    NormalAt(pair.bodies.a, pair.bodies.b, 0.4, work);
  });
  asks.emplace_back("ShapeProximity", [](const Pair& pair, WorkBudget* work) {
    ShapeProximity(pair.bodies.a, pair.bodies.b, 0.4, work);
  });
  asks.emplace_back("RingFreedom", [](const Pair& pair, WorkBudget* work) {
    ShapeMotion(pair.bodies.a, pair.bodies.b, work)
        .RingFreedom(0, 1, TimeDirection::kForward, 1, work->left());
  });
  return asks;
}

// With 0, 1, 2, 4, … units, half as many again each time, until it asks for no more.
void ExpectWithinBatch(const char* what, const Pair& pair, const Ask& ask) {
  for (std::uint64_t allowed = 0; allowed <= kMost; allowed = allowed * 3 / 2 + 1) {
    WorkBudget work(allowed);
    ask(pair, &work);
    EXPECT_LT(work.spent(), allowed + kBatchUnits) << what << " with " << allowed;
    if (work.spent() < allowed) return;
  }
}

TEST(Budget, IsOverrunByABatchAtMost) {
  const auto bodies = Bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = std::max<std::size_t>(i, 1); j < bodies.size(); ++j) {
      SCOPED_TRACE(std::string(bodies[i].first) + ' ' + bodies[j].first);
      int number = 0;
      for (const auto& [a, b] : Motions(bodies[i].second, bodies[j].second)) {
        const Pair pair(a, b, number++ % 2 == 0 ? Result::kAtStart : Result::kAtBoth);
        for (const auto& [what, ask] : Queries()) {
          ExpectWithinBatch(what, pair, ask);
        }
      }
    }
  }
}

// Where the work ends in the midst of anything, nothing is free that is not.
TEST(Budget, WhatItEndsStillHolds) {
  const auto bodies = Bodies();
  int contacts = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = std::max<std::size_t>(i, 1); j < bodies.size(); ++j) {
      SCOPED_TRACE(std::string(bodies[i].first) + ' ' + bodies[j].first);
      for (const auto& [a, b] : Motions(bodies[i].second, bodies[j].second)) {
        const Pair pair(a, b, Result::kAtStart);
        const auto& [of_a, of_b] = pair.bodies;
        WorkBudget plenty(1'000'000);
        const TimeOfContactResult best = TimeOfContact(of_a, of_b, 1, {}, &plenty);
        if (best.status != ContactStatus::kContact) continue;
        ++contacts;
        constexpr double kFactor = kSanitized ? 5 : 1.4;
        for (double next = 1; next <= kMost; next = kFactor * next + 1) {
          const auto allowed = static_cast<std::uint64_t>(next);
          WorkBudget ahead(allowed), whole(allowed);
          EXPECT_LE(FreeAhead(of_a, of_b, 0, 1, &ahead), best.begin.upper) << allowed;
          const TimeOfContactResult found = TimeOfContact(of_a, of_b, 1, {}, &whole);
          EXPECT_NE(found.status, ContactStatus::kFree) << allowed;
          EXPECT_LE(found.begin.lower, best.begin.upper) << allowed;
          EXPECT_GE(found.end.upper, best.end.lower) << allowed;
        }
      }
    }
  }
  EXPECT_GT(contacts, 100);
}

/// The bracket of the distance: an overlap counts as 0.
numeric::Interval DistanceIn(const SeparationBracket& bracket) {
  return {std::max(0.0, bracket.lower), std::max(0.0, bracket.upper)};
}

// The same search, further along.
TEST(Budget, MoreOfItNeverMakesALookWider) {
  const auto bodies = Bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = std::max<std::size_t>(i, 1); j < bodies.size(); ++j) {
      SCOPED_TRACE(std::string(bodies[i].first) + ' ' + bodies[j].first);
      for (const auto& [a, b] : Motions(bodies[i].second, bodies[j].second)) {
        const Pair pair(a, b, Result::kAtStart);
        std::vector<numeric::Interval> last(6, {0, numeric::kInfinity});
        Verdict verdict = Verdict::kUndecided;
        for (std::uint64_t allowed = 0; allowed <= kMost; allowed = allowed * 3 / 2 + 1) {
          std::vector<numeric::Interval> now;
          for (const Goal goal : {Goal::kDecision, Goal::kContact, Goal::kNearest}) {
            WorkBudget work(allowed);
            now.push_back(DistanceIn(QuerySeparation({pair.a, pair.b, pair.pose}, goal, &work)));
          }
          WorkBudget narrow(allowed);
          now.push_back(
              DistanceIn(BracketSeparation({pair.a, pair.b, pair.pose}, {0, 1e-6}, &narrow)));
          for (const RefinementOrder order :
               {RefinementOrder::kLevelByLevel, RefinementOrder::kLargestFirst}) {
            Refinement refinement(order);
            WorkBudget start(0), work(allowed);
            refinement.Add({pair.a, pair.b, pair.pose}, 1, Goal::kDecision, {}, &start);
            refinement.Add({pair.b, pair.b, RelativePose()}, 1, Goal::kDecision, {}, &start);
            refinement.Refine(&work);
            const RefinedPair found = refinement.At(0);
            now.push_back({std::max(0.0, found.lower), std::max(0.0, found.upper)});
          }
          for (std::size_t k = 0; k < now.size(); ++k) {
            EXPECT_GE(now[k].lower, last[k].lower) << k << " with " << allowed;
            EXPECT_LE(now[k].upper, last[k].upper) << k << " with " << allowed;
          }
          last = now;
          WorkBudget decision(allowed);
          const Verdict decided = DecideAt({pair.a, pair.b, pair.pose}, &decision).verdict;
          EXPECT_TRUE(verdict == Verdict::kUndecided || decided == verdict) << allowed;
          verdict = decided;
        }
      }
    }
  }
}

}  // namespace
}  // namespace collision::narrow_phase
