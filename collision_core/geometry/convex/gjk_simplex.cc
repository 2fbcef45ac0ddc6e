#include "collision_core/geometry/convex/gjk_simplex.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Height of a corner above the opposite face, as a share of its largest possible value, up to
/// which a tetrahedron counts as flat: doubles cannot tell its inside.
constexpr double kFlat = 1e-14;

/// A corner of the simplex: its place among the corners, and its position.
struct Corner {
  int index;
  const Vector3d& p;
};

void OnCorner(const Corner& a, SimplexPoint* point) {
  point->count = 1;
  point->corners[0] = a.index;
  point->weights[0] = 1;
  point->nearest = a.p;
  point->square = a.p.squaredNorm();
  point->encloses = false;
}

/// The nearest point is a + t (b − a). Requires t in (0, 1). The part of `nearest` along the edge
/// is taken out twice: after the first time, what rounding leaves of it may be large beside the
/// result.
void OnEdge(const Corner& a, const Corner& b, double t, SimplexPoint* point) {
  const Vector3d edge = b.p - a.p;
  const double edge_square = edge.squaredNorm();
  Vector3d nearest = a.p + t * edge;
  nearest -= nearest.dot(edge) / edge_square * edge;
  point->count = 2;
  point->corners[0] = a.index, point->corners[1] = b.index;
  point->weights[0] = 1 - t, point->weights[1] = t;
  point->nearest = nearest;
  point->square = nearest.squaredNorm();
  point->encloses = false;
}

void NearestOfEdge(const Corner& a, const Corner& b, SimplexPoint* point) {
  const Vector3d edge = b.p - a.p;
  const double along = -a.p.dot(edge), square = edge.squaredNorm();
  if (!(along > 0)) return OnCorner(a, point);
  if (along >= square) return OnCorner(b, point);
  OnEdge(a, b, along / square, point);
}

/// After Ericson, "Real-time collision detection", 2005, section 5.1.5.
void NearestOfTriangle(const Corner& a, const Corner& b, const Corner& c, SimplexPoint* point) {
  const Vector3d ab = b.p - a.p, ac = c.p - a.p;
  const double d1 = -ab.dot(a.p), d2 = -ac.dot(a.p);
  if (d1 <= 0 && d2 <= 0) return OnCorner(a, point);
  const double d3 = -ab.dot(b.p), d4 = -ac.dot(b.p);
  if (d3 >= 0 && d4 <= d3) return OnCorner(b, point);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return OnEdge(a, b, d1 / (d1 - d3), point);
  const double d5 = -ab.dot(c.p), d6 = -ac.dot(c.p);
  if (d6 >= 0 && d5 <= d6) return OnCorner(c, point);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return OnEdge(a, c, d2 / (d2 - d6), point);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return OnEdge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)), point);
  }
  const Vector3d normal = ab.cross(ac);
  const double sum = va + vb + vc, square = normal.squaredNorm();
  if (!(sum > 0 && square > 0)) return OnCorner(a, point);
  const double second = vb / sum, third = vc / sum;
  const Vector3d nearest = normal * (normal.dot(a.p) / square);
  point->count = 3;
  point->corners[0] = a.index, point->corners[1] = b.index, point->corners[2] = c.index;
  point->weights[0] = va / sum, point->weights[1] = second, point->weights[2] = third;
  point->nearest = nearest;
  point->square = nearest.squaredNorm();
  point->encloses = false;
}

/// Whether the origin is not on the same side of the face (a, b, c) as the opposite corner. True
/// for a flat tetrahedron, which has no inside.
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

/// Each face: its three corners and the opposite one.
constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 1, 3, 2}, {1, 2, 3, 0}};

void NearestOfTetrahedron(const std::array<const Vector3d*, 4>& p, int newest,
                          SimplexPoint* point) {
  point->count = 0;
  point->square = std::numeric_limits<double>::infinity();
  SimplexPoint found;
  for (const auto& f : kFaces) {
    if (f[3] == newest || !IsBeyond(*p[f[0]], *p[f[1]], *p[f[2]], *p[f[3]])) continue;
    NearestOfTriangle({f[0], *p[f[0]]}, {f[1], *p[f[1]]}, {f[2], *p[f[2]]}, &found);
    if (found.square < point->square) *point = found;
  }
  if (point->count == 0) Enclosing(p, point);
}

}  // namespace

void NearestOfSimplex(const std::array<const Vector3d*, 4>& corners, int count, int newest,
                      SimplexPoint* point) {
  switch (count) {
    case 1:
      return OnCorner({0, *corners[0]}, point);
    case 2:
      return NearestOfEdge({0, *corners[0]}, {1, *corners[1]}, point);
    case 3:
      return NearestOfTriangle({0, *corners[0]}, {1, *corners[1]}, {2, *corners[2]}, point);
    default:
      return NearestOfTetrahedron(corners, newest, point);
  }
}

}  // namespace collision::geometry
