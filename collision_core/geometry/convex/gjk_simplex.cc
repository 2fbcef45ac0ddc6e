#include "collision_core/geometry/convex/gjk_simplex.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Flatter than this, relative, a tetrahedron has no inside that doubles can tell.
constexpr double kFlat = 1e-14;

void OnCorner(int i, const Vector3d& a, SimplexPoint* point) {
  point->count = 1;
  point->corners[0] = i;
  point->weights[0] = 1;
  point->nearest = a;
  point->square = a.squaredNorm();
  point->encloses = false;
}

/// Requires a foot t in (0, 1) of the edge's length. The part of a along the edge is taken out
/// twice: what the first time leaves by rounding is small against the result only after the second.
void OnEdge(int i, int j, const Vector3d& a, const Vector3d& edge, double t, SimplexPoint* point) {
  const double edge_square = edge.squaredNorm();
  Vector3d nearest = a + t * edge;
  nearest -= nearest.dot(edge) / edge_square * edge;
  point->count = 2;
  point->corners[0] = i, point->corners[1] = j;
  point->weights[0] = 1 - t, point->weights[1] = t;
  point->nearest = nearest;
  point->square = nearest.squaredNorm();
  point->encloses = false;
}

void NearestOfEdge(int i, int j, const Vector3d& a, const Vector3d& b, SimplexPoint* point) {
  const Vector3d edge = b - a;
  const double along = -a.dot(edge), square = edge.squaredNorm();
  if (!(along > 0)) return OnCorner(i, a, point);
  if (along >= square) return OnCorner(j, b, point);
  OnEdge(i, j, a, edge, along / square, point);
}

/// After Ericson, "Real-time collision detection", 2005, section 5.1.5.
void NearestOfTriangle(int i, int j, int k, const Vector3d& a, const Vector3d& b, const Vector3d& c,
                       SimplexPoint* point) {
  const Vector3d ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return OnCorner(i, a, point);
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return OnCorner(j, b, point);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return OnEdge(i, j, a, ab, d1 / (d1 - d3), point);
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return OnCorner(k, c, point);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return OnEdge(i, k, a, ac, d2 / (d2 - d6), point);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return OnEdge(j, k, b, c - b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), point);
  }
  const Vector3d normal = ab.cross(ac);
  const double sum = va + vb + vc, square = normal.squaredNorm();
  if (!(sum > 0 && square > 0)) return OnCorner(i, a, point);
  const double second = vb / sum, third = vc / sum;
  const Vector3d nearest = normal * (normal.dot(a) / square);
  point->count = 3;
  point->corners[0] = i, point->corners[1] = j, point->corners[2] = k;
  point->weights[0] = va / sum, point->weights[1] = second, point->weights[2] = third;
  point->nearest = nearest;
  point->square = nearest.squaredNorm();
  point->encloses = false;
}

/// On which side of a face the origin is, seen from the fourth corner; flat ones have no inside.
bool IsBeyond(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& opposite) {
  const Vector3d normal = (b - a).cross(c - a);
  const Vector3d edge = opposite - a;
  const double side = normal.dot(edge), origin = -normal.dot(a);
  if (std::abs(side) <= kFlat * normal.cwiseAbs().maxCoeff() * edge.cwiseAbs().maxCoeff())
    return true;
  return side > 0 ? origin < 0 : origin > 0;
}

void Enclosing(const std::array<const Vector3d*, 4>& p, SimplexPoint* enclosing) {
  const auto volume = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return a.dot(b.cross(c));
  };
  SimplexPoint& point = *enclosing;
  point.corners = {0, 1, 2, 3};
  point.count = 4;
  point.nearest.setZero();
  point.square = 0;
  point.encloses = true;
  point.weights = {std::abs(volume(*p[1], *p[2], *p[3])), std::abs(volume(*p[0], *p[2], *p[3])),
                   std::abs(volume(*p[0], *p[1], *p[3])), std::abs(volume(*p[0], *p[1], *p[2]))};
  const double sum = point.weights[0] + point.weights[1] + point.weights[2] + point.weights[3];
  for (double& weight : point.weights) weight = sum > 0 ? weight / sum : 0.25;
}

/// Three corners and the one opposite.
constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 1, 3, 2}, {1, 2, 3, 0}};

void NearestOfTetrahedron(const std::array<const Vector3d*, 4>& p, int newest,
                          SimplexPoint* point) {
  point->count = 0;
  point->square = std::numeric_limits<double>::infinity();
  SimplexPoint found;
  for (const auto& f : kFaces) {
    if (f[3] == newest || !IsBeyond(*p[f[0]], *p[f[1]], *p[f[2]], *p[f[3]])) continue;
    NearestOfTriangle(f[0], f[1], f[2], *p[f[0]], *p[f[1]], *p[f[2]], &found);
    if (found.square < point->square) *point = found;
  }
  if (point->count == 0) Enclosing(p, point);
}

}  // namespace

void NearestOfSimplex(const std::array<const Vector3d*, 4>& corners, int count, int newest,
                      SimplexPoint* point) {
  switch (count) {
    case 1:
      return OnCorner(0, *corners[0], point);
    case 2:
      return NearestOfEdge(0, 1, *corners[0], *corners[1], point);
    case 3:
      return NearestOfTriangle(0, 1, 2, *corners[0], *corners[1], *corners[2], point);
    default:
      return NearestOfTetrahedron(corners, newest, point);
  }
}

}  // namespace collision::geometry
