// Poses that ask for precision: shifted, turned, and grazing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/narrow_pose.h"

namespace collision::bench {

enum class Motion {
  kTranslation,  ///< Upright, any direction; gaps and overlaps of 1e-3 to 0.5 of the size.
  kRotation,     ///< Turned any way; the same gaps and overlaps.
  kGrazing       ///< Turned any way; gaps and overlaps of 1e-3 to 1e-12 of the size.
};
const char* Name(Motion motion);
inline constexpr Motion kMotions[] = {Motion::kTranslation, Motion::kRotation, Motion::kGrazing};

/// A pose and what the exact arithmetic says of it.
struct JudgedPose {
  PlainPose pose;
  double share = 0;  ///< Of the size, by which they are apart or were shifted into each other.
  bool overlap = false;
  double distance = 0;  ///< Exact [m]; 0: they touch.
};

/// The exact distance, given an upper bound.
using ExactDistance = std::function<double(const PlainPose&, double upper)>;

/// One gap after the other, as many as `count` apart and half as many overlapping (of grazing ones
/// as many of each). Poses of which the exact distance does not say what was wanted are drawn anew.
std::vector<JudgedPose> DrawPoses(const PairOracle& oracle, const ExactDistance& exact,
                                  double diameter, Motion motion, std::size_t count,
                                  std::uint64_t seed);

}  // namespace collision::bench
