#include "collision_core/narrow_phase/convex_pair/convex_front.h"

#include <Eigen/Geometry>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

/// With u = 2^-53, all of it relative to what is added up: kSupportError (18u) of span;
/// differences, cross products and the direction's sum 5u; products with it 3u; the last sums 4u;
/// the length times the rounding 4u. √3 for cross products by components.
constexpr double kFrontError = 48 * numeric::kUnitRoundoff;

/// n is longer than 1 by less than 2^-20; 2^-10 covers that and the bounds' own rounding.
constexpr double kBoundsUp = 1 + 0x1p-10;

/// The square of a length within 2^-20 of 1 is within 2^-19 of 1; twice that.
constexpr double kUnitSquareError = 0x1p-18;

double Length(const Vector3d& v) { return std::sqrt(v.squaredNorm()); }

/// The reach along m of what lies about the centre.
double ReachAlong(const geometry::ConvexSet& set, const Vector3d& m) {
  return m.dot(set.SupportPoint(m)) + Length(m) * set.rounding;
}

}  // namespace

MovingFront FrontOf(const geometry::ConvexSet& set, const TangentMotion& motion, const Vector3d& n,
                    const Vector3d& origin, double h) {
  CORE_CHECK(!(h < 0), "a front is that of a time that has come", h);
  CORE_CHECK(std::abs(n.squaredNorm() - 1) < kUnitSquareError, "the direction has length 1",
             n.norm());
  const Vector3d place = set.centre - origin, arm = set.centre - motion.about;
  const Vector3d turned = n.cross(motion.spin);
  const double speed = n.dot(motion.velocity) + turned.dot(arm);
  const double spin = motion.spin.cwiseAbs().sum();
  const double about = set.span + set.rounding;
  const double speeds = motion.velocity.cwiseAbs().sum() + spin * (arm.cwiseAbs().sum() + about);
  const double places = place.cwiseAbs().sum() + about;
  MovingFront front;
  front.fastest = speed + ReachAlong(set, turned) +
                  kBoundsUp * (kFrontError * speeds + set.error * spin) +
                  geometry::kSupportUnderflow;
  front.front = n.dot(place) + h * speed + ReachAlong(set, n + h * turned) +
                kBoundsUp * (kFrontError * (places + h * speeds) + set.error * (1 + h * spin)) +
                geometry::kSupportUnderflow;
  return front;
}

}  // namespace collision::narrow_phase
