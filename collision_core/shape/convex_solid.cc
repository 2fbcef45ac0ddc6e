#include "collision_core/shape/convex_solid.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/geometry/convex/epa.h"
#include "collision_core/geometry/triangle/enclosing_ball.h"
#include "collision_core/numeric/interval.h"
#include "collision_core/numeric/rotation.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

double LengthUp(const Vector3d& v) { return numeric::Norm(numeric::IntervalVector(v)).upper; }

/// The rotation of q; exactly the identity if q has no vector part.
numeric::Rotation RotationOf(const Eigen::Quaterniond& q) {
  if (q.vec().isZero(0)) return {};
  return RotationOf(numeric::UnitQuaternion(q));
}

/// A vector computed in intervals, and how far it may be from the exact one.
struct Rounded {
  Vector3d value;
  double error;
};

Rounded RoundedOf(const numeric::IntervalVector& v) {
  const Vector3d middle = v.middle();
  return {middle, numeric::Norm(v - numeric::IntervalVector(middle)).upper};
}

Rounded Placed(const numeric::Rotation& rotation, const Vector3d& x, const Vector3d& offset) {
  const auto row = [&](int i) {
    return Dot(numeric::IntervalVector(Vector3d(rotation.matrix.row(i))),
               numeric::IntervalVector(x)) +
           numeric::Interval(offset[i]);
  };
  Rounded placed = RoundedOf({row(0), row(1), row(2)});
  placed.error = numeric::AddUp(placed.error, numeric::MultiplyUp(rotation.error, LengthUp(x)));
  return placed;
}

/// Half a generator along the core's own axes: a segment lies along z, its first generator.
Vector3d HalfOf(const ConvexDescription& d, int generator) {
  if (d.core == geometry::ConvexCore::kSegment) {
    return generator == 0 ? Vector3d(0, 0, d.half.z()) : Vector3d(0, 0, 0);
  }
  return d.half[generator] * Vector3d::Unit(generator);
}

void SetGenerators(const ConvexDescription& d, const numeric::Rotation& rotation,
                   geometry::ConvexSet* set) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d half = HalfOf(d, i);
    const Rounded generator = Placed(rotation, half, Vector3d::Zero());
    set->generators.col(i) = generator.value;
    set->error = numeric::AddUp(set->error, generator.error);
    set->span = numeric::AddUp(set->span, LengthUp(generator.value));
  }
}

/// The points seen from the middle of their box: where the body's origin is counts for nothing.
std::shared_ptr<const geometry::ConvexPoints> SetPoints(const ConvexDescription& d,
                                                        const numeric::Rotation& rotation,
                                                        geometry::ConvexSet* set) {
  Vector3d lower = d.points[0], upper = d.points[0];
  for (const Vector3d& p : d.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  const Vector3d middle = 0.5 * lower + 0.5 * upper;
  std::vector<Vector3d> seen;
  seen.reserve(d.points.size());
  double lost = 0;
  for (const Vector3d& p : d.points) {
    const Rounded from_middle =
        RoundedOf(numeric::IntervalVector(p) - numeric::IntervalVector(middle));
    lost = std::max(lost, from_middle.error);
    seen.push_back(from_middle.value);
  }
  auto points = std::make_shared<const geometry::ConvexPoints>(seen);
  const Rounded centre = Placed(rotation, middle, d.p_BS);
  set->centre = centre.value;
  set->generators = rotation.matrix;
  set->span = 2 * points->reach();
  set->error = numeric::AddUp(numeric::AddUp(lost, centre.error),
                              numeric::MultiplyUp(rotation.error, points->reach()));
  set->points = points.get();
  return points;
}

/// Corners in the body frame, none where it is curved; off by less than kSupportError span.
std::vector<Vector3d> CornersOf(const geometry::ConvexSet& set) {
  std::vector<Vector3d> corners;
  const auto add = [&](const Vector3d& seen) { corners.push_back(set.centre + seen); };
  const Eigen::Matrix3d& g = set.generators;
  switch (set.core) {
    case geometry::ConvexCore::kEllipsoid:
    case geometry::ConvexCore::kCylinder:
    case geometry::ConvexCore::kCone:
      break;
    case geometry::ConvexCore::kPoint:
      add(Vector3d::Zero());
      break;
    case geometry::ConvexCore::kSegment:
      for (const int sign : {-1, 1}) add(sign * g.col(0));
      break;
    case geometry::ConvexCore::kTriangle:
      for (int i = 0; i < 3; ++i) add(g.col(i));
      break;
    case geometry::ConvexCore::kBox:
      for (int i = 0; i < 8; ++i) {
        add(g * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
      }
      break;
    case geometry::ConvexCore::kHull:
      for (std::uint32_t i = 0; i < set.points->size(); ++i) add(g * (*set.points)[i]);
      break;
  }
  return corners;
}

/// Relative to |c| and the span: the last sum of a computed corner is off by 2^-53 of each
/// coordinate; twice that. What comes before is within kSupportError.
constexpr double kCornerRounding = 0x1p-52;

/// What any computed corner, seen from the origin, may be off by.
double CornerError(const geometry::ConvexSet& set) {
  const double rounding =
      numeric::MultiplyUp(kCornerRounding, numeric::AddUp(LengthUp(set.centre), set.span));
  return numeric::AddUp(
      numeric::AddUp(rounding, numeric::MultiplyUp(geometry::kSupportError, set.span)), set.error);
}

void SetBalls(const geometry::ConvexSet& set, double reach, ConvexFacts* facts) {
  const std::vector<Vector3d> corners = CornersOf(set);
  const double more = numeric::AddUp(CornerError(set), set.rounding);
  facts->ball_centre = set.centre;
  facts->ball_radius = numeric::AddUp(reach, more);
  facts->radius = numeric::AddUp(LengthUp(set.centre), facts->ball_radius);
  if (corners.empty()) return;
  const geometry::EnclosingBall ball = geometry::SmallBallAround(corners);
  const double radius = numeric::AddUp(ball.radius, more);
  if (radius < facts->ball_radius) facts->ball_centre = ball.centre, facts->ball_radius = radius;
  double furthest = 0;
  for (const Vector3d& corner : corners) furthest = std::max(furthest, LengthUp(corner));
  facts->radius = numeric::AddUp(furthest, more);
}

void SetBox(const geometry::ConvexSet& set, ConvexFacts* facts) {
  const double more = numeric::AddUp(CornerError(set), set.rounding);
  for (int i = 0; i < 3; ++i) {
    const Vector3d n = Vector3d::Unit(i);
    facts->upper[i] = numeric::AddUp(set.centre[i] + set.SupportPoint(n)[i], more);
    facts->lower[i] = numeric::AddDown(set.centre[i] + set.SupportPoint(-n)[i], -more);
  }
}

/// A ball in the core about its centre, known from its measures. Half-way up a cone with radius r
/// and height 2h the axis is r h / √(r² + 4h²) away from the side, which is less than h.
double CoreInradius(const ConvexDescription& d) {
  if (d.core == geometry::ConvexCore::kCone) {
    const numeric::Interval r = d.half.x(), h = d.half.z();
    const numeric::Interval side = numeric::Sqrt(Square(r) + Square(numeric::Interval(2) * h));
    return side.lower > 0 ? (r * h / side).lower : 0;
  }
  const bool known = d.core == geometry::ConvexCore::kBox ||
                     d.core == geometry::ConvexCore::kEllipsoid ||
                     d.core == geometry::ConvexCore::kCylinder;
  return known ? d.half.minCoeff() : 0;
}

/// No point of the core is farther from its centre.
double CoreReach(const ConvexDescription& d, const geometry::ConvexSet& set) {
  if (d.core == geometry::ConvexCore::kEllipsoid) return d.half.maxCoeff();
  if (set.IsTurned()) return LengthUp({d.half.x(), 0, d.half.z()});
  return set.span;
}

void SetInside(const ConvexDescription& d, const geometry::ConvexSet& set, ConvexFacts* facts) {
  facts->inner_point = set.centre;
  facts->inradius =
      std::max(0.0, numeric::AddDown(numeric::AddDown(CoreInradius(d), -set.error), set.rounding));
  if (d.core == geometry::ConvexCore::kHull) {
    const geometry::InscribedBall inside = LargeBallInside(set);
    facts->inner_point = inside.centre;
    const double radius = numeric::AddDown(inside.radius, -set.error);
    facts->inradius =
        std::max(0.0, numeric::AddDown(std::max(0.0, radius), set.rounding - set.error));
  }
}

}  // namespace

ConvexSolid ConvexSolid::Build(const ConvexDescription& d) {
  CORE_CHECK(!RefusalOf(d), "a solid has a description that is not refused");
  return BuildOfAnySize(d);
}

ConvexSolid ConvexSolid::BuildOfAnySize(const ConvexDescription& d) {
  ConvexSolid solid;
  const numeric::Rotation rotation = RotationOf(d.q_BS);
  geometry::ConvexSet& set = solid.set_;
  set.core = d.core;
  set.rounding = d.rounding;
  double reach = 0;
  if (d.core == geometry::ConvexCore::kHull) {
    solid.points_ = SetPoints(d, rotation, &set);
    reach = solid.points_->reach();
  } else {
    set.centre = d.p_BS;
    if (d.core != geometry::ConvexCore::kPoint) SetGenerators(d, rotation, &set);
    reach = CoreReach(d, set);
  }
  SetBalls(set, reach, &solid.facts_);
  SetBox(set, &solid.facts_);
  SetInside(d, set, &solid.facts_);
  return solid;
}

// Its core is the same, so that every fact changes by what the rounding does. An inner point that
// is not certain stays so.
ConvexSolid ConvexSolid::Grown(double more) const {
  CORE_CHECK(more >= 0 && more < numeric::kInfinity, "a solid grows by a finite length", more);
  ConvexSolid grown = *this;
  double& rounding = grown.set_.rounding;
  rounding = numeric::AddUp(rounding, more);
  const double added = numeric::AddUp(rounding, -set_.rounding);
  ConvexFacts& facts = grown.facts_;
  facts.radius = numeric::AddUp(facts.radius, added);
  facts.ball_radius = numeric::AddUp(facts.ball_radius, added);
  for (int axis = 0; axis < 3; ++axis) {
    facts.lower[axis] = numeric::AddDown(facts.lower[axis], -added);
    facts.upper[axis] = numeric::AddUp(facts.upper[axis], added);
  }
  if (facts.inradius > 0) {
    facts.inradius = numeric::AddDown(facts.inradius, numeric::AddDown(rounding, -set_.rounding));
  }
  return grown;
}

}  // namespace collision::shape
