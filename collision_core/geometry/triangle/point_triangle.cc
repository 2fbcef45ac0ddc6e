#include "collision_core/geometry/triangle/point_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Height over longest edge, squared, below which rounding may put a point above the inside on the
/// wrong side of an edge: then the edges are tried as well.
constexpr double kSliver = 1e-6;

/// A point of the triangle: corners[base] + s (corners[base + 1] − …) + t (corners[base + 2] − …).
struct Weights {
  int base = 0;
  double s = 0, t = 0;
};

Vector3d At(const TrianglePoints& corners, const Weights& w) {
  const Vector3d& a = corners[w.base];
  return a + w.s * (corners[(w.base + 1) % 3] - a) + w.t * (corners[(w.base + 2) % 3] - a);
}

/// s, t >= 0 and s + t <= 1 exactly: a point of the triangle. The corner with most weight becomes
/// the base, so that a corner is met exactly.
Weights Normalised(std::array<double, 3> w) {
  for (double& x : w) x = x > 0 ? std::min(x, 1.0) : 0;
  Weights result;
  result.base = static_cast<int>(std::max_element(w.begin(), w.end()) - w.begin());
  result.s = w[(result.base + 1) % 3];
  result.t = std::min(w[(result.base + 2) % 3], numeric::AddDown(1, -result.s));
  return result;
}

struct Candidate {
  Weights weights;
  double distance2 = numeric::kInfinity;
};

void Offer(const Vector3d& p, const TrianglePoints& corners, const std::array<double, 3>& weights,
           Candidate* best) {
  const Weights w = Normalised(weights);
  const double distance2 = (p - At(corners, w)).squaredNorm();
  if (distance2 < best->distance2) *best = {w, distance2};
}

/// n without its part along `edge`; twice, so that what is left of it is small against n itself.
Vector3d Across(Vector3d n, const Vector3d& edge) {
  for (int i = 0; i < 2; ++i) n -= n.dot(edge) / edge.squaredNorm() * edge;
  return n;
}

/// The corner at which the longest edge begins.
int LongestEdge(const TrianglePoints& corners) {
  int longest = 0;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    const double length2 = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
    if (length2 > most) most = length2, longest = i;
  }
  return longest;
}

/// About the nearest point. Any point of the triangle would do for a certified bound: this one
/// makes it tight. The triangle is measured along its longest edge and across it: the part across
/// is wrong by a share of a sliver's small height, and the part along makes up for it.
Candidate Nearest(const Vector3d& p, const TrianglePoints& corners, int longest) {
  Candidate best;
  const int next = (longest + 1) % 3, last = (longest + 2) % 3;
  const Vector3d edge = corners[next] - corners[longest];
  const Vector3d side = corners[last] - corners[longest], w = p - corners[longest];
  const Vector3d height = Across(side, edge);
  const double length2 = edge.squaredNorm(), height2 = height.squaredNorm();
  const double t = Across(w, edge).dot(height) / height2;
  const double s = (w.dot(edge) - t * side.dot(edge)) / length2;
  if (s >= 0 && t >= 0 && s + t <= 1) {
    std::array<double, 3> weights = {};
    weights[longest] = 1 - s - t;
    weights[next] = s;
    weights[last] = t;
    Offer(p, corners, weights, &best);
    if (height2 > kSliver * length2) return best;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vector3d e = corners[j] - corners[i];
    const double share = std::clamp((p - corners[i]).dot(e) / e.squaredNorm(), 0.0, 1.0);
    std::array<double, 3> weights = {};
    weights[i] = 1 - share;
    weights[j] = share;
    Offer(p, corners, weights, &best);
  }
  return best;
}

numeric::Interval UpperOf(const Vector3d& p, const TrianglePoints& corners, const Weights& w) {
  const numeric::IntervalVector a(corners[w.base]);
  const numeric::IntervalVector u = numeric::IntervalVector(corners[(w.base + 1) % 3]) - a;
  const numeric::IntervalVector v = numeric::IntervalVector(corners[(w.base + 2) % 3]) - a;
  return numeric::Norm(((numeric::IntervalVector(p) - a) - numeric::Interval(w.s) * u) -
                       numeric::Interval(w.t) * v);
}

/// A lower bound of the distance for any n: the triangle lies behind the plane across n through its
/// foremost corner, so the distance is at least the least n · (p − corner) / |n|.
double LowerAlong(const Vector3d& n, const Vector3d& p, const TrianglePoints& corners) {
  if (!(n.squaredNorm() > 0) || !std::isfinite(n.squaredNorm())) return 0;
  const numeric::IntervalVector direction(n), point(p);
  double least = numeric::kInfinity;
  for (const Vector3d& corner : corners) {
    least = std::min(least, Dot(direction, point - numeric::IntervalVector(corner)).lower);
  }
  if (!(least > 0)) return 0;
  return numeric::DivideDown(least, numeric::Norm(direction).upper);
}

/// Towards the nearest point is the best direction, but close to the triangle it is rounded away;
/// then the normal is better, or the direction across an edge. The normal of a sliver is rounded,
/// too: what matters is that it stands across the longest edge.
double LowerOf(const Vector3d& p, const TrianglePoints& corners, const Vector3d& nearest,
               int longest, double upper) {
  constexpr double kGoodEnough = 1 - 1e-14;
  double lower = LowerAlong(p - nearest, p, corners);
  if (lower >= kGoodEnough * upper) return lower;
  const Vector3d edge = corners[(longest + 1) % 3] - corners[longest];
  const Vector3d normal = Across(edge.cross(corners[(longest + 2) % 3] - corners[longest]), edge);
  const bool is_below = normal.dot(p - corners[longest]) < 0;
  lower = std::max(lower, LowerAlong(is_below ? Vector3d(-normal) : normal, p, corners));
  for (int i = 0; i < 3 && lower < kGoodEnough * upper; ++i) {
    const Vector3d side = corners[(i + 1) % 3] - corners[i];
    lower = std::max(lower, LowerAlong(Across(p - nearest, side), p, corners));
  }
  return lower;
}

}  // namespace

PointTriangleDistance DistanceToTriangle(const Vector3d& p, const TrianglePoints& corners) {
  const int longest = LongestEdge(corners);
  const Candidate best = Nearest(p, corners, longest);
  PointTriangleDistance result;
  result.nearest = At(corners, best.weights);
  result.distance.upper = UpperOf(p, corners, best.weights).upper;
  result.distance.lower = std::min(
      result.distance.upper, LowerOf(p, corners, result.nearest, longest, result.distance.upper));
  return result;
}

bool IsCertainlyFarther(const Vector3d& p, const TrianglePoints& corners, double distance) {
  const Candidate best = Nearest(p, corners, LongestEdge(corners));
  const Vector3d n = p - At(corners, best.weights);
  const double length = n.norm();
  // Below, products may underflow; beyond, overflow.
  constexpr double kLengthMin = 1e-100, kLengthMax = 1e100;
  if (!(length > kLengthMin && length < kLengthMax)) return false;
  // As LowerAlong(), in plain doubles. A computed n · (p − corner) is off by at most 4.1 u |n| |p −
  // corner| (one rounding of the difference, one of the product, two of the sum), u = 2^−53; the
  // length by 3.1 u, the quotient by u of at most |p − corner|: 16 u of the farthest covers all.
  constexpr double kQuotientError = 0x1p-49;
  double least = numeric::kInfinity, farthest2 = 0;
  for (const Vector3d& corner : corners) {
    const Vector3d d = p - corner;
    least = std::min(least, n.dot(d));
    farthest2 = std::max(farthest2, d.squaredNorm());
  }
  return least / length - kQuotientError * std::sqrt(farthest2) > distance;
}

}  // namespace collision::geometry
