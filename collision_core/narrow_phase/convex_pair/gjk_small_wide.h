// The kernel of gjk_small.h, after Gilbert, Johnson and Keerthi as in geometry/convex/gjk.h.
// After a lanes header (simd/).
//
// Rounding, with u = 2^-53: support points are those of convex_set.h, with no more operations, so
// that the errors of ConvexPair hold: a gap is known to within 26u S, a weighted sum of points to
// within 32u S. The quotient by the length of the direction adds 4u S, a length 2.5u of itself.
#pragma once

#include <cmath>

#include "collision_core/narrow_phase/convex_pair/gjk_small.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/simd/doubles_wide.h"

namespace collision::narrow_phase::gjk_small::COLLISION_SIMD {

using namespace simd::COLLISION_SIMD;

constexpr double kGapError = 32 * numeric::kUnitRoundoff;
constexpr double kPointError = 36 * numeric::kUnitRoundoff;
/// Nearer than this share of S a search in doubles cannot tell.
constexpr double kTouching = 4 * numeric::kUnitRoundoff;
constexpr int kStepsMax = 24;

/// Copied one by one: what has been written as numbers and is read as pairs has to wait.
struct Point {
  double x, y, z;

  Point() = default;
  WIDE_INLINE Point(double p_x, double p_y, double p_z) : x(p_x), y(p_y), z(p_z) {}
  WIDE_INLINE Point(const Point& p) : x(p.x), y(p.y), z(p.z) {}
  WIDE_INLINE Point& operator=(const Point& p) {
    x = p.x, y = p.y, z = p.z;
    return *this;
  }
};

WIDE_INLINE Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
WIDE_INLINE Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
WIDE_INLINE Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
WIDE_INLINE double Dot(const Point& a, const Point& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
WIDE_INLINE Point Cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

WIDE_INLINE Point Axis(const SmallGjkCore& core, int i) {
  const double* const g = core.axes + 3 * i;
  return {g[0], g[1], g[2]};
}

WIDE_INLINE Doubles AlongOf(const double* p, const Point& n) {
  return (n.x * Load(p) + n.y * Load(p + 4)) + n.z * Load(p + 8);
}

/// A point of the hull that is furthest along n.
WIDE_INLINE Point FurthestOf(const SmallGjkCore& core, const Point& n) {
  const double* p = core.points;
  Doubles most = AlongOf(p, n), place{0, 1, 2, 3}, best = place;
  for (int block = 1; block < core.blocks; ++block) {
    p += 12;
    place += 12.0;
    const Doubles along = AlongOf(p, n);
    const DoublesMask more = along > most;
    // Places only become greater.
    const Doubles there = Selected(place, more);
    best = there > best ? there : best;
    most = along > most ? along : most;
  }
  const bool low = most[1] > most[0], high = most[3] > most[2];
  const double first = low ? most[1] : most[0], second = high ? most[3] : most[2];
  const double of_first = low ? best[1] : best[0], of_second = high ? best[3] : best[2];
  const double* const found = core.points + static_cast<int>(second > first ? of_second : of_first);
  return {found[0], found[4], found[8]};
}

WIDE_INLINE Point Support(const SmallGjkCore& core, const Point& n) {
  const Point g0 = Axis(core, 0), g1 = Axis(core, 1), g2 = Axis(core, 2);
  if (core.is_hull) {
    const Point at = FurthestOf(core, {Dot(n, g0), Dot(n, g1), Dot(n, g2)});
    return (at.x * g0 + at.y * g1) + at.z * g2;
  }
  if (core.edges == 0) return {0, 0, 0};
  const Point first = std::copysign(1, Dot(n, g0)) * g0;
  if (core.edges == 1) return first;
  return (first + std::copysign(1, Dot(n, g1)) * g1) + std::copysign(1, Dot(n, g2)) * g2;
}

/// The point of a simplex nearest to 0.
struct SimplexNearest {
  unsigned corners = 0;  ///< The corners that span it, one bit each; 0: 0 seems to be inside.
  Point sum;             ///< The nearest point, as a weighted sum of corners.
  Point direction;       ///< The direction of `sum`, computed more exactly.
  double square;         ///< Of `sum`.

  SimplexNearest() = default;
  WIDE_INLINE SimplexNearest& operator=(const SimplexNearest& other) {
    corners = other.corners, sum = other.sum;
    direction = other.direction, square = other.square;
    return *this;
  }
};

class Search {
 public:
  WIDE_INLINE explicit Search(const SmallGjkPair& pair) : pair_(pair) {}

  WIDE_INLINE SmallGjkResult Run() {
    const double size = pair_.size;
    const double touching = kTouching * size;
    double lower = -HUGE_VAL;
    Point n = LikelyWay();
    if (!(Dot(n, n) > 0)) n = {1, 0, 0};
    corner_[0] = Against(n);
    count_ = 1;
    SimplexNearest at;
    OnCorner(0, &at);
    const double ahead = Dot(n, corner_[0]) / std::sqrt(Dot(n, n));
    if (ahead > pair_.apart) return {ahead - kGapError * size, HUGE_VAL, false};
    for (int step = 0; step < kStepsMax; ++step) {
      const double square = Dot(at.direction, at.direction);
      if (!(square > touching * touching)) break;
      const double length = std::sqrt(square);
      if (length < pair_.near) break;
      const Point found = Against(at.direction);
      const double gap = Dot(at.direction, found) / length;
      lower = Greater(lower, gap - kGapError * size);
      if (gap > pair_.apart || IsCloseEnough(length, gap) || IsKnown(found)) break;
      corner_[count_] = found;
      ++count_;
      SimplexNearest next;
      Reduce(&next);
      if (next.corners == 0) {
        if (HoldsBall()) return {lower, HUGE_VAL, true};
        break;
      }
      if (!(next.square < at.square)) break;
      at = next;
      Keep(at.corners);
    }
    return {lower, std::sqrt(at.square) + kPointError * size, false};
  }

 private:
  /// The sum of two ellipsoids with matrices A and B whose centres are d apart is nearly the one
  /// with A + B, which has the normal (A + B)^-1 d where d leaves it. Computes only the adjugate of
  /// A + B: the length does not matter.
  WIDE_INLINE Point LikelyWay() const {
    double q[6] = {};  // xx, xy, xz, yy, yz, zz
    const SmallGjkCore* const cores[] = {&pair_.a, &pair_.b};
    for (const SmallGjkCore* core : cores) {
      for (int i = 0; i < 3; ++i) {
        const Point g = core->reach[i] * Axis(*core, i);
        q[0] += g.x * g.x, q[1] += g.x * g.y, q[2] += g.x * g.z;
        q[3] += g.y * g.y, q[4] += g.y * g.z, q[5] += g.z * g.z;
      }
    }
    const Point d{pair_.d[0], pair_.d[1], pair_.d[2]};
    const double xx = q[3] * q[5] - q[4] * q[4], xy = q[2] * q[4] - q[1] * q[5];
    const double xz = q[1] * q[4] - q[2] * q[3], yy = q[0] * q[5] - q[2] * q[2];
    const double yz = q[1] * q[2] - q[0] * q[4], zz = q[0] * q[3] - q[1] * q[1];
    return {(xx * d.x + xy * d.y) + xz * d.z, (xy * d.x + yy * d.y) + yz * d.z,
            (xz * d.x + yz * d.y) + zz * d.z};
  }

  /// The point of B − A that is furthest against n.
  WIDE_INLINE Point Against(const Point& n) const {
    const Point d{pair_.d[0], pair_.d[1], pair_.d[2]};
    return (d + Support(pair_.b, {-n.x, -n.y, -n.z})) - Support(pair_.a, n);
  }

  WIDE_INLINE bool IsCloseEnough(double length, double gap) const {
    const double share = gap > 0 ? pair_.relative_tolerance * std::abs(gap - pair_.rounding) : 0;
    return length - gap <=
           Greater(Greater(pair_.absolute_tolerance, share), kTouching * pair_.size);
  }

  WIDE_INLINE bool IsKnown(const Point& found) const {
    bool known = false;
    for (int i = 0; i < count_; ++i) {
      known |= corner_[i].x == found.x && corner_[i].y == found.y && corner_[i].z == found.z;
    }
    return known;
  }

  WIDE_INLINE void Keep(unsigned corners) {
    count_ = 0;
    for (int i = 0; i < 4; ++i) {
      if (corners >> i & 1) corner_[count_++] = corner_[i];
    }
  }

  WIDE_INLINE void OnCorner(int i, SimplexNearest* at) const {
    at->corners = 1u << i;
    at->sum = at->direction = corner_[i];
    at->square = Dot(at->sum, at->sum);
  }

  WIDE_INLINE void OnEdge(int i, int j, SimplexNearest* at) const {
    const Point &a = corner_[i], edge = corner_[j] - a;
    const double along = -Dot(a, edge), square = Dot(edge, edge);
    if (!(along > 0)) return OnCorner(i, at);
    if (along >= square) return OnCorner(j, at);
    const double t = along / square;
    at->corners = 1u << i | 1u << j;
    at->sum = (1 - t) * a + t * corner_[j];
    at->direction = at->sum - (Dot(at->sum, edge) / square) * edge;
    at->square = Dot(at->sum, at->sum);
  }

  /// After Ericson, "Real-time collision detection", 2005, section 5.1.5.
  WIDE_INLINE void OnTriangle(int i, int j, int k, SimplexNearest* at) const {
    const Point &a = corner_[i], &b = corner_[j], &c = corner_[k];
    const Point ab = b - a, ac = c - a;
    const double d1 = -Dot(ab, a), d2 = -Dot(ac, a), d3 = -Dot(ab, b), d4 = -Dot(ac, b);
    const double d5 = -Dot(ab, c), d6 = -Dot(ac, c);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (!(va > 0 && vb > 0 && vc > 0)) return OnRim(i, j, k, {va > 0, vb > 0, vc > 0}, at);
    const Point normal = Cross(ab, ac);
    const double square = Dot(normal, normal);
    if (!(square > 0)) return OnCorner(i, at);
    const double scale = 1 / ((va + vb) + vc);
    at->corners = 1u << i | 1u << j | 1u << k;
    at->sum = ((va * scale) * a + (vb * scale) * b) + (vc * scale) * c;
    at->direction = (Dot(normal, a) / square) * normal;
    at->square = Dot(at->sum, at->sum);
  }

  /// Whether 0 lies on the inner side of the edge opposite a, b and c.
  struct Sides {
    bool a, b, c;
  };

  /// The nearest of the edges that 0 is beyond.
  WIDE_INLINE void OnRim(int i, int j, int k, const Sides& inside, SimplexNearest* at) const {
    at->corners = 0;
    SimplexNearest other;
    const auto take = [&](int from, int to) WIDE {
      OnEdge(from, to, &other);
      if (at->corners == 0 || other.square < at->square) *at = other;
    };
    if (!inside.c) take(i, j);
    if (!inside.b) take(i, k);
    if (!inside.a) take(j, k);
  }

  /// No corners: 0 is inside.
  WIDE_INLINE void Reduce(SimplexNearest* at) const {
    if (count_ == 2) return OnEdge(0, 1, at);
    if (count_ == 3) return OnTriangle(0, 1, 2, at);
    // Faces of the newest corner, and the corner opposite.
    constexpr int kFaces[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
    at->corners = 0;
    SimplexNearest other;
    for (const auto& f : kFaces) {
      const Point &a = corner_[f[0]], &b = corner_[f[1]], &c = corner_[3];
      const Point normal = Cross(a - c, b - c);
      const double side = Dot(normal, corner_[f[2]] - c), origin = -Dot(normal, c);
      if (side > 0 ? origin > 0 : (side < 0 && origin < 0)) continue;
      OnTriangle(f[0], f[1], 3, &other);
      if (at->corners == 0 || other.square < at->square) *at = other;
    }
  }

  /// On a square that is compared with another. The two take three and six roundings after the
  /// subtraction of `error`, 9u: 1 + 2^-49 would do. More does no harm: a ball that is within 5e-5
  /// of its radius of being held costs the search further steps.
  static constexpr double kSquareMargin = 1.0001;

  /// On the radius: a product and a sum of positive terms, and the product with this.
  static constexpr double kRadiusUp = 1 + 0x1p-40;

  /// Of S³: a triple product of vectors up to S is off by less than 16u of it, and a face's normal
  /// by less than 16u S², which times the radius is small compared with that. Four times as much.
  static constexpr double kVolumeError = 64 * numeric::kUnitRoundoff;

  /// 0 and four corners: the volumes with each face all have one sign. The exact corners are off by
  /// kPointError S, the volumes by kVolumeError S³: the ball belongs to their hull if 0 is further
  /// than both together from each face.
  WIDE_INLINE bool HoldsBall() const {
    const double size = pair_.size;
    const double radius = kRadiusUp * (pair_.inside + kPointError * size);
    const double error = kVolumeError * (size * size * size);
    constexpr int kFaces[4][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
    bool positive = true, negative = true;
    for (const auto& f : kFaces) {
      const Point &a = corner_[f[0]], &b = corner_[f[1]], &c = corner_[f[2]];
      const Point normal = Cross(b - a, c - a);
      const double height = Dot(normal, a), least = std::abs(height) - error;
      const double reach = radius * radius * Dot(normal, normal) * kSquareMargin;
      const bool far = least > 0 && least * least > reach;
      positive &= far && height > 0;
      negative &= far && height < 0;
    }
    return positive || negative;
  }

  const SmallGjkPair& pair_;
  Point corner_[4];
  int count_ = 0;
};

WIDE inline SmallGjkResult Find(const SmallGjkPair& pair) { return Search(pair).Run(); }

}  // namespace collision::narrow_phase::gjk_small::COLLISION_SIMD
