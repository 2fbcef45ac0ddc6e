// The root finder in plain doubles, with a proven error: decides nearly all pairs.
#pragma once

namespace collision {

/// |d + w δ| against s0 + s1 δ + s2 δ², δ >= 0, all s >= 0. The numbers are exact: what their makers
/// do not know of d and w they have added to the reach.
struct QuickApproach {
  double d[3];
  double w[3];
  double s0, s1, s2;
  double doubt0, doubt1;  ///< What was added to s0 and s1 for rounding.
};

struct QuickAnswer {
  bool decided;
  /// Certified: no approach before it, whether decided or not. If decided also not idle, as
  /// FirstApproach() is; +infinity: never up to the limit.
  double delta;
};

/// The least δ in [0, limit] with |d + w δ| <= s0 + s1 δ + s2 δ². Undecided where a few units in
/// the last place decide, near triple roots, and beyond the magnitudes for which its errors are
/// proven (1e-140 to 1e140 m): FirstApproach() goes on from there.
///
/// Method: as FirstApproach(), Newton's step on a lower bound; each rounding is paid by an allowance
/// relative to the largest terms, instead of an interval.
QuickAnswer QuickFirstApproach(const QuickApproach& approach, double limit);

}  // namespace collision
