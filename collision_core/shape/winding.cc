// How often a closed surface winds about a point.
#include <algorithm>
#include <cmath>

#include "collision_core/numeric/rounding.h"
#include "collision_core/shape/exact_sign.h"
#include "collision_core/shape/point_triangle.h"
#include "collision_core/shape/ray_passage.h"
#include "collision_core/shape/surface_query.h"

namespace collision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d Across(const Vector3d& p) { return {p.y(), p.z()}; }

/// Whether a line along x through the point may meet the ball, on the side that is asked. The computed
/// square is off by a relative 5 u, u = 2^−53, r² by u; 1e-290 covers what underflows. The sum along x
/// is rounded monotonically, to the right side.
bool RayMayMeet(const SphereNode& node, const Vector3d& point, bool forward) {
  const double dy = point.y() - node.centre.y(), dz = point.z() - node.centre.z();
  const double r = node.radius;
  if (dy * dy + dz * dz > r * r * (1 + 0x1p-48) + 1e-290) return false;
  return forward ? node.centre.x() + r >= point.x() : node.centre.x() - r <= point.x();
}

/// The sign of an orientation, and whether it is zero before the point is moved.
struct MovedSign {
  int sign = 0;
  bool was_zero = false;
};

/// The side of the edge ab on which the moved point lies. It is (b − a) × (p − a), linear in p: by y
/// it grows with a_z − b_z, by z with b_y − a_y. Zero still: the edge is a point here.
std::optional<MovedSign> SideOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const auto sign = OrientationSign(a, b, p);
  if (!sign) return std::nullopt;
  if (*sign != 0) return MovedSign{*sign, false};
  if (a.y() != b.y()) return MovedSign{a.y() > b.y() ? 1 : -1, true};
  return MovedSign{(b.x() > a.x()) - (b.x() < a.x()), true};
}

}  // namespace

Passage PassageOf(const TriangleCorners& t, const Vector3d& point) {
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
  // On the triangle's rim, seen along x: unless the point is certainly off the triangle, it may be on
  // the surface, and may not be moved.
  if (touches && !(DistanceToTriangle(point, t).distance.lower > 0)) return {Passing::kUnknown};
  if (moved_sum != 3 && moved_sum != -3) return {};
  const int sign = moved_sum / 3;
  // The normal's x has `sign`; the plane stands at x − (normal · (point − a)) / normal_x.
  const auto above = OrientationSign(t[0], t[1], t[2], point);
  if (!above || *above == 0) return {Passing::kUnknown};
  return {*above == sign ? Passing::kBackward : Passing::kForward, sign};
}

std::optional<int> SurfaceQuery::WindingNumberAt(const Vector3d& point) {
  const SphereNode& root = tree_.root();
  // Towards the nearer end of the surface: fewer triangles there.
  const bool forward = point.x() >= root.centre.x();
  const Passing asked = forward ? Passing::kForward : Passing::kBackward;
  passed_.clear();
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const SphereNode& node = tree_.nodes[stack_.back()];
    stack_.pop_back();
    ++work_;
    if (!RayMayMeet(node, point, forward)) continue;
    for (std::uint32_t i = 0; i < node.children; ++i) stack_.push_back(node.first_child + i);
    work_ += node.triangles;
    for (const std::uint32_t index : tree_.TrianglesOf(node)) {
      const Triangle& t = mesh_.triangles[index];
      const Passage pass =
          PassageOf({mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]}, point);
      if (pass.passing == Passing::kUnknown) return std::nullopt;
      if (pass.passing == asked) passed_.emplace_back(index, forward ? pass.sign : -pass.sign);
    }
  }
  // A triangle may stand in several leaves.
  std::sort(passed_.begin(), passed_.end());
  passed_.erase(std::unique(passed_.begin(), passed_.end()), passed_.end());
  int winding = 0;
  for (const auto& [triangle, sign] : passed_) winding += sign;
  return winding;
}

}  // namespace collision
