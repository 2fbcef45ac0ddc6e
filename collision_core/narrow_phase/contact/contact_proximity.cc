#include "collision_core/narrow_phase/contact/contact_proximity.h"

#include <algorithm>
#include <cmath>

namespace collision::narrow_phase {
namespace {

using PoseQuery = ShapeMotion::PoseQuery;

// Covers a dozen roundings of a result, each 2^-53 of it, several hundred times over.
constexpr double kRounding = 1e-12;

// The rounding of the directions that are compared and turned into the world [rad]: a few dozen
// units of 2^-53.
constexpr double kDirectionRounding = 1e-12;

// What rounding may have taken from the computed |x| of a point of A in A's body frame [m]: at most
// 2.5 · 2^-53 |x|, which is less than this for |x| < 3.6 km. That is the distance from A's
// reference point, not from the origin of the world. For larger bodies the error of an event's
// point may be stated too small by 2.5 · 2^-53 of the part that turning contributes, chord_A |x|.
constexpr double kLengthRounding = 1e-12;

// A bound on the angle whose sine is x: the tangent is no smaller, and where x is near 1, so that
// 1 − x² loses digits, far larger. π where x is no sine.
double AngleOfSine(double x) {
  if (!(x < 1)) return std::numbers::pi;
  return std::min(std::numbers::pi, x / std::sqrt(1 - x * x) * (1 + kRounding));
}

// The shortest way between two convex sets is unique. Where points of the sets are displaced by at
// most u relative to each other it changes, as a vector, by at most u + 2 √(u (d + u)): with v, v'
// the shortest differences before and after, some difference w before lies within u of v', and
// v·(w − v) >= 0, so |w − v|² <= |w|² − |v|² <= (|v| + 2u)² − |v|². Likewise a way of length
// at most U differs from the shortest one, at least L long, by at most √(U² − L²).
double DeviationOf(const NearestWay& way, double translation) {
  const double lower = std::max(0.0, way.lower), upper = std::max(lower, way.upper);
  const double u = translation + (upper - lower);
  return std::sqrt((upper - lower) * (upper + lower)) + u + 2 * std::sqrt(u * (upper + u));
}

BracketLimit LimitOf(const PoseQuery& query, double size) {
  if (query.bracket.exhausted) return BracketLimit::kBudget;
  return query.uncertainty > kExactMotion * size ? BracketLimit::kMotion : BracketLimit::kGeometry;
}

// Moved by so much along the line of their reference points, two bodies within balls of radii that
// add up to `size` are apart.
double DepthMax(const RelativePose& pose, double size) {
  const double off = pose.offset_error + pose.translation;
  return std::max(0.0, size * (1 + kRounding) + off - pose.p_AB.norm() * (1 - kRounding));
}

}  // namespace

// One of the ways is the shortest: how far may it point away from the one taken?
ContactNormal NormalOf(const PoseQuery& query) {
  ContactNormal normal;
  const std::vector<NearestWay>& ways = query.bracket.ways;
  if (ways.empty()) return normal;
  const auto shortest = std::min_element(
      ways.begin(), ways.end(), [](const auto& x, const auto& y) { return x.upper < y.upper; });
  const Eigen::Vector3d taken = (shortest->b - shortest->a).normalized();
  double error = 0;
  for (const NearestWay& way : ways) {
    const Eigen::Vector3d v = way.b - way.a;
    const double length = v.norm();
    if (!(length > 0)) return normal;
    const double half_chord = (v / length - taken).norm() / 2;
    const double apart = 2 * AngleOfSine(half_chord);
    error = std::max(error, apart + AngleOfSine(DeviationOf(way, query.pose.translation) / length));
  }
  normal.known = true;
  normal.normal = query.pose.R_WA * taken;
  normal.error = std::min(std::numbers::pi, error + query.pose.matrix_error + kDirectionRounding);
  return normal;
}

Proximity ProximityFrom(const PoseQuery& query, const ShapeMotion& motion, double size) {
  Proximity proximity;
  if (!query.choice.certain) return proximity;
  const RelativePose& pose = query.pose;
  const SeparationBracket& bracket = query.bracket;
  proximity.separation = {numeric::AddDown(bracket.lower, -pose.translation),
                          numeric::AddUp(bracket.upper, pose.translation)};
  if (query.touching()) proximity.separation.upper = std::min(proximity.separation.upper, 0.0);
  if (!query.apart() || !query.neither_inside) {
    const double depth = std::min(DepthMax(pose, size), motion.DepthAtMost(query));
    proximity.separation.lower = std::min(proximity.separation.upper, -depth);
  }
  proximity.depth_lower = std::max(0.0, -proximity.separation.upper);
  proximity.p_WC = pose.p_WA + pose.R_WA * bracket.point;
  proximity.point_error = numeric::AddUp(
      numeric::AddUp(bracket.point_error, pose.error_A),
      numeric::AddUp(pose.translation,
                     numeric::MultiplyUp(pose.chord_A,
                                         numeric::AddUp(bracket.point.norm(), kLengthRounding))));
  // A guess: normal_error stays π.
  const Eigen::Vector3d between = pose.R_WA * pose.p_AB;
  if (between.norm() > 0) proximity.normal = between.normalized();
  if (bracket.elements && motion.HasElementsA()) proximity.element_A = bracket.elements->a;
  if (bracket.elements && motion.HasElementsB()) proximity.element_B = bracket.elements->b;
  proximity.level = bracket.level;
  proximity.limited_by = LimitOf(query, size);
  return proximity;
}

}  // namespace collision::narrow_phase
