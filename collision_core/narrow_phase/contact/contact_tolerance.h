// How narrow the bracket of a time of contact has to be.
#pragma once

namespace collision::narrow_phase {

/// How narrow the bracket of a time has to be: the larger of the two tolerances counts. Rounding
/// and uncertain motion may leave a wider bracket; then the answer says so. A contact that is
/// shorter than the tolerance is found all the same.
struct ContactTolerance {
  double absolute = 0;      ///< [s]
  double relative = 1e-12;  ///< Of the time itself, counted from the start.
};

}  // namespace collision::narrow_phase
