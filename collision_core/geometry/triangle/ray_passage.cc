// How the ray from a point along x passes a triangle, by exact orientation signs.
#include "collision_core/geometry/triangle/ray_passage.h"

#include <optional>

#include "collision_core/numeric/exact_sign.h"

namespace collision::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d Across(const Vector3d& p) { return {p.y(), p.z()}; }

/// The sign of an orientation, and whether it is zero before the point is moved.
struct MovedSign {
  int sign = 0;
  bool was_zero = false;
};

/// The side of the edge ab on which the moved point lies. It is (b − a) × (p − a), linear in p: by
/// y it grows with a_z − b_z, by z with b_y − a_y. If that is zero as well, the edge is a point in
/// this projection.
std::optional<MovedSign> SideOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const auto sign = numeric::OrientationSign(a, b, p);
  if (!sign) return std::nullopt;
  if (*sign != 0) return MovedSign{*sign, false};
  if (a.y() != b.y()) return MovedSign{a.y() > b.y() ? 1 : -1, true};
  return MovedSign{(b.x() > a.x()) - (b.x() < a.x()), true};
}

}  // namespace

RayPassage PassageOf(const TrianglePoints& t, const Vector3d& point) {
  const std::array<Vector2d, 3> c = {Across(t[0]), Across(t[1]), Across(t[2])};
  const Vector2d p = Across(point);
  const Vector2d lower = c[0].cwiseMin(c[1]).cwiseMin(c[2]);
  const Vector2d upper = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
  if ((p.array() < lower.array()).any() || (p.array() > upper.array()).any()) return {};
  int moved_sum = 0;
  bool left = false, right = false, touches = false;
  for (int i = 0; i < 3; ++i) {
    const auto side = SideOf(c[i], c[(i + 1) % 3], p);
    if (!side) return {Passing::kUnknown};
    moved_sum += side->sign;
    touches = touches || side->was_zero;
    left = left || (!side->was_zero && side->sign > 0);
    right = right || (!side->was_zero && side->sign < 0);
  }
  if (left && right) return {};
  // On the triangle's rim, seen along x: unless the point is certainly off the triangle, it may be
  // on the surface, and may not be moved.
  if (touches && !(DistanceToTriangle(point, t).distance.lower > 0)) return {Passing::kUnknown};
  if (moved_sum != 3 && moved_sum != -3) return {};
  const int sign = moved_sum / 3;
  // The normal's x has `sign`; the plane stands at x − (normal · (point − a)) / normal_x.
  const auto above = numeric::OrientationSign(t[0], t[1], t[2], point);
  if (!above || *above == 0) return {Passing::kUnknown};
  return {*above == sign ? Passing::kBackward : Passing::kForward, sign};
}

}  // namespace collision::geometry
