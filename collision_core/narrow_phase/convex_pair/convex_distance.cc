// What a search proposes, certified. The lower end is the gap of the two sets' shadows along one
// direction, whatever the direction; the upper end the length between two points that certainly
// belong to them, or less the radius of a ball that their difference certainly holds. So a wrong
// proposal makes the bracket wide, never wrong.
#include "collision_core/narrow_phase/convex_pair/convex_distance.h"

#include <algorithm>
#include <cmath>

#include "collision_core/geometry/convex/box_zonotope.h"
#include "collision_core/geometry/convex/direction_polish.h"
#include "collision_core/geometry/convex/epa.h"
#include "collision_core/geometry/convex/feature_directions.h"
#include "collision_core/geometry/convex/gjk_simplex.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// A unit vector computed, its length and a product with it: a few roundings of 2^-53 each.
constexpr double kUnitError = 8 * 0x1p-53;

/// A bracket narrower than this share of S is as good as the arithmetic.
constexpr double kTight = 96 * 0x1p-53;

class Bracket {
 public:
  Bracket(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
          const ConvexQuestion& question, WorkBudget* work)
      : pair_(a, b),
        question_(question),
        work_(*work),
        rounding_(a.rounding + b.rounding),
        error_(numeric::AddUp(a.error, b.error)) {}

  void Find(geometry::GjkHint* hint, ConvexSeparation* result) {
    if (question_.goal != ConvexGoal::kYesNo || !IsPlainFromFaces()) {
      Narrow(*hint);
      KeepGjkHint(pair_, search_, hint);
    }
    SetResult(result);
  }

  numeric::Interval FindInterval() {
    if (question_.goal != ConvexGoal::kYesNo || !IsPlainFromFaces()) Narrow({});
    return {separation_lower(), separation_upper()};
  }

 private:
  void Narrow(const geometry::GjkHint& hint) {
    Search(hint);
    TakeSearched();
    SetUpper();
    if (!search_.encloses && !IsGoodEnough()) TryFeatures();
    if (!search_.encloses && pair_.IsSmooth() && !IsGoodEnough()) Polish();
    if (MayOverlap()) Deepen();
  }

  bool AreZonotopes() const {
    if (pair_.a().IsThin() && pair_.b().IsThin()) return false;
    return IsZonotope(pair_.a()) && IsZonotope(pair_.b());
  }

  void TakeFaces(double apart) {
    const geometry::FaceSeparation faces = SeparationOfFaces(pair_, apart);
    work_.Spend(kFacesUnits);
    Take(faces.direction, faces.gap);
    inside_ = std::max(inside_, faces.inside);
    if (inside_ > 0) upper_ = std::min(upper_, -inside_);
  }

  /// Yes or no, of few faces. Of the points nothing is known but that the centres belong to the
  /// cores.
  bool IsPlainFromFaces() {
    if (!AreZonotopes()) return false;
    TakeFaces(GoalOfSearch().apart);
    if (!(separation_lower() > 0 || separation_upper() <= 0)) return false;
    search_.simplex[0] = pair_.At({Vector3d::Zero(), Vector3d::Zero()});
    search_.weights[0] = 1;
    search_.count = 1;
    search_.nearest = pair_.between();
    SetUpper();
    return true;
  }

  void Search(const geometry::GjkHint& hint) {
    if (pair_.a().IsThin() && pair_.b().IsThin()) {
      NearestOfSegments(pair_, &search_);
    } else {
      RunGjk(pair_, hint, GoalOfSearch(), &search_);
    }
    work_.Spend(kGjkStepUnits * search_.steps);
    exhausted_ = search_.steps >= geometry::kGjkStepsMax || work_.exhausted();
  }

  std::uint32_t StepsOf(std::uint64_t units, std::uint32_t most) const {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(work_.left() / units + 1, most));
  }

  geometry::GjkGoal GoalOfSearch() const {
    geometry::GjkGoal goal{question_.relative_tolerance / 4, question_.absolute_tolerance / 4,
                           rounding_};
    goal.steps = StepsOf(kGjkStepUnits, geometry::kGjkStepsMax);
    if (question_.goal != ConvexGoal::kYesNo) return goal;
    const double margin = 2 * (pair_.GapError() + pair_.PointError() + error_);
    goal.apart = rounding_ + margin;
    if (rounding_ > margin) goal.near = rounding_ - margin;
    return goal;
  }

  /// The gap of the cores' shadows, rounded down, counts if it is the widest so far.
  void Try(const Vector3d& direction) {
    const double length = std::sqrt(direction.squaredNorm());
    if (!(length > geometry::kSupportUnderflow)) return;
    const Vector3d n = direction / length;
    Take(n, n.dot(pair_.Against(n).y));
  }

  /// |n| is 1 only to within kUnitError.
  void Take(const Vector3d& n, double computed) {
    const double gap = computed - pair_.GapError();
    const double certain = gap - 2 * kUnitError * std::abs(gap);
    if (certain > lower_) lower_ = certain, normal_ = n;
  }

  void TakeSearched() {
    const double length = std::sqrt(search_.direction.squaredNorm());
    if (!(search_.gap > -numeric::kInfinity)) return Try(search_.direction);
    Take(search_.direction / length, search_.gap);
  }

  void SetUpper() {
    const double length = std::sqrt(search_.nearest.squaredNorm());
    upper_ = std::min(
        upper_, numeric::AddUp(numeric::MultiplyUp(length, 1 + kUnitError), pair_.PointError()));
  }

  bool IsGoodEnough() const {
    if (question_.goal == ConvexGoal::kYesNo &&
        (separation_lower() > 0 || separation_upper() <= 0)) {
      return true;
    }
    const double least = std::max({0.0, separation_lower(), -separation_upper()});
    const double share = question_.relative_tolerance * least;
    return upper_ - lower_ <=
           std::max({question_.absolute_tolerance, share, kTight * pair_.size()});
  }

  /// The way between nearest points a short way apart is uncertain; features tell it exactly.
  void TryFeatures() {
    const geometry::FeatureDirections features(pair_, search_.direction);
    for (const Vector3d& direction : features) {
      work_.Spend(kGjkStepUnits);
      Try(direction);
      if (IsGoodEnough()) return;
    }
  }

  /// Beside something smooth: the corner, the edge or the face that the search ended at is that of
  /// the other core, if it has any.
  void Polish() {
    std::array<Vector3d, 4> corners;
    const int count = CornersOfOther(&corners);
    PolishAlong(Vector3d::Zero());
    const Vector3d* const c = corners.data();
    for (int i = 1; i < count; ++i) {
      for (int j = 0; j < i && !IsGoodEnough(); ++j) PolishAlong(c[i] - c[j]);
    }
    if (count == 3 && !IsGoodEnough()) {
      const Vector3d across = (c[1] - c[0]).cross(c[2] - c[0]);
      TryWithPoints(across.dot(search_.direction) < 0 ? Vector3d(-across) : across);
    }
  }

  void PolishAlong(const Vector3d& edge) {
    work_.Spend(kGjkStepUnits * geometry::kPolishSteps);
    TryWithPoints(WidestNear(pair_, search_.direction, edge));
  }

  /// Distinct corners of the simplex on the side that is not smooth, seen from its centre.
  int CornersOfOther(std::array<Vector3d, 4>* corners) const {
    if (pair_.a().IsSmooth() && pair_.b().IsSmooth()) return 0;
    const bool of_a = pair_.b().IsSmooth();
    int count = 0;
    for (int i = 0; i < search_.count; ++i) {
      const geometry::ConvexPair::Witness& witness = search_.simplex[i].witness;
      const Vector3d x = of_a ? pair_.a().PointAt(witness.a) : pair_.b().PointAt(witness.b);
      if (std::find(corners->begin(), corners->begin() + count, x) == corners->begin() + count) {
        (*corners)[count++] = x;
      }
    }
    return count;
  }

  /// Along a direction, and with its point of the smooth core instead of those of the simplex.
  void TryWithPoints(const Vector3d& direction) {
    const double length = std::sqrt(direction.squaredNorm());
    if (!(length > geometry::kSupportUnderflow)) return;
    const Vector3d n = direction / length;
    const geometry::ConvexPair::Point there = pair_.Against(n);
    Take(n, n.dot(there.y));
    geometry::GjkResult moved = search_;
    std::array<const Vector3d*, 4> corners{};
    for (int i = 0; i < moved.count; ++i) {
      geometry::ConvexPair::Witness witness = moved.simplex[i].witness;
      if (pair_.a().IsSmooth()) witness.a = there.witness.a;
      if (pair_.b().IsSmooth()) witness.b = there.witness.b;
      moved.simplex[i] = pair_.At(witness);
      corners[i] = &moved.simplex[i].y;
    }
    geometry::SimplexPoint point;
    NearestOfSimplex(corners, moved.count, -1, &point);
    if (point.encloses) return;
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < point.count; ++i) {
      const int corner = point.corners[i];
      sum += point.weights[i] * moved.simplex[corner].y;
    }
    if (!(sum.squaredNorm() < search_.nearest.squaredNorm())) return;
    for (int i = 0; i < point.count; ++i) {
      search_.simplex[i] = moved.simplex[point.corners[i]];
      search_.weights[i] = point.weights[i];
    }
    search_.count = point.count;
    search_.nearest = sum;
    SetUpper();
  }

  bool MayOverlap() const { return !(lower_ > 0) && !IsGoodEnough(); }

  void Deepen() {
    if (AreZonotopes()) {
      TakeFaces(numeric::kInfinity);
      if (IsGoodEnough() || (question_.goal != ConvexGoal::kDepth && separation_upper() <= 0))
        return;
    }
    Grow();
  }

  void Grow() {
    geometry::EpaGoal goal{question_.relative_tolerance, question_.absolute_tolerance};
    if (question_.goal != ConvexGoal::kDepth) goal.inside = std::max(0.0, 2 * error_ - rounding_);
    goal.steps = StepsOf(kEpaStepUnits, geometry::kEpaStepsMax);
    const geometry::Overlap overlap = RunEpa(pair_, search_, goal);
    work_.Spend(kEpaStepUnits * overlap.steps);
    exhausted_ = exhausted_ || overlap.steps >= goal.steps;
    inside_ = std::max(inside_, overlap.inside);
    if (inside_ > 0) upper_ = std::min(upper_, -inside_);
    Try(overlap.direction);
    if (!(lower_ > -numeric::kInfinity)) Try(Vector3d::UnitX());
  }

  double separation_lower() const {
    return numeric::AddDown(lower_, -numeric::AddUp(rounding_up(), error_));
  }

  double separation_upper() const {
    return numeric::AddUp(upper_, numeric::AddUp(error_, -rounding_down()));
  }

  double rounding_up() const { return numeric::AddUp(pair_.a().rounding, pair_.b().rounding); }
  double rounding_down() const { return numeric::AddDown(pair_.a().rounding, pair_.b().rounding); }

  void SetResult(ConvexSeparation* to) const {
    ConvexSeparation& result = *to;
    result.separation = {separation_lower(), separation_upper()};
    result.normal = normal_;
    result.normal_error = NormalError();
    result.exhausted = exhausted_ && !IsGoodEnough();
    SetPoints(&result);
  }

  // The shortest way w of the exact cores has n·w >= L and |w| <= U: its angle θ with n has
  // cos θ >= L / U, and θ <= (π/2) sin θ up to a right angle.
  double NormalError() const {
    const double lower = numeric::AddDown(lower_, -error_), upper = numeric::AddUp(upper_, error_);
    if (!(lower > 0) || !(lower <= upper)) return std::numbers::pi;
    const double sine = std::sqrt((upper - lower) * (upper + lower)) / upper;
    return std::min(std::numbers::pi, (1 + 0x1p-40) * 1.5707963267948968 * sine + kUnitError);
  }

  void SetPoints(ConvexSeparation* result) const {
    Vector3d of_a = Vector3d::Zero(), of_b = Vector3d::Zero();
    for (int i = 0; i < search_.count; ++i) {
      of_a += search_.weights[i] * search_.simplex[i].witness.a;
      of_b += search_.weights[i] * search_.simplex[i].witness.b;
    }
    of_a = pair_.a().PointAt(of_a);
    of_b = pair_.between() + pair_.b().PointAt(of_b);
    const double upper = result->separation.upper;
    const double certain = pair_.PointError() + error_ + kUnitError * rounding_;
    const Vector3d way = of_b - of_a;
    const double length = std::sqrt(way.squaredNorm());
    const double radius_a = pair_.a().rounding, radius_b = pair_.b().rounding;
    if (upper > 0) {
      const Vector3d n = length > 0 ? Vector3d(way / length) : normal_;
      const double shorter = rounding_ > length ? length / rounding_ : 1;
      result->a = pair_.a().centre + of_a + shorter * radius_a * n;
      result->b = pair_.a().centre + of_b - shorter * radius_b * n;
      result->point_error = certain + CentreError();
      return;
    }
    // Within radius_a of one and radius_b of the other, if the radii reach so far.
    const double along = std::clamp(0.5 * (length - radius_b + radius_a), 0.0, length);
    const Vector3d common = length > 0 ? Vector3d(of_a + along / length * way) : of_a;
    result->a = result->b = pair_.a().centre + common;
    result->point_error = certain + CentreError() + FurtherToCommon(length, certain, -upper);
  }

  double CentreError() const {
    return 0x1p-51 * (pair_.a().centre.cwiseAbs().sum() + pair_.size() + rounding_);
  }

  // Points a of A and b of B that are ρ apart. The difference holds the ball of the certain depth
  // m, so that there are a', b' with b' − a' = −(m / ρ)(b − a): on the way from a to a' and from b
  // to b' the share ρ / (ρ + m) is a common point, no further from a than that share of A's
  // diameter, nor from b than that of B's. What is told is half-way between a and b.
  double FurtherToCommon(double length, double certain, double depth) const {
    const double apart = std::max(0.0, length - rounding_) + 2 * certain;
    const double diameter = 2 * (std::min(pair_.a().span, pair_.b().span) + rounding_);
    return (1 + 0x1p-40) * (0.5 * apart + diameter * (apart / (apart + depth)));
  }

  const geometry::ConvexPair pair_;
  const ConvexQuestion& question_;
  WorkBudget& work_;
  const double rounding_;
  const double error_;
  geometry::GjkResult search_;
  double lower_ = -numeric::kInfinity;   ///< Of the cores; along the normal.
  double upper_ = numeric::kInfinity;    ///< Of the cores.
  double inside_ = -numeric::kInfinity;  ///< The depth of the cores at least.
  Vector3d normal_{0, 0, 0};
  bool exhausted_ = false;
};

}  // namespace

ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                              const ConvexQuestion& question, geometry::GjkHint* hint,
                              WorkBudget* work) {
  ConvexSeparation result;
  Bracket(a, b, question, work).Find(hint, &result);
  return result;
}

numeric::Interval IntervalOf(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                             const ConvexQuestion& question, WorkBudget* work) {
  return Bracket(a, b, question, work).FindInterval();
}

// The nearest point of A along −n is at x = c + support: its height n·(x − p) over the boundary is
// off by |n − exact| |x − p|, by the point's error, and by rounding relative to
// S = |c − p|₁ + span (as GapError() of a pair).
ConvexSeparation SeparationOf(const geometry::ConvexSet& a, const PosedHalfSpace& b) {
  const geometry::ConvexSet boundary = geometry::BallSet(b.point, 0);
  const geometry::ConvexPair pair(boundary, a);
  const geometry::ConvexPair::Point lowest = pair.Against(b.normal);
  const double height = b.normal.dot(lowest.y);
  const double turned = numeric::AddUp(b.normal_error, 0x1p-40 * b.normal_error);
  const double error = numeric::AddUp(
      numeric::AddUp(pair.GapError(), numeric::MultiplyUp(kUnitError, std::abs(height))),
      numeric::AddUp(numeric::MultiplyUp(turned, pair.size()),
                     numeric::AddUp(a.error, b.point_error)));
  ConvexSeparation result;
  result.separation = {numeric::AddDown(height, -numeric::AddUp(a.rounding, error)),
                       numeric::AddUp(height, numeric::AddUp(-a.rounding, error))};
  result.normal = -b.normal;
  result.normal_error = std::min(std::numbers::pi, 1.5707963267948968 * turned + kUnitError);
  const Vector3d foot = b.point + lowest.y;
  result.a = foot - a.rounding * b.normal;
  result.b = foot - height * b.normal;
  result.point_error =
      numeric::AddUp(error, 0x1p-51 * (b.point.cwiseAbs().sum() + pair.size() + a.rounding));
  if (result.separation.upper <= 0) result.b = result.a;
  return result;
}

}  // namespace collision::narrow_phase
