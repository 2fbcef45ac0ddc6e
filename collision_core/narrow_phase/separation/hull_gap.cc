#include "collision_core/narrow_phase/separation/hull_gap.h"

#include <cmath>
#include <limits>

#include "collision_core/narrow_phase/sphere_pairs/kernel_pose.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Bodies that are farther apart, or nearer at one place, than this [m] would need squares beyond
/// single precision.
constexpr double kFarApart = 1e15, kAtOnePlace = 1e-15;

/// Relative to S, the sum of both extents and of the offset between the origins. With u = 2^-24:
/// supports are off by kHullSupportError, 15 u, of the extents; B's direction is turned with an
/// error of √3 times 4 u, 7 u of its extent; the offset is cast (u) and multiplied (3.1 u); two
/// differences make 2 u S. A gap is made one along a unit vector to within 6 u, and each of four
/// times that a direction is mirrored it loses less than 22 u of its length (2 n·w / w² takes 9 u,
/// of a vector of length 2 at most, and the difference 3 u): a gap, less than S, is off by these 94
/// u of itself. In all less than 124 u S.
constexpr double kGapSlack = 0x1p-24 * 128;

/// Directions are at most this much longer than 1, and a ball's projection with them.
constexpr double kLonger = 1 + 0x1p-15;

/// Deeper than this share of the extents along the first line, and than half of it each time along
/// the later ones, there is mostly no gap to be found.
constexpr float kDeep = 0.12f;

/// The square of a first direction that is shorter than this share of the offset's has lost its
/// digits.
constexpr float kNoDirection = 0x1p-60f;

struct FloatMatrix {
  explicit FloatMatrix(const Eigen::Matrix3d& m) {
    for (Eigen::Index i = 0; i < 3; ++i) rows[i] = m.row(i).cast<float>();
  }
  Vector3f Times(const Vector3f& x) const {
    return {rows[0].dot(x), rows[1].dot(x), rows[2].dot(x)};
  }
  Vector3f TransposeTimes(const Vector3f& x) const {
    return (x[0] * rows[0] + x[1] * rows[1]) + x[2] * rows[2];
  }
  Vector3f rows[3];
};

/// A body along a direction, seen from an origin of its own; a ball is round.
struct HullSide {
  explicit HullSide(const BodyTree& body)
      : hull(body.shape() ? &body.shape()->hull() : nullptr),
        origin(hull ? hull->origin() : Vector3d(0, 0, 0)),
        extent(hull ? hull->extent() : body.reach()),
        radius(hull ? 0 : numeric::FloatUp(body.reach() * kLonger)),
        measure(hull ? hull->measure() : Vector3f(1, 1, 1)) {}

  /// `scale`: makes a unit vector of n.
  shape::OuterHull::Foremost Along(const Vector3f& n, float scale) const {
    return hull ? hull->ForemostAlong(n)
                : shape::OuterHull::Foremost{0, radius, (radius * scale) * n};
  }

  const shape::OuterHull* hull;
  Vector3d origin;
  double extent;
  float radius;
  Vector3f measure;
};

class HullPair {
 public:
  explicit HullPair(const PosedPair& pair) : a_(pair.a), b_(pair.b), matrix_(pair.pose.R_AB) {
    const auto& [a, b, pose] = pair;
    // The origins are posed in doubles, as centres of balls are. An origin may be √3 times as far
    // from the reference point as the body reaches: twice the slack has room for that.
    const Vector3d offset = pose.ToA(b_.origin) - a_.origin;
    extents_ = a_.extent + b_.extent;
    const double distance = offset.cwiseAbs().sum();
    known_ = distance < kFarApart && extents_ < kFarApart && distance > kAtOnePlace;
    const double turning = pose.chord_A * a.turning_reach() + pose.chord_B * b.turning_reach();
    slack_ = (2 * SlackOf(pair) + turning + kGapSlack * (extents_ + distance)) *
             numeric::kFewRoundingsUp;
    between_ = offset.cast<float>();
  }

  bool known() const { return known_; }
  double slack() const { return slack_; }

  /// The foremost points along a line.
  struct Foremost {
    shape::OuterHull::Foremost of_a, of_b;
  };
  Foremost Along(const Vector3f& n, float scale) const {
    return {a_.Along(n, scale), b_.Along(-matrix_.TransposeTimes(n), scale)};
  }

  /// Less what is uncertain: the gap of the projections along n, of which `scale` makes about a
  /// unit vector.
  float Gap(const Vector3f& n, float scale, const Foremost& along) const {
    const float gap = (n.dot(between_) - along.of_a.height) - along.of_b.height;
    return gap * scale - (along.of_a.more + along.of_b.more);
  }

  /// Between the foremost points, from A to B.
  Vector3f Way(const Foremost& along) const {
    return (between_ + matrix_.Times(along.of_b.point)) - along.of_a.point;
  }

  /// The least gap along the first line for which further lines are tried.
  float Hopeless() const { return -kDeep * static_cast<float>(extents_); }

  /// About across the plane that is to stand between the two: along S⁻¹ d, of the way d between the
  /// middles, with the sum S of both measures; S⁻¹ but for its determinant.
  Vector3f FirstDirection() const {
    const float whole = 1 / static_cast<float>(extents_);
    const float share_a = static_cast<float>(a_.extent) * whole;
    const float share_b = static_cast<float>(b_.extent) * whole;
    const Vector3f of_b = share_b * share_b * b_.measure;
    float s[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        s[i][j] = matrix_.rows[i].cwiseProduct(matrix_.rows[j]).dot(of_b);
      }
      s[i][i] += share_a * share_a * a_.measure[i];
    }
    const float c00 = s[1][1] * s[2][2] - s[2][1] * s[2][1];
    const float c11 = s[0][0] * s[2][2] - s[2][0] * s[2][0];
    const float c22 = s[0][0] * s[1][1] - s[1][0] * s[1][0];
    const float c10 = s[2][0] * s[2][1] - s[1][0] * s[2][2];
    const float c20 = s[1][0] * s[2][1] - s[2][0] * s[1][1];
    const float c21 = s[1][0] * s[2][0] - s[2][1] * s[0][0];
    const Vector3f& d = between_;
    const Vector3f n((c00 * d[0] + c10 * d[1]) + c20 * d[2], (c10 * d[0] + c11 * d[1]) + c21 * d[2],
                     (c20 * d[0] + c21 * d[1]) + c22 * d[2]);
    return n.squaredNorm() > kNoDirection * d.squaredNorm() ? n : d;
  }

 private:
  const HullSide a_, b_;
  const FloatMatrix matrix_;
  double extents_;
  bool known_;
  double slack_;
  Vector3f between_;
};

}  // namespace

double HullGapOf(const PosedPair& posed, double enough, WorkBudget* work) {
  const HullPair pair(posed);
  if (!pair.known()) return -numeric::kInfinity;
  Vector3f n = pair.FirstDirection();
  const float scale = 1 / std::sqrt(n.squaredNorm());
  float best = -sphere_tree::kFarDistance, hopeless = pair.Hopeless();
  for (int i = 0; i < kHullDirectionsMax && !work->exhausted(); ++i) {
    work->Spend(kHullDirectionUnits);
    const HullPair::Foremost along = pair.Along(n, scale);
    best = std::max(best, pair.Gap(n, scale, along));
    if (static_cast<double>(best) - pair.slack() > enough || best < hopeless) break;
    hopeless *= 0.5f;
    const Vector3f way = pair.Way(along);
    const float square = way.squaredNorm();
    if (!(square > std::numeric_limits<float>::min())) break;
    n -= (2 * n.dot(way) / square) * way;
  }
  return static_cast<double>(best) - pair.slack();
}

}  // namespace collision::narrow_phase
