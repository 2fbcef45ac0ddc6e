#include "collision_core/geometry/convex/epa.h"

#include <Eigen/Geometry>
#include <cmath>

#include "collision_core/geometry/convex/epa_faces.h"
#include "collision_core/numeric/allowances.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;
using Point = ConvexPair::Point;

/// A difference whose height is less than this share of S counts as flat.
constexpr double kFlat = 64 * numeric::kUnitRoundoff;

/// A face is final where the difference reaches beyond it by less than this share of S; where it is
/// smooth, a finer face would be too small for its normal to be known.
constexpr double kFinal = 4 * numeric::kUnitRoundoff;
constexpr double kFinalSmooth = 0x1p-40;

/// A point that is beyond a face of the first tetrahedron by less than this share of S counts as in
/// its plane: differences, products with its normal and their sums, a rounding each.
constexpr double kInPlane = 8 * numeric::kUnitRoundoff;

/// After this many steps each the certain radius is recorded, in case the surface degenerates
/// later.
constexpr std::uint32_t kCheckEvery = 16;

/// Finds four points of the difference that are not in one plane, from the simplex that GJK left.
class Tetrahedron {
 public:
  Tetrahedron(const ConvexPair& pair, const GjkResult& start, Overlap* overlap)
      : pair_(pair), overlap_(*overlap), flat_(kFlat * pair.size()) {
    points[0] = start.simplex[0];
    found_ = Complete(start);
  }

  explicit operator bool() const { return found_; }
  std::array<Point, 4> points;
  Vector3d normal{0, 0, 0};  ///< Of the plane that all lie in, where they do.

 private:
  bool Complete(const GjkResult& start) {
    Vector3d edge = Vector3d::Zero();
    TakeFrom(start, 1, [](const Vector3d& d) { return d.norm(); });
    for (int axis = 0; axis < 3 && Height() <= flat_; ++axis) {
      TakeAlong(1, Vector3d::Unit(axis), [](const Vector3d& d) { return d.norm(); });
    }
    if (Height() <= flat_) return false;
    edge = (points[1].y - points[0].y).normalized();
    const auto from_line = [&](const Vector3d& d) { return d.cross(edge).norm(); };
    TakeFrom(start, 2, from_line);
    int least = 0;
    edge.cwiseAbs().minCoeff(&least);
    const Vector3d across = edge.cross(Vector3d::Unit(least)).normalized();
    if (Height() <= flat_) TakeAlong(2, across, from_line);
    if (Height() <= flat_) TakeAlong(2, edge.cross(across), from_line);
    normal = across;
    if (Height() <= flat_) return false;
    normal = edge.cross(points[2].y - points[0].y).normalized();
    const auto from_plane = [&](const Vector3d& d) { return std::abs(d.dot(normal)); };
    TakeFrom(start, 3, from_plane);
    if (Height() <= flat_) TakeAlong(3, normal, from_plane);
    return Height() > flat_;
  }

  double Height() const { return height_; }

  template <typename Measure>
  void TakeFrom(const GjkResult& start, int at, const Measure& measure) {
    height_ = 0;
    for (int i = 1; i < start.count; ++i) TakeIfHigher(start.simplex[i], at, measure);
  }

  template <typename Measure>
  void TakeAlong(int at, const Vector3d& n, const Measure& measure) {
    TakeIfHigher(pair_.Against(n), at, measure);
    TakeIfHigher(pair_.Against(-n), at, measure);
    overlap_.steps += 2;
  }

  template <typename Measure>
  void TakeIfHigher(const Point& point, int at, const Measure& measure) {
    const double height = measure(point.y - points[0].y);
    if (height > height_) points[at] = point, height_ = height;
  }

  const ConvexPair& pair_;
  Overlap& overlap_;
  const double flat_;
  double height_ = 0;
  bool found_ = false;
};

class Growth {
 public:
  Growth(const ConvexPair& pair, const EpaGoal& goal, Overlap* overlap)
      : pair_(pair),
        goal_(goal),
        overlap_(*overlap),
        final_((pair.IsSmooth() ? kFinalSmooth : kFinal) * pair.size()) {}

  void Run(const std::array<Point, 4>& tetrahedron) {
    faces_.Start(tetrahedron, kInPlane * pair_.size());
    while (overlap_.steps < goal_.steps) {
      const int nearest = faces_.Nearest();
      if (nearest < 0 || IsGoodEnough(faces_.DistanceOf(nearest))) break;
      const Vector3d outward = faces_.NormalOf(nearest);
      const Point found = pair_.Against(-outward);
      ++overlap_.steps;
      const double reach = outward.dot(found.y);
      if (reach < least_) least_ = reach, overlap_.direction = -outward;
      if (reach < 0) return;  // Apart: nothing is inside.
      if (overlap_.steps % kCheckEvery == 0) PutDown();
      const bool grows = reach - faces_.DistanceOf(nearest) > final_;
      if (!grows || !faces_.Add(nearest, found)) faces_.SetFinal(nearest);
    }
    PutDown();
  }

 private:
  void PutDown() {
    const double certain = faces_.CertainInnerRadius(pair_.PointError(), pair_.size());
    overlap_.inside = std::max(overlap_.inside, certain);
  }

  bool IsGoodEnough(double distance) const {
    const double width =
        std::max({goal_.absolute_tolerance, goal_.relative_tolerance * distance, final_});
    return least_ - distance <= width || distance - 2 * pair_.PointError() > goal_.inside;
  }

  const ConvexPair& pair_;
  const EpaGoal& goal_;
  Overlap& overlap_;
  const double final_;
  double least_ = numeric::kInfinity;  ///< Of all outward reaches.
  PolytopeFaces faces_;
};

/// For a flat difference only the direction perpendicular to it is returned.
void TryAcross(const ConvexPair& pair, const Vector3d& normal, Overlap* overlap) {
  if (!(normal.squaredNorm() > 0)) return;
  const double ahead = normal.dot(pair.Against(normal).y);
  const double behind = -normal.dot(pair.Against(-normal).y);
  overlap->steps += 2;
  overlap->direction = ahead >= behind ? normal : -normal;
}

constexpr int kBallSteps = 24;

Vector3d MiddleOf(const ConvexSet& set) {
  if (set.core != ConvexCore::kHull) return set.centre;
  Vector3d mean = Vector3d::Zero();
  for (std::uint32_t i = 0; i < set.points->size(); ++i) mean += (*set.points)[i];
  return set.centre + set.PointAt(mean / static_cast<double>(set.points->size()));
}

}  // namespace

Overlap RunEpa(const ConvexPair& pair, const GjkResult& start, const EpaGoal& goal) {
  Overlap overlap;
  const Tetrahedron tetrahedron(pair, start, &overlap);
  if (!tetrahedron) {
    TryAcross(pair, tetrahedron.normal, &overlap);
    return overlap;
  }
  Growth(pair, goal, &overlap).Run(tetrahedron.points);
  return overlap;
}

// Moves the centre away from the nearest face, by steps that are halved where they do not help.
InscribedBall LargeBallInside(const ConvexSet& set) {
  InscribedBall best{MiddleOf(set), 0};
  Vector3d centre = best.centre, away = Vector3d::Zero();
  double step = set.span / 4;
  for (int i = 0; i < kBallSteps; ++i) {
    const ConvexSet point = BallSet(centre, 0);
    const ConvexPair pair(point, set);
    GjkResult start;
    start.simplex[0] = pair.Against(Vector3d::UnitX());
    start.count = 1;
    const Overlap overlap = RunEpa(pair, start, {});
    if (overlap.inside > best.radius) {
      best = {centre, overlap.inside};
      away = overlap.direction;  // From the point to what is nearest, turned round.
    } else {
      step /= 2;
    }
    centre = best.centre + step * away;
  }
  return best;
}

}  // namespace collision::geometry
