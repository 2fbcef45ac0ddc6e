// Two horns that approach each other: the filter before the canonical routine, in plain doubles.
#pragma once

#include <cmath>

namespace collision::broad_phase {

/// The length of three components; rounded to nearest at each step.
inline double Length(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// At x >= 0 seconds the two centres are d + w x apart, and the two together reach s0 + s1 x + s2
/// x².
struct Approaching {
  double d[3], w[3];
  double s0, s1, s2;

  /// By how much these bounds and the canonical answer together may be early.
  static constexpr double kEarly = 1 - 4e-9;

  /// False if the canonical answer is certainly later than `last`, also where that answer is early.
  bool MayMeetBy(double last) const {
    return ComeNear(last / kEarly) && kEarly * EarlierBound(last) <= last;
  }

  /// False if the two do not come within reach of each other by `last`.
  bool ComeNear(double last) const;

  /// A lower bound on the time of the meeting [s]; above `limit`: they do not meet within it. Off
  /// by a relative 1e-9 or so.
  double EarlierBound(double limit) const;
};

}  // namespace collision::broad_phase
