// How far one body has to be shifted to take it out of another.
#pragma once

#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// Shifted by this along n [m], in A's body frame, B is certainly apart from A: the reach of A along
/// n and that of B against it, less what they are apart. Rounded up; the uncertainty of rounding and
/// turning is counted in, that of translation is not. +infinity where the work was spent before.
/// Requires |n| within 2^-50 of 1.
double ShiftAlong(const Surface& a, const Surface& b, const RelativePose& pose,
                  const Eigen::Vector3d& n, Work* work);

/// The least of some: across what shows the contact, away from each other's reference points, and
/// along the axes of both bodies; each by ShiftAlong() and, with kPastUnits for all, by ShiftPast().
/// The translational penetration depth is no more.
double ShiftApart(const Surface& a, const Surface& b, const RelativePose& pose,
                  const Evidence& evidence, Work* work);

}  // namespace collision
