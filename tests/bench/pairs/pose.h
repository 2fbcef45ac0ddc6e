// Poses of two bodies whose gap or overlap is known for certain: what every benchmark of pairs
// asks.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/shape/shape.h"
#include "tests/bench/pairs/method.h"
#include "tests/bench/pairs/motion.h"
#include "tests/support/random.h"

namespace collision::bench {

/// WorkBudget without a limit.
inline constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

Eigen::Matrix3d RotationOf(const PlainPose& pose);
Eigen::Vector3d OffsetOf(const PlainPose& pose);
narrow_phase::RelativePose PoseOf(const PlainPose& pose);

/// The shape as a body that stands still.
narrow_phase::BodySegment BodyOf(std::shared_ptr<const shape::Shape> shape);

/// What is certain of two bodies at a pose.
struct PairOracle {
  std::function<narrow_phase::Verdict(const narrow_phase::RelativePose&)> decide;
  /// The distance, within `width` [m]; where they touch, 0.
  std::function<numeric::Interval(const narrow_phase::RelativePose&, double width)> distance;
};

/// The oracle of two bodies of one shape.
PairOracle OracleOf(std::shared_ptr<const shape::Shape> shape);

/// B's rotation, and the direction along which it is moved from where the centres coincide.
struct Placement {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d direction;

  narrow_phase::RelativePose At(double along) const {
    return collision::narrow_phase::PoseOf(rotation, along * direction);
  }
  PlainPose Plainly(double along) const;
};

/// Bisection from where the centres coincide, which must be near, to two diameters away: the first
/// place found, within `tolerance` [m], that is not near. nullopt: not even the start is near.
std::optional<double> Boundary(double diameter, double tolerance,
                               const std::function<bool(double along)>& is_near);

// ---- the contest's poses: classes of gaps and overlaps ----

/// By how much of the larger body's bounding diameter they overlap or are apart.
struct GapClass {
  const char* name;
  double share;
  bool overlap;
};
const std::vector<GapClass>& GapClasses();

struct PoseSample {
  std::vector<PlainPose> poses;
  std::size_t redrawn = 0;  ///< Drawn, but not of the class.
};

/// `count` poses of the class. Rotation and direction are drawn, all equally likely, and the offset
/// along the direction is found by bisection. For a gap: to where the certified distance is `share`
/// of the diameter, within a hundredth of that. For an overlap: to where they begin to touch, and
/// from there inwards by `share` of the diameter. A pose that is then not certainly of the class (a
/// leg may come out again on the other side) is drawn anew.
PoseSample SamplePoses(const PairOracle& oracle, double diameter, const GapClass& gap,
                       std::size_t count, std::uint64_t seed);

// ---- poses that ask for precision: shifted, turned, and grazing ----

/// A pose and what exact arithmetic says of it.
struct JudgedPose {
  PlainPose pose;
  double share = 0;  ///< Of the size, by which they are apart or were shifted into each other.
  bool overlap = false;
  double distance = 0;  ///< Exact [m]; 0: they touch.
};

/// The exact distance, given an upper bound.
using ExactDistance = std::function<double(const PlainPose&, double upper)>;

/// One gap after the other: `count` apart and half as many that overlap (as many, if they graze).
/// Poses whose exact distance is not the wanted one are drawn anew.
std::vector<JudgedPose> DrawPoses(const PairOracle& oracle, const ExactDistance& exact,
                                  double diameter, Motion motion, std::size_t count,
                                  std::uint64_t seed);

}  // namespace collision::bench
