#include "collision_core/geometry/convex/gjk.h"

#include <cmath>

#include "collision_core/geometry/convex/gjk_simplex.h"
#include "collision_core/numeric/allowances.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Up to this share of S, a distance counts as contact: a search in doubles cannot resolve less.
constexpr double kTouching = 4 * numeric::kUnitRoundoff;

/// Smooth cores are followed down to this share of S: further down the corners of a simplex are so
/// near to each other that it has no direction.
constexpr double kSmooth = 0x1p-44;

/// Largest magnitude that counts as 0 for the weighted sum of corners that enclose 0: this share of
/// S, or this share of the squared distance before.
constexpr double kEncloses = 16 * numeric::kUnitRoundoff;
constexpr double kEnclosesShare = 0x1p-40;

class Search {
 public:
  Search(const ConvexPair& pair, const GjkGoal& goal, GjkResult* result)
      : pair_(pair),
        goal_(goal),
        result_(*result),
        enough_((pair.IsSmooth() ? kSmooth : kTouching) * pair.size()) {}

  void Run(const GjkHint& start) {
    Begin(start);
    while (result_.steps < goal_.steps && !result_.encloses) {
      const double square = result_.direction.squaredNorm();
      const double touching = kTouching * pair_.size();
      if (!(square > touching * touching)) break;
      const double length = std::sqrt(square);
      if (length < goal_.near) break;
      const Vector3d n = result_.direction / length;
      ConvexPair::Point& found = result_.simplex[result_.count];
      pair_.FindAgainst(n, &found);
      ++result_.steps;
      const double along = n.dot(found.y);
      result_.gap = along;
      if (along > goal_.apart || IsGoodEnough(length, along) || IsKnown(found)) break;
      if (!TakeLast()) break;
    }
  }

 private:
  void Begin(const GjkHint& start) {
    if (start.count > 0 && start.a == GjkHint::OwnerOf(pair_.a()) &&
        start.b == GjkHint::OwnerOf(pair_.b())) {
      return BeginFrom(start);
    }
    Vector3d n = pair_.between();
    const double length = std::sqrt(n.squaredNorm());
    n = length > 0 ? Vector3d(n / length) : Vector3d(1, 0, 0);
    pair_.FindAgainst(n, &result_.simplex[0]);
    BeginAtFirst();
  }

  void BeginAtFirst() {
    result_.weights[0] = 1;
    result_.count = 1;
    ++result_.steps;
    result_.direction = result_.nearest = result_.simplex[0].y;
  }

  /// Starts from the hint's simplex at the present pose, or from its first corner if that is as
  /// near.
  void BeginFrom(const GjkHint& start) {
    for (int i = 0; i < start.count; ++i) result_.simplex[i] = pair_.At(start.witnesses[i]);
    BeginAtFirst();
    if (start.count > 1) TakeIfNearer(start.count, -1);
  }

  /// The nearest point is not nearer than `along`, and not further than `length`.
  bool IsGoodEnough(double length, double along) const {
    const double rest = length - along;
    const double share =
        along > 0 ? goal_.relative_tolerance * std::abs(along - goal_.rounding) : 0;
    return rest <= std::max({goal_.absolute_tolerance, share, enough_});
  }

  bool IsKnown(const ConvexPair::Point& found) const {
    for (int i = 0; i < result_.count; ++i) {
      if (result_.simplex[i].y == found.y) return true;
    }
    return false;
  }

  /// Returns false if the step did not come nearer: doubles cannot resolve any more.
  bool TakeLast() {
    const int count = result_.count + 1;
    const bool nearer = TakeIfNearer(count, count - 1) || TakeIfNearer(count, -1);
    return nearer && !result_.encloses;
  }

  /// The weights of a sliver are mostly rounding, so the point that they give is computed and
  /// tested. A tetrahedron so thin that rounding decides about its inside does not enclose 0.
  bool TakeIfNearer(int count, int newest) {
    std::array<const Vector3d*, 4> corners{};
    for (int i = 0; i < count; ++i) corners[i] = &result_.simplex[i].y;
    SimplexPoint point;
    NearestOfSimplex(corners, count, newest, &point);
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < point.count; ++i) {
      sum += point.weights[i] * result_.simplex[point.corners[i]].y;
    }
    const double square = sum.squaredNorm(), before = result_.nearest.squaredNorm();
    const double zero = kEncloses * pair_.size();
    const double most = point.encloses ? std::max(zero * zero, kEnclosesShare * before) : before;
    if (!(square < most)) return false;
    Keep(point);
    result_.nearest = sum;
    return true;
  }

  /// Corners stand in ascending order, so that none is overwritten before it is moved.
  void Keep(const SimplexPoint& point) {
    for (int i = 0; i < point.count; ++i) {
      if (point.corners[i] != i) result_.simplex[i] = result_.simplex[point.corners[i]];
      result_.weights[i] = point.weights[i];
    }
    result_.count = point.count;
    result_.encloses = point.encloses;
    result_.direction = point.nearest;
    result_.gap = -numeric::kInfinity;
  }

  const ConvexPair& pair_;
  const GjkGoal& goal_;
  GjkResult& result_;
  const double enough_;  ///< Nearest and furthest known differ by rounding only.
};

}  // namespace

void RunGjk(const ConvexPair& pair, const GjkHint& start, const GjkGoal& goal, GjkResult* result) {
  Search(pair, goal, result).Run(start);
}

void KeepGjkHint(const ConvexPair& pair, const GjkResult& result, GjkHint* hint) {
  hint->a = GjkHint::OwnerOf(pair.a());
  hint->b = GjkHint::OwnerOf(pair.b());
  hint->count = result.count;
  for (int i = 0; i < result.count; ++i) hint->witnesses[i] = result.simplex[i].witness;
}

}  // namespace collision::geometry
