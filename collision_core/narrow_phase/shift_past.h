// How far one body has to be shifted to take it out of what is near.
#pragma once

#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// Units for all directions of one pose: where they are spent what is known by then is the answer.
inline constexpr std::uint64_t kPastUnits = 3000;

/// Shifted by this along n [m], in A's body frame, B is certainly apart from A. Only what is near the
/// shifted body counts, where ShiftAlong() has all of A count: of hills those below, and no summit
/// far away. Rounded up; the uncertainty of rounding and turning is counted in, that of translation
/// is not.
///
/// `known`: a shift, along whatever, that takes the two apart. Where B is not apart after three
/// quarters of it along n, or the work was spent before, the answer is `known`; else a place found in
/// steps of four, then by halves: at no less than three quarters of it the two are not known to be
/// apart, or it is a 2^-16th of `known`. `evidence` of contact saves work, where there is any.
/// Requires |n| within 2^-50 of 1.
double ShiftPast(const Surface& a, const Surface& b, const RelativePose& pose,
                 const Eigen::Vector3d& n, double known, const Evidence& evidence, Work* work);

}  // namespace collision
