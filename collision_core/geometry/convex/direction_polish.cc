#include "collision_core/geometry/convex/direction_polish.h"

#include <Eigen/Geometry>
#include <cmath>

namespace collision::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The second derivative of the support function h. For an ellipsoid h(n) = |Gᵀ n| = √(nᵀ A n) with
/// A = G Gᵀ, so h'' = (A − s sᵀ) / h, where s = A n / h is the support point. On the rim of a
/// cylinder or a cone it is that of the disc, an ellipsoid without a third generator. For any other
/// core, and at an apex, it is zero, because a small rotation of n does not move the support point.
Matrix3d CurvatureOf(const ConvexSet& set, const Vector3d& n) {
  if (!set.IsSmooth()) return Matrix3d::Zero();
  Matrix3d g = set.generators;
  if (set.IsTurned()) {
    if (set.core == ConvexCore::kCone && set.Support(n).z() > 0) return Matrix3d::Zero();
    g.col(2).setZero();
  }
  const Matrix3d a = g * g.transpose();
  const Vector3d an = a * n;
  const double square = n.dot(an);
  if (!(square > 0)) return Matrix3d::Zero();
  return (a - an * an.transpose() / square) / std::sqrt(square);
}

/// Two unit vectors perpendicular to n and to each other; with an edge, one unit vector that is
/// also perpendicular to the edge, and zero.
Eigen::Matrix<double, 3, 2> TangentsAt(const Vector3d& n, const Vector3d& edge) {
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.setZero();
  if (edge != Vector3d::Zero()) {
    tangents.col(0) = n.cross(edge).normalized();
    return tangents;
  }
  tangents.col(0) = n.unitOrthogonal();
  tangents.col(1) = n.cross(tangents.col(0));
  return tangents;
}

}  // namespace

// Along n + δ the support point is y − H δ, with H the sum of both curvatures. It lies along n + δ
// itself, as λ (n + δ) with λ = n·y, where (H + λ) δ is the part of y perpendicular to n.
Vector3d WidestNear(const ConvexPair& pair, const Vector3d& about, const Vector3d& edge) {
  Vector3d n = about;
  const double edge_square = edge.squaredNorm();
  if (edge_square > 0) n -= n.dot(edge) / edge_square * edge;
  n.normalize();
  for (int step = 0; step < kPolishSteps; ++step) {
    const Vector3d y = pair.Against(n).y;
    const Eigen::Matrix<double, 3, 2> tangents = TangentsAt(n, edge);
    const Matrix3d h = CurvatureOf(pair.a(), n) + CurvatureOf(pair.b(), -n);
    Eigen::Matrix2d m =
        tangents.transpose() * h * tangents + n.dot(y) * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d across = tangents.transpose() * y;
    if (edge_square > 0) m(1, 1) = 1;
    const double determinant = m.determinant();
    if (!(determinant > 0)) break;
    const Eigen::Vector2d by((m(1, 1) * across[0] - m(0, 1) * across[1]) / determinant,
                             (m(0, 0) * across[1] - m(1, 0) * across[0]) / determinant);
    const Vector3d next = (n + tangents * by).normalized();
    if (!(next.squaredNorm() > 0.5) || next == n) break;
    n = next;
  }
  return n;
}

}  // namespace collision::geometry
