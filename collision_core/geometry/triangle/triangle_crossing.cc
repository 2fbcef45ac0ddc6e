// Whether two triangles certainly cross, and how much their corners may move before they might not.
//
// An edge pq passes through the inside of a triangle T exactly if p and q lie on different sides of
// its plane, and the line pq passes its three edges on the same side: five signed volumes.
//
// A volume V(x0, x1, x2, x3) = det(x1 − x0, x2 − x0, x3 − x0) (six times the tetrahedron's) is
// affine in each corner: moving x_i by Δ changes it by ±N_i·Δ, where N_i is the cross product of
// two edges of the opposite face. Move the corners one after the other, each by at most δ. By then
// that face's edges e, f have changed by at most 2δ each, so |N_i| has grown by at most 2δ(|e| +
// |f|) + 4δ² <= 4δ(ℓ + δ), ℓ the longest of all edges. So V changes by at most
//   change(δ) = δ Σ|N_i| + 16 δ² (ℓ + δ),
// and while that is less than |V| its sign stays. With δ0 = |V| / Σ|N_i|, an upper bound on such δ,
//   δ = |V| / (Σ|N_i| + 16 δ0 (ℓ + δ0))
// is one for which it holds, as change(δ) <= δ (Σ|N_i| + 16 δ0 (ℓ + δ0)) = |V|: the margin.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/geometry/triangle/triangle_pair.h"
#include "collision_core/numeric/allowances.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// The determinant in doubles is off by at most (7 + 56ε) ε times its permanent, as computed
/// (Shewchuk, "Adaptive precision floating-point arithmetic", 1997, orient3d).
constexpr double kVolumeRounding = 8 * numeric::kUnitRoundoff;

/// Coordinates beyond this [m] are never certain. Within it, products that underflow add at most
/// kVolumeUnderflow: twelve of 2^-1075, times a coordinate.
constexpr double kCoordinateMax = 0x1p+150;
constexpr double kVolumeUnderflow = 0x1p-900;

/// The four cross products are off by at most 7.1ε ℓ² each.
constexpr double kAreaRounding = 32 * numeric::kUnitRoundoff;

/// Sums, products, quotients and roots of positive numbers, at most a dozen one after the other:
/// kSomeRoundingsUp rounds them up, and this down.
constexpr double kSomeRoundingsDown = 1 - 0x1p-48;

/// Of the point where an edge passes: per coordinate the difference, the product and the sum are
/// off by 3ε of the largest, √3 times that in length.
constexpr double kPointRounding = 8 * numeric::kUnitRoundoff;

constexpr int kNext[3] = {1, 2, 0};

/// A signed volume, and how far the computed value may be off.
struct Volume {
  double value = 0, error = 0;

  /// +1, −1, or 0 if uncertain.
  int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
  double magnitude() const { return std::abs(value); }
};

Volume VolumeOf(const Vector3d& x0, const Vector3d& x1, const Vector3d& x2, const Vector3d& x3) {
  const Vector3d a = x1 - x0, b = x2 - x0, c = x3 - x0;
  const double bc = b.x() * c.y(), cb = c.x() * b.y();
  const double ca = c.x() * a.y(), ac = a.x() * c.y();
  const double ab = a.x() * b.y(), ba = b.x() * a.y();
  const double permanent = (std::abs(bc) + std::abs(cb)) * std::abs(a.z()) +
                           (std::abs(ca) + std::abs(ac)) * std::abs(b.z()) +
                           (std::abs(ab) + std::abs(ba)) * std::abs(c.z());
  return {a.z() * (bc - cb) + b.z() * (ca - ac) + c.z() * (ab - ba),
          kVolumeRounding * permanent + kVolumeUnderflow};
}

/// How much a volume changes when its corners move.
struct Sensitivity {
  double areas = 0;  ///< Σ|N_i|, rounded up.
  double edge = 0;   ///< ℓ, rounded up.

  double Change(double moved) const {
    return (moved * areas + 16 * moved * moved * (edge + moved)) * numeric::kSomeRoundingsUp;
  }
};

Sensitivity SensitivityOf(const Vector3d& x0, const Vector3d& x1, const Vector3d& x2,
                          const Vector3d& x3) {
  const Vector3d a = x1 - x0, b = x2 - x0, c = x3 - x0, d = x2 - x1, e = x3 - x1, f = x3 - x2;
  const double edge = numeric::kSomeRoundingsUp *
                      std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(),
                                          d.squaredNorm(), e.squaredNorm(), f.squaredNorm()}));
  const double areas =
      a.cross(b).norm() + b.cross(c).norm() + c.cross(a).norm() + d.cross(e).norm();
  return {(areas + kAreaRounding * edge * edge) * numeric::kSomeRoundingsUp, edge};
}

/// The margin of a volume whose sign is certain.
double MarginOf(const Volume& volume, const Sensitivity& sensitivity) {
  const double least = (volume.magnitude() - volume.error) * kSomeRoundingsDown;
  const double most = least / sensitivity.areas * numeric::kSomeRoundingsUp;
  return least / (sensitivity.areas + 16 * most * (sensitivity.edge + most)) * kSomeRoundingsDown;
}

double MarginOf(const Volume& volume, const Vector3d& x0, const Vector3d& x1, const Vector3d& x2,
                const Vector3d& x3) {
  return MarginOf(volume, SensitivityOf(x0, x1, x2, x3));
}

/// The corners' volumes over the plane of `triangle`.
std::array<Volume, 3> VolumesOver(const TrianglePoints& triangle, const TrianglePoints& corners) {
  std::array<Volume, 3> volumes;
  for (int i = 0; i < 3; ++i) {
    volumes[i] = VolumeOf(corners[i], triangle[0], triangle[1], triangle[2]);
  }
  return volumes;
}

bool OnOneSide(const std::array<Volume, 3>& volumes) {
  const int sign = volumes[0].sign();
  return sign != 0 && volumes[1].sign() == sign && volumes[2].sign() == sign;
}

/// Of the two triangles, the one that an edge of the other passes through.
enum class Pierced { kA, kB };

/// An edge that passes through the inside of a triangle.
struct EdgePassage {
  double margin = -1;  ///< Below 0: no such edge for certain.
  Pierced pierced = Pierced::kB;
  int edge = 0;  ///< Of the other triangle.
  Volume from, to;
};

/// The margin of one edge's passage; −1 if it does not certainly pass.
double MarginOfEdge(const Vector3d& p, const Vector3d& q, const TrianglePoints& triangle,
                    const Volume& from, const Volume& to) {
  if (from.sign() * to.sign() >= 0) return -1;
  Volume beside[3];
  for (int i = 0; i < 3; ++i) {
    beside[i] = VolumeOf(p, q, triangle[i], triangle[kNext[i]]);
    if (beside[i].sign() == 0 || beside[i].sign() != beside[0].sign()) return -1;
  }
  double margin = std::min(MarginOf(from, p, triangle[0], triangle[1], triangle[2]),
                           MarginOf(to, q, triangle[0], triangle[1], triangle[2]));
  for (int i = 0; i < 3; ++i) {
    margin = std::min(margin, MarginOf(beside[i], p, q, triangle[i], triangle[kNext[i]]));
  }
  return margin;
}

void WidenBy(const TrianglePoints& edges, const TrianglePoints& triangle,
             const std::array<Volume, 3>& volumes, Pierced pierced, EdgePassage* widest) {
  for (int i = 0; i < 3; ++i) {
    const int j = kNext[i];
    const double margin = MarginOfEdge(edges[i], edges[j], triangle, volumes[i], volumes[j]);
    if (margin > widest->margin) *widest = {margin, pierced, i, volumes[i], volumes[j]};
  }
}

/// Whether the boxes are apart, or a coordinate is out of range or NaN.
bool CertainlyNothing(const TrianglePoints& a, const TrianglePoints& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [a_low, a_high] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [b_low, b_high] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (a_high < b_low || b_high < a_low) return true;
    if (!(a_low >= -kCoordinateMax && a_high <= kCoordinateMax)) return true;
    if (!(b_low >= -kCoordinateMax && b_high <= kCoordinateMax)) return true;
  }
  return false;
}

/// The passage with the widest margin.
EdgePassage WidestPassage(const TrianglePoints& a, const TrianglePoints& b) {
  EdgePassage widest;
  if (CertainlyNothing(a, b)) return widest;
  const std::array<Volume, 3> a_over_b = VolumesOver(b, a);
  if (OnOneSide(a_over_b)) return widest;
  const std::array<Volume, 3> b_over_a = VolumesOver(a, b);
  if (OnOneSide(b_over_a)) return widest;
  WidenBy(a, b, a_over_b, Pierced::kB, &widest);
  WidenBy(b, a, b_over_a, Pierced::kA, &widest);
  return widest;
}

/// Where a passage is, with a bound over all positions of the corners. Along the edge the point is
/// at the fraction t = |V_p| / (|V_p| + |V_q|); it grows with V_p and falls with V_q, so the ends
/// of both bound it. The edge itself moves by δ at most. The point also stays within the moved
/// triangle, which is the better bound where a long edge pierces a small one.
Crossing CrossingOf(const EdgePassage& passage, const TrianglePoints& edges,
                    const TrianglePoints& triangle, double uncertainty) {
  const Vector3d &p = edges[passage.edge], &q = edges[kNext[passage.edge]];
  const auto change = [&](const Vector3d& corner) {
    return SensitivityOf(corner, triangle[0], triangle[1], triangle[2]).Change(uncertainty);
  };
  const double from = passage.from.magnitude(), from_off = passage.from.error + change(p);
  const double to = passage.to.magnitude(), to_off = passage.to.error + change(q);
  const double from_low = std::max(0.0, from - from_off), to_low = std::max(0.0, to - to_off);
  const double t = from / (from + to);
  const double t_low = from_low / (from_low + (to + to_off)) * kSomeRoundingsDown;
  const double t_high =
      std::min(1.0, (from + from_off) / (from + from_off + to_low) * numeric::kSomeRoundingsUp);

  Crossing crossing;
  crossing.point = p + t * (q - p);
  const double length = (q - p).norm();
  double reach = 0;
  for (const Vector3d& corner : triangle) reach = std::max(reach, (corner - crossing.point).norm());
  const double rounding = kPointRounding * (length + crossing.point.norm());
  const double along = std::max(t_high - t, t - t_low) * length;
  crossing.error = (uncertainty + std::min(along, reach) + rounding) * numeric::kSomeRoundingsUp;
  crossing.normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  crossing.through_b = passage.pierced == Pierced::kB;
  return crossing;
}

}  // namespace

std::optional<Crossing> CertainCrossing(const TrianglePoints& a, const TrianglePoints& b,
                                        double uncertainty) {
  CORE_CHECK(uncertainty >= 0, "an uncertainty is a number, and not below 0", uncertainty);
  const EdgePassage passage = WidestPassage(a, b);
  if (!(passage.margin >= 0 && passage.margin >= uncertainty)) return std::nullopt;
  return passage.pierced == Pierced::kB ? CrossingOf(passage, a, b, uncertainty)
                                        : CrossingOf(passage, b, a, uncertainty);
}

double CrossingMargin(const TrianglePoints& a, const TrianglePoints& b) {
  return WidestPassage(a, b).margin;
}

}  // namespace collision::geometry
