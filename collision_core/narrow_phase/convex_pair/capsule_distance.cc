// Points of the two cores are proposed, and y, the way between them, certified. With u = 2^-53 and
// S the size of the pair, d off by u |d|:
//   upper  |y| belongs to points of the cores. Two or four products and as many sums of terms that
//          are S together: y is off by less than 6u S, and its length by 2.5u more.
//   lower  the gap of the projections along y as it is computed: y·d less the reach of all edges.
//          Sums of three products, 3u |y| S together, six differences and d itself: less than 11u
//          |y| S.
//          The quotient by |y| adds 4u S, as it is no greater than S.
// Both are covered by kWayError S, and the last rounding of what is told.
#include "collision_core/narrow_phase/convex_pair/capsule_distance.h"

#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/geometry/convex/segment_fractions.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kWayError = 0x1p-49;

/// The half edges of a core: of A as they are, of B posed.
template <int kCount>
struct Edges {
  Vector3d of[kCount];

  explicit Edges(const geometry::ConvexSet& a) {
    for (int i = 0; i < kCount; ++i) of[i] = a.generators.col(i);
  }
  Edges(const geometry::ConvexSet& b, const Matrix3d& matrix) {
    for (int i = 0; i < kCount; ++i) of[i] = matrix * b.generators.col(i);
  }
  double Reach(const Vector3d& n) const {
    double reach = 0;
    for (int i = 0; i < kCount; ++i) reach += std::abs(n.dot(of[i]));
    return reach;
  }
};

template <int kCountA, int kCountB>
numeric::Interval Certified(const Vector3d& y, const Edges<kCountA>& a, const Edges<kCountB>& b,
                            const PosedCores& cores) {
  const double length = std::sqrt(y.squaredNorm());
  const double error = kWayError * cores.size + geometry::kSupportUnderflow;
  if (!(length > error)) return {-numeric::kInfinity, length + error};
  const double apart = y.dot(cores.d) - (a.Reach(y) + b.Reach(y));
  return {apart / length - error, length + error};
}

/// d leads from the box to the segment: the way between their nearest points, likewise.
Vector3d WayFromBox(const Vector3d& d, const Edges<3>& box, const Vector3d& axis) {
  double x[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    w[i] = box.of[i].squaredNorm();
    const double scale = w[i] > 0 ? 1 / w[i] : 0;
    x[i] = scale * box.of[i].dot(d);
    v[i] = scale * box.of[i].dot(axis);
  }
  const double t = geometry::FractionNearBox(x, v, w);
  Vector3d way = d + t * axis;
  for (int i = 0; i < 3; ++i) way -= geometry::ClampToMinusOneOne(x[i] + t * v[i]) * box.of[i];
  return way;
}

}  // namespace

// As PosedA() and PosedB() (convex_pose.cc).
PosedCores::PosedCores(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                       const RelativePose& pose)
    : d((pose.R_AB * b.centre + pose.p_AB) - a.centre),
      size(kPosedSumUp * (d.cwiseAbs().sum() + a.span + b.span)) {
  const double far_b = geometry::LengthUp(b.centre) + b.span;
  const double turned_a =
      pose.chord_A > 0 ? pose.chord_A * (geometry::LengthUp(a.centre) + a.span) : 0;
  error = numeric::kManyRoundingsUp *
          ((kPosedLengthUp * b.error + a.error) +
           (pose.offset_error + (pose.matrix_error + pose.chord_B) * far_b) + turned_a);
}

numeric::Interval DistanceOfCores(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                                  const PosedCores& cores, const RelativePose& pose) {
  CORE_CHECK(IsCapsulePair(a, b), "one core is thin, the other thin or a box");
  if (a.core == geometry::ConvexCore::kBox) {
    const Edges<3> box(a);
    const Edges<1> axis(b, pose.R_AB);
    return Certified(WayFromBox(cores.d, box, axis.of[0]), box, axis, cores);
  }
  const Edges<1> axis(a);
  if (b.core == geometry::ConvexCore::kBox) {
    const Edges<3> box(b, pose.R_AB);
    const Vector3d way = -WayFromBox(-cores.d, box, axis.of[0]);
    return Certified(way, axis, box, cores);
  }
  const Edges<1> other(b, pose.R_AB);
  const auto [s, t] = geometry::NearestOnSegments(cores.d, axis.of[0], other.of[0]);
  return Certified(Vector3d((cores.d + t * other.of[0]) - s * axis.of[0]), axis, other, cores);
}

}  // namespace collision::narrow_phase
