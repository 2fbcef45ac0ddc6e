#include "collision_core/narrow_phase/advancement/swept_convex_pair.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// Relative tolerance of the bracket that gives a direction: the direction loses at most this share
/// of the gap.
constexpr double kDirectionShare = 0x1p-10;

constexpr int kChords = 40;

/// Beside the zero of a chord, as a share of the way there.
constexpr double kAside = 0x1p-10;

/// Ends this near to each other count as one.
constexpr double kOneInstant = 0x1p-46;

/// Each evaluation takes four supports.
constexpr std::uint64_t kGapUnits = 2;

/// The set at a later time, approximately: it serves only to find a direction.
geometry::ConvexSet After(const MovingSet& moving, double h) {
  const TangentMotion& motion = moving.motion;
  geometry::ConvexSet set = moving.set;
  set.centre += h * (motion.velocity + motion.spin.cross(set.centre - motion.about));
  for (Eigen::Index i = 0; i < set.generators.cols(); ++i) {
    const Vector3d g = set.generators.col(i);
    set.generators.col(i) += h * motion.spin.cross(g);
  }
  set.span *= 1 + h * motion.spin.norm();
  return set;
}

/// What is left of the gap along n, rounded down.
class GapAlong {
 public:
  GapAlong(const SweptConvexPair& solids, const Vector3d& n, WorkBudget* work)
      : solids_(solids), n_(n), origin_(solids.a.set.centre), work_(*work) {}

  double At(double t) const {
    work_.Spend(kGapUnits);
    const MovingSet &a = solids_.a, &b = solids_.b;
    const SweptPose::Growth& used = solids_.used;
    const double front_a = FrontOf(a.set, a.motion, n_, origin_, t).front;
    const double front_b = FrontOf(b.set, b.motion, -n_, origin_, t).front;
    // Four sums and products of positive terms.
    const double lost = numeric::kFewRoundingsUp * (used.c0 + t * (used.c1 + t * used.c2));
    return numeric::AddDown(-numeric::AddUp(front_a, front_b), -lost);
  }

 private:
  const SweptConvexPair& solids_;
  const Vector3d n_;
  const Vector3d origin_;
  WorkBudget& work_;
};

/// The last instant known to have a gap. A chord of a concave function between a gap and none meets
/// zero too early. If the function is nearly linear, the two instants about that zero enclose the
/// true one a thousand times closer; otherwise they double the way, or halve what is left.
double LastGap(const GapAlong& gap, double from, double to) {
  double free = from, free_gap = gap.At(from);
  if (!(free_gap > 0)) return from;
  double end = to, end_gap = gap.At(to);
  if (end_gap > 0) return numeric::kInfinity;
  const auto attempt = [&](double at) {
    if (!(at > free && at < end)) return;
    const double left = gap.At(at);
    (left > 0 ? free : end) = at;
    (left > 0 ? free_gap : end_gap) = left;
  };
  for (int chord = 0; chord < kChords && end - free > kOneInstant * to; ++chord) {
    const double before = free, before_gap = free_gap;
    const double way = (end - free) * (free_gap / (free_gap - end_gap));
    attempt(before + way * (1 - kAside));
    const bool nearly_linear = free > before && free_gap < 2 * kAside * before_gap;
    attempt(nearly_linear ? before + way * (1 + kAside)
                          : std::min(before + 2 * way, 0.5 * (free + end)));
  }
  return free;
}

}  // namespace

double ApartFor(const SweptConvexPair& solids, double h, double duration, WorkBudget* work) {
  const geometry::ConvexSet a = After(solids.a, h), b = After(solids.b, h);
  geometry::GjkHint none;
  const ConvexQuery query{ConvexGoal::kDistance, kDirectionShare, 0};
  const ConvexSeparation found = SeparationOf(a, b, query, &none, work);
  if (!(found.separation.lower > 0)) return 0;
  const double last = LastGap(GapAlong(solids, found.normal, work), h, duration);
  return last == numeric::kInfinity ? numeric::kInfinity : last - h;
}

}  // namespace collision::narrow_phase
