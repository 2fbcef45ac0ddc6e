// Where two convex cores are nearest: a search in plain doubles, whose word is not taken for it.
#pragma once

#include <array>
#include <cstdint>

#include "collision_core/shape/convex_set.h"

namespace collision {

/// Two cores, their centres subtracted first: A is seen from its own centre, B from A's. Everything
/// is said of the difference B − A, the set of all b − a: its point nearest to 0 is the shortest
/// way from A to B, and 0 lies in it where the two meet.
class ConvexPair {
 public:
  ConvexPair(const ConvexSet& a, const ConvexSet& b) : a_(a), b_(b), between_(b.centre - a.centre) {
    size_ = (1 + 0x1p-50) * (between_.cwiseAbs().sum() + a.span + b.span);
  }

  /// Points of the two cores, as ConvexSet::PointAt() takes them: valid at any pose.
  struct Witness {
    Eigen::Vector3d a, b;
  };
  struct Point {
    Eigen::Vector3d y;  ///< b − a.
    Witness witness;
  };

  Point At(const Witness& witness) const {
    return {(between_ + b_.PointAt(witness.b)) - a_.PointAt(witness.a), witness};
  }
  /// The point of B − A that is furthest against n.
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

  /// For a unit n (within 2^-20): no n·y is less than n·Against(n).y, computed, less this. The
  /// supports' kSupportError, the rounding of the centres' and the points' differences (3u S), and
  /// of the product (3u S).
  double GapError() const { return kGapError * size_ + kSupportUnderflow; }
  /// Any Point, and any Σ w_i y_i with 1 to 4 weights w_i >= 0 whose sum is 1 to within 4u, is off
  /// from a point of B − A by less than this: the supports' kSupportError, the differences (3u S),
  /// the weights (4u S), products and sums (5u S).
  double PointError() const { return kPointError * size_ + kSupportUnderflow; }

 private:
  static constexpr double kGapError = kSupportError + 8 * 0x1p-53;
  static constexpr double kPointError = kSupportError + 14 * 0x1p-53;

  const ConvexSet& a_;
  const ConvexSet& b_;
  Eigen::Vector3d between_;
  double size_;
};

/// Steps of the search at most; what has smooth parts may use them up and stays wider then.
inline constexpr std::uint32_t kSearchStepsMax = 64;

/// Where a search ended, to begin another one there: of the same two solids at a similar pose that
/// takes fewer steps. Only speed depends on it: a hint of others is not taken.
struct SearchHint {
  /// What the witnesses are points of: the kind of core, and of a hull which points.
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

/// When a search may end; all of cores, not of what they are rounded by.
struct SearchGoal {
  double share = 0;     ///< Nearest and furthest known differ by so little, relative to how much
                        ///< they differ from `rounding`,
  double width = 0;     ///< or by so little [m].
  double rounding = 0;  ///< Of both sets together [m].
  double apart = kInfinity;  ///< It is enough to know that they are further apart than this,
  double near = -kInfinity;  ///< or nearer.
  std::uint32_t steps = kSearchStepsMax;
};

struct SearchResult {
  std::array<ConvexPair::Point, 4> simplex;
  std::array<double, 4> weights;  ///< Of the nearest point: >= 0, their sum 1 to within 4u.
  int count = 0;
  bool encloses = false;      ///< The simplex of four seems to hold 0.
  Eigen::Vector3d direction;  ///< Along the shortest way from A to B, about; any length.
  /// Along `direction`, made a unit vector, all of B − A is at least here, computed (see
  /// GapError()); where the search did not get to know it, −infinity.
  double gap = -kInfinity;
  Eigen::Vector3d nearest;  ///< Where the simplex is nearest to 0.
  std::uint32_t steps = 0;  ///< Pairs of support points asked for.
};

/// Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex
/// objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988.
void SearchNearest(const ConvexPair& pair, const SearchHint& start, const SearchGoal& goal,
                   SearchResult* result);

/// To begin the next search of these two with.
void KeepHint(const ConvexPair& pair, const SearchResult& result, SearchHint* hint);

/// Two cores that are points or segments: in closed form.
void NearestOfSegments(const ConvexPair& pair, SearchResult* result);

}  // namespace collision
