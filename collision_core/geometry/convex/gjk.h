// Where two convex cores are nearest (GJK): proposals in plain doubles, to be certified by the
// caller.
#pragma once

#include <array>
#include <cstdint>

#include "collision_core/geometry/convex/convex_set.h"
#include "collision_core/numeric/allowances.h"

namespace collision::geometry {

/// Two convex cores, seen as their difference B − A: the set of all b − a. Its point nearest to 0
/// is the shortest way from A to B, 0 inside means that the two meet, and a support point of it is
/// one of B less one of A. The centres are subtracted first (A is seen from its own centre, B from
/// A's), so rounding is relative to the size of the pair; their place in the world does not count.
///
/// A convex solid is a core (point, segment, box, ellipsoid, cylinder, cone, hull) and all points
/// within a radius of it. The searches treat cores; the radii are added at the end.
class ConvexPair {
 public:
  ConvexPair(const ConvexSet& a, const ConvexSet& b) : a_(a), b_(b), between_(b.centre - a.centre) {
    size_ = numeric::kFewRoundingsUp * (between_.cwiseAbs().sum() + a.span + b.span);
  }

  /// Points of the two cores, as ConvexSet::PointAt() takes them: valid at any pose.
  struct Witness {
    Eigen::Vector3d a, b;
  };
  /// A point of the difference, and the points of the cores that it is made of.
  struct Point {
    Eigen::Vector3d y;  ///< b − a.
    Witness witness;
  };

  Point At(const Witness& witness) const {
    return {(between_ + b_.PointAt(witness.b)) - a_.PointAt(witness.a), witness};
  }
  /// Finds the point of B − A with the least n·y, a support point along −n.
  void FindAgainst(const Eigen::Vector3d& n, Point* point) const {
    point->witness.a = a_.Support(n);
    point->witness.b = b_.Support(-n);
    point->y = (between_ + b_.PointAt(point->witness.b)) - a_.PointAt(point->witness.a);
  }
  Point Against(const Eigen::Vector3d& n) const {
    Point point;
    FindAgainst(n, &point);
    return point;
  }

  const ConvexSet& a() const { return a_; }
  const ConvexSet& b() const { return b_; }
  const Eigen::Vector3d& between() const { return between_; }  ///< From centre to centre.
  bool IsSmooth() const { return a_.IsSmooth() || b_.IsSmooth(); }
  /// S = |c_B − c_A|₁ + span_A + span_B: what rounding is relative to.
  double size() const { return size_; }

  /// For a unit n (to within 2^-20), every point y of B − A has n·y >= (the computed
  /// n·Against(n).y) − GapError() [m]. It covers the supports' kSupportError, the rounding of the
  /// differences of centres and of points (3u S), and of the product (3u S).
  double GapError() const { return kGapError * size_ + kSupportUnderflow; }
  /// Any Point, and any Σ w_i y_i with 1 to 4 weights w_i >= 0 whose sum is 1 to within 4u, is off
  /// from a point of B − A by less than this [m]: the supports' kSupportError, the differences (3u
  /// S), the weights (4u S), products and sums (5u S).
  double PointError() const { return kPointError * size_ + kSupportUnderflow; }

 private:
  static constexpr double kGapError = kSupportError + 8 * numeric::kUnitRoundoff;
  static constexpr double kPointError = kSupportError + 14 * numeric::kUnitRoundoff;

  const ConvexSet& a_;
  const ConvexSet& b_;
  Eigen::Vector3d between_;
  double size_;
};

/// The most steps of the search. A pair with smooth parts may use them up; its bracket then stays
/// as wide as it is.
inline constexpr std::uint32_t kGjkStepsMax = 64;

/// Where a search ended. Another search of the same two solids at a similar pose starts there and
/// takes fewer steps. Only the speed depends on it; a hint that was kept for cores of another kind
/// or for other hull points is ignored.
struct GjkHint {
  /// The set that the witnesses belong to: the kind of its core and, for a hull, its points.
  struct Owner {
    ConvexCore core = ConvexCore::kPoint;
    const ConvexPoints* points = nullptr;
    double reach = 0;
    bool operator==(const Owner&) const = default;
  };
  static Owner OwnerOf(const ConvexSet& set) {
    return {set.core, set.points, set.points ? set.points->reach() : 0};
  }

  std::array<ConvexPair::Witness, 4> witnesses;
  int count = 0;
  Owner a, b;
};

/// When a search may end: as soon as one of the conditions holds. Distances are of the cores,
/// without their rounding.
struct GjkGoal {
  /// Relative tolerance: stop when the lower and the upper bound of the distance differ by at most
  /// this fraction of the distance's difference from `rounding`.
  double relative_tolerance = 0;
  /// Absolute tolerance [m]: stop when the bounds differ by at most this.
  double absolute_tolerance = 0;
  double rounding = 0;                ///< The rounding radii of both sets together [m].
  double apart = numeric::kInfinity;  ///< Stop when the distance is known to exceed this [m].
  double near = -numeric::kInfinity;  ///< Stop when the distance is known to be below this [m].
  std::uint32_t steps = kGjkStepsMax;
};

/// What a search found: proposals, not proofs.
struct GjkResult {
  std::array<ConvexPair::Point, 4> simplex;
  std::array<double, 4> weights;  ///< Of the nearest point; >= 0, sum 1 to within 4u.
  int count = 0;
  bool encloses = false;      ///< The simplex of four seems to hold 0.
  Eigen::Vector3d direction;  ///< Approximately along the shortest way from A to B; any length.
  /// The computed least n·y over B − A [m] for the unit vector n along `direction`, off by at most
  /// GapError(); −infinity: the search did not compute it.
  double gap = -numeric::kInfinity;
  Eigen::Vector3d nearest;  ///< The point of the simplex nearest to 0.
  std::uint32_t steps = 0;  ///< Pairs of support points computed.
};

/// Searches for the point of B − A nearest to 0, until the goal is reached or the steps are used
/// up. Smooth cores, for which the search would never end by itself, are followed down to 2^-44 of
/// the pair's size; 1e-6 of the distance takes some 15 to 40 steps. The result is a proposal:
/// convex_pair/convex_distance.h certifies it. Source: Gilbert, Johnson and Keerthi, "A fast
/// procedure for computing the distance between complex objects in three-dimensional space", IEEE
/// J. Robotics and Automation 4(2), 1988.
void RunGjk(const ConvexPair& pair, const GjkHint& start, const GjkGoal& goal, GjkResult* result);

/// Stores in `hint` where a search of these two sets ended, for the next search.
void KeepGjkHint(const ConvexPair& pair, const GjkResult& result, GjkHint* hint);

/// The result of RunGjk() in closed form. Requires two cores that are points or segments.
void NearestOfSegments(const ConvexPair& pair, GjkResult* result);

}  // namespace collision::geometry
