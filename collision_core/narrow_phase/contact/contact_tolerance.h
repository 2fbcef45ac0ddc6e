// How narrow the bracket of a time of contact has to be.
#pragma once

namespace collision::narrow_phase {

/// What a time of contact resolves if nothing else is asked for: some thousand units in the last
/// place, as rounding allows for most pairs.
inline constexpr double kContactToleranceRelative = 1e-12;

/// How narrow the bracket of a time has to be: the larger of the two tolerances counts. Rounding
/// and uncertain motion may leave a wider bracket; then the answer says so. A contact that is
/// shorter than the tolerance is found all the same.
struct ContactTolerance {
  double absolute = 0;  ///< [s]
  /// Of the time itself, counted from the start.
  double relative = kContactToleranceRelative;
};

}  // namespace collision::narrow_phase
