// Pairs of convex solids whose separation is known exactly.
#pragma once

#include <gtest/gtest.h>

#include "collision_core/geometry/convex/gjk.h"
#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/numeric/rotation.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_convex.h"

namespace collision {

inline Eigen::Quaterniond RandomQuaternion(Random& random) {
  return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
          random.Uniform(-1, 1)};
}

inline shape::ConvexDescription RandomBox(Random& random, double size) {
  shape::ConvexDescription d;
  d.core = geometry::ConvexCore::kBox;
  for (int axis = 0; axis < 3; ++axis) d.half[axis] = size * random.Uniform(0.1, 1);
  d.q_BS = RandomQuaternion(random);
  return d;
}

/// Makes a cylinder or a cone of a box.
inline void Turn(Random& random, shape::ConvexDescription* d) {
  d->core = random.Chance(0.5) ? geometry::ConvexCore::kCylinder : geometry::ConvexCore::kCone;
  d->half.y() = d->half.x();
}

inline shape::ConvexDescription RandomHull(Random& random, double size, std::size_t points) {
  shape::ConvexDescription d;
  d.core = geometry::ConvexCore::kHull;
  for (std::size_t i = 0; i < points; ++i) d.points.push_back(size * random.UnitVector());
  d.q_BS = RandomQuaternion(random);
  return d;
}

/// A ball, a capsule, a box, a hull or a triangle, some of them rounded.
inline shape::ConvexDescription RandomPolytope(Random& random, double size) {
  const auto kind = random.Below(5);
  shape::ConvexDescription d = RandomBox(random, size);
  if (kind == 0) d.core = geometry::ConvexCore::kPoint;
  if (kind == 1) d.core = geometry::ConvexCore::kSegment;
  if (kind == 3) d = RandomHull(random, size, 4 + random.Below(6));
  if (kind == 4) d = RandomHull(random, size, 3);
  if (kind < 2 || random.Chance(0.2)) d.rounding = size * random.Uniform(0.01, 0.5);
  d.p_BS = size * random.UnitVector();
  return d;
}

inline shape::ConvexDescription LatticePolytope(Random& random) {
  const auto whole = [&random](int most) { return static_cast<double>(random.Below(most + 1)); };
  shape::ConvexDescription d;
  d.core = random.Chance(0.5) ? geometry::ConvexCore::kBox : geometry::ConvexCore::kHull;
  if (random.Chance(0.2)) d.core = geometry::ConvexCore::kSegment;
  d.half = {whole(2), whole(2), 1 + whole(1)};
  for (auto i = 3 + random.Below(5); d.core == geometry::ConvexCore::kHull && i > 0; --i) {
    d.points.push_back({whole(2) - 1, whole(2) - 1, whole(2) - 1});
  }
  if (random.Chance(0.2)) d.rounding = whole(2);
  d.p_BS = {whole(1), whole(1), whole(1)};
  if (RefusalOf(d)) return LatticePolytope(random);
  return d;
}

class ConvexCase {
 public:
  ConvexCase(const shape::ConvexDescription& a, const shape::ConvexDescription& b)
      : description_a_(a),
        description_b_(b),
        a_(shape::ConvexSolid::Build(a)),
        b_(shape::ConvexSolid::Build(b)) {
    EXPECT_FALSE(RefusalOf(a)) << *RefusalOf(a);
    EXPECT_FALSE(RefusalOf(b)) << *RefusalOf(b);
  }

  /// The pose is that of the matrix computed, exactly.
  void Turn(const Eigen::Quaterniond& q, const Eigen::Vector3d& offset) {
    pose_ = narrow_phase::PoseOf(RotationOf(numeric::UnitQuaternion(q)).matrix, offset);
  }

  /// Along the shortest way that they are found apart by, until it is about `gap` long.
  void MoveTo(double gap) {
    for (int i = 0; i < 3; ++i) {
      const narrow_phase::ConvexSeparation found = Ask();
      pose_ = narrow_phase::PoseOf(pose_.R_AB,
                                   pose_.p_AB + (gap - found.separation.middle()) * found.normal);
    }
  }

  /// As their bodies have them, and where B is.
  const geometry::ConvexSet& OfA() const { return a_.set(); }
  const geometry::ConvexSet& OfB() const { return b_.set(); }
  const narrow_phase::RelativePose& pose() const { return pose_; }
  Exact Rounding() const { return Exact(description_a_.rounding) + Exact(description_b_.rounding); }

  geometry::ConvexSet SetA() const { return PosedA(a_.set(), pose_); }
  geometry::ConvexSet SetB() const { return PosedB(b_.set(), pose_); }
  ExactPoints CornersA() const { return ExactCorners(description_a_); }
  ExactPoints CornersB() const {
    return Placed(ExactCorners(description_b_), PlacementOf(pose_.R_AB, pose_.p_AB));
  }

  narrow_phase::ConvexSeparation Ask(const narrow_phase::ConvexQuery& query = {}) const {
    WorkBudget work(1000000);
    geometry::GjkHint hint;
    return SeparationOf(SetA(), SetB(), query, &hint, &work);
  }

  double Size() const {
    const geometry::ConvexSet a = SetA(), b = SetB();
    return geometry::ConvexPair(a, b).size() + a.centre.norm() + b.centre.norm() + a.rounding +
           b.rounding;
  }

  /// What is found is contained; the exact squared distance of the cores is returned (0: they
  /// meet).
  Exact Contained() const {
    const narrow_phase::ConvexSeparation found = Ask();
    const ExactVector nearest = NearestToZero(Difference(CornersA(), CornersB()));
    const Exact square = Square(nearest), rounding = Rounding();
    EXPECT_LE(found.separation.lower, found.separation.upper);
    if (square > 0 || found.separation.upper >= 0) {
      EXPECT_TRUE(IsAtLeast(found.separation.upper, square, rounding)) << found.separation.upper;
    }
    EXPECT_TRUE(IsAtMost(found.separation.lower, square, rounding)) << found.separation.lower;
    if (square > 0) CheckNormal(found, nearest);
    narrow_phase::ConvexQuery coarse;
    coarse.relative_tolerance = 0.05;
    if (square > 0) CheckNormal(Ask(coarse), nearest);
    return square;
  }

  /// Contained, and no wider than `width` of the pair's size.
  void Check(double width) const {
    Contained();
    const narrow_phase::ConvexSeparation found = Ask();
    EXPECT_LE(found.separation.width(), width * Size()) << found.separation.lower;
    EXPECT_FALSE(found.exhausted);
    EXPECT_LT(found.point_error, numeric::kInfinity);
    CheckPoints(found);
    // A coarser query: the points are less exact, and the answer says so.
    for (const narrow_phase::ConvexGoal goal :
         {narrow_phase::ConvexGoal::kYesNo, narrow_phase::ConvexGoal::kDistance}) {
      CheckPoints(Ask({goal, 0, 0}));
    }
    if (testing::Test::HasFailure()) FAIL();
  }

  /// Likewise where the two may overlap: the depth is known from both sides.
  void CheckDepth(double width) const {
    Check(width);
    const Exact square = Contained();
    if (square > 0) return;
    const narrow_phase::ConvexSeparation found = Ask();
    const ExactPoints corners_a = CornersA(), corners_b = CornersB();
    const Exact depth = SquareOfDepth(corners_a, corners_b, Directions());
    // −depth − rounding lies in the interval.
    EXPECT_TRUE(IsAtMost(-found.separation.upper, depth, -Rounding())) << found.separation.upper;
    EXPECT_TRUE(IsAtLeast(-found.separation.lower, depth, -Rounding())) << found.separation.lower;
    if (testing::Test::HasFailure()) FAIL();
  }

 private:
  ExactPoints Directions() const {
    const ExactPlacement pose = PlacementOf(pose_.R_AB, pose_.p_AB);
    const ExactPoints a = EdgeDirections(description_a_, ExactPlacement());
    const ExactPoints b = EdgeDirections(description_b_, pose);
    if (a.empty() || b.empty()) return FaceDirections(CornersA(), CornersB());
    ExactPoints directions;
    for (const ExactPoints* edges : {&a, &b}) {
      for (std::size_t i = 0; i < edges->size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) directions.push_back(Cross((*edges)[i], (*edges)[j]));
      }
    }
    for (const ExactVector& x : a) {
      for (const ExactVector& y : b) directions.push_back(Cross(x, y));
    }
    return directions;
  }

  /// The angle between the normal and the exact way: tan θ by cross and dot products, θ <= tan θ.
  void CheckNormal(const narrow_phase::ConvexSeparation& found, const ExactVector& way) const {
    const ExactVector n(found.normal);
    if (found.normal_error >= 1) return;
    const Exact dot = Dot(n, way);
    const Exact allowed = Exact(found.normal_error) * Exact(found.normal_error) * dot * dot;
    EXPECT_GT(dot, 0);
    // θ <= e < 1 is certain if sin θ <= e cos θ fails only beyond tan e: allow tan e <= 1.56 e.
    EXPECT_LE(Square(Cross(n, way)), allowed * Exact(2.5));
  }

  /// Each point belongs to its solid, to within its error; apart they are no further apart than
  /// said.
  void CheckPoints(const narrow_phase::ConvexSeparation& found) const {
    const double error = found.point_error;
    if (error == numeric::kInfinity) return;
    const auto belongs = [&](const Eigen::Vector3d& x, const ExactPoints& corners,
                             double rounding) {
      const Exact square = Square(NearestToZero(Difference({ExactVector(x)}, corners)));
      return IsAtLeast(error, square, Exact(rounding));
    };
    EXPECT_TRUE(belongs(found.a, CornersA(), description_a_.rounding)) << error;
    EXPECT_TRUE(belongs(found.b, CornersB(), description_b_.rounding)) << error;
    if (found.separation.upper <= 0) {
      EXPECT_EQ(found.a, found.b);
    } else {
      EXPECT_LE((found.b - found.a).norm(), found.separation.upper + 2 * error);
    }
  }

  shape::ConvexDescription description_a_, description_b_;
  shape::ConvexSolid a_, b_;
  narrow_phase::RelativePose pose_;
};

}  // namespace collision
