// Poses of two bodies of one shape, of which it is known for certain how they lie to each other.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "collision_core/narrow_phase/pose/relative_pose.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/shape/shape.h"
#include "tests/bench/narrow_query.h"

namespace collision::bench {

/// By how much of the larger body's bounding diameter they overlap or are apart.
struct GapClass {
  const char* name;
  double share;
  bool overlap;
};
const std::vector<GapClass>& GapClasses();

narrow_phase::RelativePose PoseOf(const PlainPose& pose);

/// The shape as a body that stands still.
narrow_phase::BodySegment BodyOf(std::shared_ptr<const shape::Shape> shape);

struct PoseSample {
  std::vector<PlainPose> poses;
  std::size_t redrawn = 0;  ///< Drawn, but not of the class.
};

/// What is certain of two bodies at a pose.
struct PairOracle {
  std::function<narrow_phase::Verdict(const narrow_phase::RelativePose&)> decide;
  /// The distance, within `width` [m]; where they touch, 0.
  std::function<numeric::Interval(const narrow_phase::RelativePose&, double width)> distance;
};

/// `count` poses of the class. Rotation and direction are drawn, all equally likely; B is moved along
/// the direction from where the centres coincide, and the offset found by bisection between contact
/// and far away. For a gap: to where the certified distance is `share` of the diameter, within a
/// hundredth of that. For an overlap: to where they begin to touch, and from there inwards by
/// `share` of the diameter. Where that is not certainly of the class (a leg may come out again on the
/// other side) it is drawn anew.
PoseSample SamplePoses(PairOracle oracle, double diameter, const GapClass& gap, std::size_t count,
                       std::uint64_t seed);

/// The same of two bodies of one shape.
PoseSample SamplePoses(std::shared_ptr<const shape::Shape> shape, double diameter,
                       const GapClass& gap, std::size_t count, std::uint64_t seed);

}  // namespace collision::bench
