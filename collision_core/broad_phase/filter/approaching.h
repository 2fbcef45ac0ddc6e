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

  /// What these bounds and the canonical answer may be early by, together.
  static constexpr double kEarly = 1 - 4e-9;

  /// A filter that is right even where the canonical answer is early: false, if that is certainly
  /// later than `last`.
  bool MayMeetBy(double last) const {
    return ComeNear(last / kEarly) && kEarly * EarlierBound(last) <= last;
  }

  /// False: they do not come within reach of each other by `last`.
  bool ComeNear(double last) const;

  /// Nothing meets earlier than this many seconds, and nothing at all within `limit` if the answer
  /// is larger. Off by a relative 1e-9 or so.
  double EarlierBound(double limit) const;
};

}  // namespace collision::broad_phase
