// Where two segments (or points) are nearest, in closed form. After Ericson, "Real-time collision
// detection", 2005, section 5.1.9, with the segments' middles as origins.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision_core/shape/convex_search.h"

namespace collision {
namespace {

using Eigen::Vector3d;

/// NaN gives 0.
double Clamp(double t) { return t > -1 ? std::min(t, 1.0) : (t <= -1 ? -1 : 0); }

Vector3d AxisOf(const ConvexSet& set) {
  return set.core == ConvexCore::kSegment ? Vector3d(set.generators.col(0)) : Vector3d(0, 0, 0);
}

/// d leads from the middle of one to that of the other; s and t are in [−1, 1] along the half axes
/// g and h, so that d + t h − s g is shortest.
struct Fractions {
  double s, t;
};
Fractions FractionsOf(const Vector3d& d, const Vector3d& g, const Vector3d& h) {
  const double gg = g.squaredNorm(), hh = h.squaredNorm(), gh = g.dot(h);
  const double gd = g.dot(d), hd = h.dot(d);
  if (!(gg > 0)) return {0, hh > 0 ? Clamp(-hd / hh) : 0};
  if (!(hh > 0)) return {Clamp(gd / gg), 0};
  const double denominator = gg * hh - gh * gh;
  const double s = denominator > 0 ? Clamp((gd * hh - gh * hd) / denominator) : 0;
  const double t = Clamp((s * gh - hd) / hh);
  return {Clamp((gd + t * gh) / gg), t};
}

/// Takes out what rounding left along an axis that the way must be square to.
void TakeOut(const Vector3d& axis, double fraction, Vector3d* way) {
  const double square = axis.squaredNorm();
  if (square > 0 && std::abs(fraction) < 1) *way -= way->dot(axis) / square * axis;
}

}  // namespace

void NearestOfSegments(const ConvexPair& pair, SearchResult* found) {
  const Vector3d g = AxisOf(pair.a()), h = AxisOf(pair.b());
  const auto [s, t] = FractionsOf(pair.between(), g, h);
  SearchResult& result = *found;
  ConvexPair::Point& point = result.simplex[0];
  point = pair.At({Vector3d(s, 0, 0), Vector3d(t, 0, 0)});
  result.weights[0] = 1;
  result.count = 1;
  result.steps = 1;
  result.nearest = result.direction = point.y;
  if (std::abs(s) < 1 && std::abs(t) < 1) {
    // Square to both: the way is so short that its own direction may be nothing but rounding.
    const Vector3d across = g.cross(h);
    const double square = across.squaredNorm();
    const Vector3d along = square > 0 ? Vector3d(across * (across.dot(point.y) / square)) : point.y;
    if (along.squaredNorm() > 0) result.direction = along;
  }
  TakeOut(g, s, &result.direction);
  TakeOut(h, t, &result.direction);
}

}  // namespace collision
