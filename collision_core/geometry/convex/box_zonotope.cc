// With u = 2^-53 and S the pair's size, of a normal N = g_i × g_j and n as it is computed:
//
//   n     is off from N by less than 4u |g_i| |g_j|, a difference of two products per coordinate.
//   f(n)  = Σ |n·g_k| − |n·d|, the reach of the zonotope beyond 0, is computed to within 10u |n| S,
//         and f(N) is off from f(n) by |N − n| S. So
//           f(N) >= f(n) − (10u |n| + 4u |g_i| |g_j|) S,   |N| <= (1 + 4u) |n| + 4u |g_i| |g_j|.
//
// The ball about 0 that the zonotope holds has the radius min f(N) / |N| over all pairs, where that
// is positive: pairs that are no faces have no less. The generators are exact (convex_set.h), the
// centres' difference d is off by u S, counted with f(n).
//
// Edges that are parallel but for rounding, as those of boxes with equal orientations, have no
// certain normal. One of the two is taken to be exactly parallel to the other: with σ the sine of
// the angle, rounded up, that moves it by σ |g|, the zonotope's reach by as much, and the normals
// of its other pairs by σ |g_i| |g_j|. A third edge parallel to both is not supported: then nothing
// is certain.
#include "collision_core/geometry/convex/box_zonotope.h"

#include <Eigen/Geometry>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

struct HalfEdges {
  std::array<Vector3d, 6> edges;
  std::array<double, 6> squares;
  int count = 0;

  void Add(const ConvexSet& set) {
    const int more = set.core == ConvexCore::kBox ? 3 : (set.core == ConvexCore::kSegment ? 1 : 0);
    for (int i = 0; i < more; ++i) {
      edges[count] = set.generators.col(i);
      squares[count] = edges[count].squaredNorm();
      ++count;
    }
  }
};

/// The squared sine of the angle between edges that are taken as parallel.
constexpr double kParallel = 1e-28;

/// On σ, a root, a quotient and products of positive terms: a few roundings, and the second order.
constexpr double kSineUp = 1.01;

/// Of |g_i| |g_j|: n is off from N by less than 4u of it, and it is itself a root of a product that
/// is off by less than 5u.
constexpr double kNormalError = 5 * numeric::kUnitRoundoff;

/// Of |n| S: f(n) is off by 10u of it, and this product by a few roundings of itself.
constexpr double kReachError = 12 * numeric::kUnitRoundoff;

/// |n| is off by 2.5u of itself (squares, two sums, a root). The two products with these factors,
/// the sum that bounds |N|, the difference of reach and error, and the quotient cost a rounding
/// each: 7.5u in all. The factors take 8u.
constexpr double kLengthUp = 1 + 4 * numeric::kUnitRoundoff,
                 kRadiusDown = 1 - 4 * numeric::kUnitRoundoff;

/// IsNoNearer() leaves aside normals with a squared sine below kClearSquare, and reaches beyond 0
/// below 1e-10 |g_i| |g_j| S. With σ < 1.1e-14 a reach is off by less than 1.3e-14 |g_i| |g_j| S:
/// 1.3e-4 of it, and 2.6e-4 of its square; |n| is off by 1.3e-11 of itself. kSquareUp covers both
/// nearly four times.
constexpr double kClearSquare = 1e-6, kClearReachSquare = 1e-20, kSquareUp = 1.001;

class Faces {
 public:
  Faces(const ConvexPair& pair, double apart) : pair_(pair), apart_(apart) {
    half_.Add(pair.a());
    of_a_ = half_.count;
    half_.Add(pair.b());
  }

  FaceSeparation Find() {
    inside_ = numeric::kInfinity;
    const bool all = FindParallels() && TryPairs();
    if (all && inside_ < numeric::kInfinity)
      found_.inside = inside_ - kSineUp * parallel_ * pair_.size();
    return found_;
  }

 private:
  /// Returns false if an edge is parallel to more than one other.
  bool FindParallels() {
    std::array<int, 6> partners{};
    for (int i = 0; i < half_.count; ++i) {
      for (int j = i + 1; j < half_.count; ++j) {
        const double squares = half_.squares[i] * half_.squares[j];
        const double square = half_.edges[i].cross(half_.edges[j]).squaredNorm();
        if (!(squares > 0) || square > kParallel * squares) continue;
        if (++partners[i] > 1 || ++partners[j] > 1) return false;
        parallel_ = std::max(parallel_, kSineUp * std::sqrt(square / squares) + kNormalError);
      }
    }
    return true;
  }

  /// Tries the faces of the cores themselves first, because they separate most pairs that are
  /// apart. Returns false if it ended early.
  bool TryPairs() {
    for (const bool within : {true, false}) {
      for (int i = 0; i < half_.count; ++i) {
        for (int j = i + 1; j < half_.count; ++j) {
          if (((i < of_a_) == (j < of_a_)) != within) continue;
          if (Try(i, j)) return false;
        }
      }
    }
    return true;
  }

  bool Try(int i, int j) {
    const Vector3d &g = half_.edges[i], &h = half_.edges[j];
    const Vector3d n = g.cross(h);
    const double square = n.squaredNorm();
    const double squares = half_.squares[i] * half_.squares[j];
    if (!(square > kParallel * squares)) return false;
    double reach = 0;
    for (int k = 0; k < half_.count; ++k) {
      if (k != i && k != j) reach += std::abs(n.dot(half_.edges[k]));
    }
    const double along = n.dot(pair_.between());
    const double beyond = reach - std::abs(along);
    if (IsNoNearer(beyond, square, squares)) return false;
    const double length = std::sqrt(square), lengths = std::sqrt(squares);
    const double off = (kNormalError + kSineUp * parallel_) * lengths;
    const double error = (kReachError * length + off) * pair_.size();
    const double most = kLengthUp * length + off;
    inside_ = std::min(inside_, (beyond - error) / most * kRadiusDown);
    if (-beyond > found_.gap * length) {
      found_.gap = -beyond / length;
      found_.direction = along < 0 ? Vector3d(n / -length) : Vector3d(n / length);
    }
    return found_.gap > apart_;
  }

  /// Whether the reach beyond 0 clearly exceeds the least one so far, all errors included: then no
  /// root is needed, as for most pairs.
  bool IsNoNearer(double beyond, double square, double squares) const {
    return beyond > 0 && inside_ > 0 && inside_ < numeric::kInfinity &&
           square > kClearSquare * squares &&
           beyond * beyond > kClearReachSquare * squares * pair_.size() * pair_.size() &&
           beyond * beyond > kSquareUp * inside_ * inside_ * square;
  }

  const ConvexPair& pair_;
  const double apart_;
  HalfEdges half_;
  int of_a_ = 0;
  double inside_ = 0;
  double parallel_ = 0;  ///< σ: of edges that are taken as parallel.
  FaceSeparation found_;
};

}  // namespace

FaceSeparation SeparationOfFaces(const ConvexPair& pair, double apart) {
  CORE_CHECK(IsZonotope(pair.a()) && IsZonotope(pair.b()), "both cores are zonotopes");
  return Faces(pair, apart).Find();
}

}  // namespace collision::geometry
