// How far two triangles are apart.
//
// A search in plain doubles proposes the nearest points and a direction; nothing is taken from it
// on trust. The upper end is the length between two points that belong to the triangles for
// certain, the lower end the gap between the triangles' projections on a line, which is never more
// than the distance, whatever the line. For convex sets both are the distance when the proposal is
// right.
//
// Everything is seen from the first corner, so that coordinates far from the origin cost nothing.
// With ε = 2^-53 and S_a, S_b the greatest coordinates of the two triangles seen from there:
//
//   upper  A point is Σ w_i x_i with weights w_i >= 0 whose sum is 1 to within 2ε; the exact point
//          Σ w_i x_i / Σ w_i belongs to the triangle. Per coordinate the computed one is off by
//          4ε S (difference, product, two sums) and 2ε S (the weights' sum). The difference of two
//          points adds ε (S_a + S_b): together 7.1ε (S_a + S_b) a coordinate, √3 times that in
//          length, plus 3ε of the length itself, at most √3 (S_a + S_b): < 18ε (S_a + S_b).
//   lower  n·x is off by 4ε |n|₁ S; the gap of two such by 4ε |n|₁ (S_a + S_b) plus ε of itself:
//          < 5.1ε |n|₁ (S_a + S_b).
//
// The constants below leave room for the second order and for their own rounding. Overflow makes
// infinities and NaN, against which every comparison falls to the safe side.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision_core/geometry/triangle/triangle_pair.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

constexpr double kUpperSlack = 20 * numeric::kUnitRoundoff;  ///< Of S_a + S_b.
constexpr double kLowerSlack = 6 * numeric::kUnitRoundoff;   ///< Of |n|₁ (S_a + S_b).
/// A quotient and a root of values rounded a few times: the lower end is taken down by this.
constexpr double kShrink = 1 - 16 * numeric::kUnitRoundoff;
/// Squares of lengths below 2^-530 underflow; they may count as zero, so the upper end adds more.
constexpr double kUnderflow = 0x1p-500;
/// The least n² of a direction in use: products of shorter ones would underflow.
constexpr double kDirectionMin = 0x1p-700;
/// A bracket narrower than this times S_a + S_b is as good as the arithmetic: no other direction is
/// tried.
constexpr double kTight = 64 * numeric::kUnitRoundoff;

constexpr int kNext[3] = {1, 2, 0};

/// A triangle seen from the common origin.
struct Local {
  Vector3d corner[3], edge[3];  ///< Edge i leads from corner i to the next.
  double edge_square[3];
  Vector3d normal;  ///< Not normalised.
  double normal_square;
  double size;  ///< S: the greatest coordinate.
};

Local LocalOf(const TrianglePoints& triangle, const Vector3d& origin) {
  Local local;
  local.size = 0;
  for (int i = 0; i < 3; ++i) {
    local.corner[i] = triangle[i] - origin;
    local.size = std::max(local.size, local.corner[i].cwiseAbs().maxCoeff());
  }
  for (int i = 0; i < 3; ++i) {
    local.edge[i] = triangle[kNext[i]] - triangle[i];
    local.edge_square[i] = local.edge[i].squaredNorm();
  }
  local.normal = local.edge[0].cross(local.edge[1]);
  local.normal_square = local.normal.squaredNorm();
  return local;
}

/// Weights of the corners: each >= 0, their sum 1 to within 2ε.
struct Weights {
  double w[3] = {1, 0, 0};

  static Weights OnEdge(int edge, double t) {
    Weights weights;
    weights.w[0] = 0;
    weights.w[edge] = 1 - t;
    weights.w[kNext[edge]] = t;
    return weights;
  }
};

Vector3d PointAt(const Local& triangle, const Weights& weights) {
  return weights.w[0] * triangle.corner[0] + weights.w[1] * triangle.corner[1] +
         weights.w[2] * triangle.corner[2];
}

/// A proposal: where the two are nearest, and the edges it lies on (or -1).
struct Proposal {
  double square = numeric::kInfinity;
  Weights a, b;
  int edge_a = -1, edge_b = -1;
};

/// NaN gives 0.
double Clamp01(double t) { return t > 0 ? std::min(t, 1.0) : 0; }

/// The nearest points of two segments, as fractions of them. After Ericson, "Real-time collision
/// detection", 2005, section 5.1.9.
struct Fractions {
  double s, t;
};
Fractions NearestOfSegments(const Vector3d& r, const Vector3d& d1, double a, const Vector3d& d2,
                            double e) {
  const double c = d1.dot(r), f = d2.dot(r);
  if (!(e > 0)) return {a > 0 ? Clamp01(-c / a) : 0, 0};
  if (!(a > 0)) return {0, Clamp01(f / e)};
  const double b = d1.dot(d2);
  const double denominator = a * e - b * b;
  const double s = denominator > 0 ? Clamp01((b * f - c * e) / denominator) : 0;
  const double t = b * s + f;
  if (!(t > 0)) return {Clamp01(-c / a), 0};
  if (t >= e) return {Clamp01((b - c) / a), 1};
  return {s, t / e};
}

/// All pairs of edges. True if a pair was met where the third corners lie behind: then nothing is
/// nearer.
bool ProposeEdges(const Local& a, const Local& b, Proposal* best) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector3d r = a.corner[i] - b.corner[j];
      const auto [s, t] =
          NearestOfSegments(r, a.edge[i], a.edge_square[i], b.edge[j], b.edge_square[j]);
      const Vector3d d = t * b.edge[j] - s * a.edge[i] - r;
      const double square = d.squaredNorm();
      if (!(square < best->square)) continue;
      *best = {square, Weights::OnEdge(i, s), Weights::OnEdge(j, t), i, j};
      const Vector3d third_a = a.corner[kNext[kNext[i]]] - a.corner[i] - s * a.edge[i];
      const Vector3d third_b = b.corner[kNext[kNext[j]]] - b.corner[j] - t * b.edge[j];
      if (third_a.dot(d) <= 0 && third_b.dot(d) >= 0 && square > 0) return true;
    }
  }
  return false;
}

/// Where the line through `point` along the normal meets the triangle; false if it passes it by.
bool FootOf(const Vector3d& point, const Local& triangle, Weights* weights) {
  if (!(triangle.normal_square > 0)) return false;
  const Vector3d from_first = point - triangle.corner[0];
  // Edge 2 leads from corner 2 to corner 0, edge 0 from corner 0 to corner 1.
  const double w1 = triangle.edge[2].cross(from_first).dot(triangle.normal);
  const double w2 = triangle.edge[0].cross(from_first).dot(triangle.normal);
  if (!(w1 >= 0 && w2 >= 0 && w1 + w2 <= triangle.normal_square)) return false;
  const double second = Clamp01(w1 / triangle.normal_square);
  const double third = std::clamp(w2 / triangle.normal_square, 0.0, 1 - second);
  *weights = {{(1 - second) - third, second, third}};
  return true;
}

/// The corners' heights over a plane, times the normal's length.
struct Heights {
  double height[3];
  bool straddles;
  int nearest;  ///< Of the three, to the plane.
};

Heights HeightsOver(const Local& plane, const Local& triangle) {
  Heights heights;
  for (int i = 0; i < 3; ++i) {
    heights.height[i] = plane.normal.dot(triangle.corner[i] - plane.corner[0]);
  }
  const double* h = heights.height;
  const double low = std::min({h[0], h[1], h[2]}), high = std::max({h[0], h[1], h[2]});
  heights.straddles = low < 0 && high > 0;
  heights.nearest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(h[i]) < std::abs(h[heights.nearest])) heights.nearest = i;
  }
  return heights;
}

void ProposeIfNearer(const Local& a, const Local& b, const Weights& weights_a,
                     const Weights& weights_b, Proposal* best) {
  const double square = (PointAt(b, weights_b) - PointAt(a, weights_a)).squaredNorm();
  if (square < best->square) *best = {square, weights_a, weights_b, -1, -1};
}

/// One of the two triangles.
enum class Owner { kA, kB };

/// The corner of one triangle, the owner, that is nearest to the inside of the other.
void ProposeFace(const Local& a, const Local& b, const Heights& heights, Owner owner,
                 Proposal* best) {
  const bool corners_of_b = owner == Owner::kB;
  const Local& corners = corners_of_b ? b : a;
  Weights corner{{0, 0, 0}}, foot;
  corner.w[heights.nearest] = 1;
  if (!FootOf(corners.corner[heights.nearest], corners_of_b ? a : b, &foot)) return;
  ProposeIfNearer(a, b, corners_of_b ? foot : corner, corners_of_b ? corner : foot, best);
}

/// Where an edge of one triangle, the owner, passes through the other.
void ProposeCrossings(const Local& a, const Local& b, const Heights& heights, Owner owner,
                      Proposal* best) {
  const bool edges_of_b = owner == Owner::kB;
  const Local& edges = edges_of_b ? b : a;
  for (int i = 0; i < 3; ++i) {
    const double from = heights.height[i], to = heights.height[kNext[i]];
    if (!(from < 0 ? to > 0 : to < 0)) continue;
    const Weights on_edge = Weights::OnEdge(i, Clamp01(from / (from - to)));
    Weights foot;
    if (!FootOf(PointAt(edges, on_edge), edges_of_b ? a : b, &foot)) continue;
    ProposeIfNearer(a, b, edges_of_b ? foot : on_edge, edges_of_b ? on_edge : foot, best);
  }
}

Proposal Propose(const Local& a, const Local& b) {
  Proposal best;
  if (ProposeEdges(a, b, &best)) return best;
  const Heights b_over_a = HeightsOver(a, b), a_over_b = HeightsOver(b, a);
  // An edge may pass through although the other plane is not straddled: that of a segment is none.
  if (b_over_a.straddles) {
    ProposeCrossings(a, b, b_over_a, Owner::kB, &best);
  } else {
    ProposeFace(a, b, b_over_a, Owner::kB, &best);
  }
  if (a_over_b.straddles) {
    ProposeCrossings(a, b, a_over_b, Owner::kA, &best);
  } else {
    ProposeFace(a, b, a_over_b, Owner::kA, &best);
  }
  return best;
}

/// A lower bound on the distance from the two projections along `n`, b's beyond a's; 0 if they
/// overlap.
double GapAlong(const Vector3d& n, const Local& a, const Local& b) {
  const double square = n.squaredNorm();
  if (!(square > kDirectionMin)) return 0;
  const double a_high = std::max({n.dot(a.corner[0]), n.dot(a.corner[1]), n.dot(a.corner[2])});
  const double b_low = std::min({n.dot(b.corner[0]), n.dot(b.corner[1]), n.dot(b.corner[2])});
  const double sum = std::abs(n.x()) + std::abs(n.y()) + std::abs(n.z());
  const double gap = (b_low - a_high) - kLowerSlack * sum * (a.size + b.size);
  return gap > 0 ? gap / std::sqrt(square) * kShrink : 0;
}

/// The direction between nearest points a short way apart is uncertain; the features (edges and
/// normals) give it exactly.
double GapAlongFeatures(const Vector3d& d, const Proposal& nearest, const Local& a,
                        const Local& b) {
  double gap = 0;
  const auto attempt = [&](const Vector3d& n) {
    gap = std::max(gap, n.dot(d) >= 0 ? GapAlong(n, a, b) : GapAlong(-n, a, b));
  };
  const auto attempt_across = [&](const Vector3d& edge, double square) {
    if (square > 0) attempt(d - d.dot(edge) / square * edge);
  };
  attempt(a.normal);
  attempt(b.normal);
  if (nearest.edge_a < 0 || nearest.edge_b < 0) return gap;
  const Vector3d &edge_a = a.edge[nearest.edge_a], &edge_b = b.edge[nearest.edge_b];
  attempt(edge_a.cross(edge_b));
  attempt_across(edge_a, a.edge_square[nearest.edge_a]);
  attempt_across(edge_b, b.edge_square[nearest.edge_b]);
  return gap;
}

TriangleDistance Certify(const Vector3d& origin, const Local& a, const Local& b,
                         const Proposal& nearest) {
  const Vector3d p_a = PointAt(a, nearest.a), p_b = PointAt(b, nearest.b), d = p_b - p_a;
  const double size = a.size + b.size, length = d.norm();
  double upper = length + kUpperSlack * size + kUnderflow;
  if (!(upper <= std::numeric_limits<double>::max())) upper = numeric::kInfinity;
  double lower = GapAlong(d, a, b);
  if (upper - lower > kTight * size && length > kUpperSlack * size) {
    lower = std::max(lower, GapAlongFeatures(d, nearest, a, b));
  }
  return {{lower, upper}, origin + p_a, origin + p_b};
}

}  // namespace

TriangleDistance DistanceOf(const TrianglePoints& a, const TrianglePoints& b) {
  const Local local_a = LocalOf(a, a[0]), local_b = LocalOf(b, a[0]);
  return Certify(a[0], local_a, local_b, Propose(local_a, local_b));
}

TriangleDistance DistanceOf(const Eigen::Vector3d& point, const TrianglePoints& triangle) {
  const Local a = LocalOf({point, point, point}, point), b = LocalOf(triangle, point);
  Proposal best;
  Weights foot;
  if (FootOf(a.corner[0], b, &foot)) {
    ProposeIfNearer(a, b, Weights{}, foot, &best);
    return Certify(point, a, b, best);
  }
  for (int j = 0; j < 3; ++j) {
    const double square = b.edge_square[j];
    const double t = square > 0 ? Clamp01(-b.corner[j].dot(b.edge[j]) / square) : 0;
    const double distance_square = (b.corner[j] + t * b.edge[j]).squaredNorm();
    if (distance_square < best.square) {
      best = {distance_square, Weights{}, Weights::OnEdge(j, t), 0, j};
    }
  }
  return Certify(point, a, b, best);
}

}  // namespace collision::geometry
