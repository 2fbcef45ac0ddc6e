// In exact arithmetic: do the balls of two states come apart between them?
#pragma once

#include <algorithm>

#include "tests/support/truth/exact_bound.h"

namespace collision {

/// Is |D| > share R + more at some instant between the two: D from the centre of the later state's
/// backward horn to that of the earlier one's forward horn, R both radii? With skew, speeds must be
/// rational.
inline bool BallsComeApart(const motion::SpaceTimeBound& before, const motion::MotionState& next,
                           const Exact& share = 1, const Exact& more = 0) {
  const motion::SpaceTimeBound after{next, before.limits, before.skew};
  const Instant base = before.state.stamp;
  const ExactHorn forward(before, base), backward(after, base, -1);
  ExactPolynomial radii(forward.u.size());
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = share * (forward.u[i] + backward.u[i]);
  radii[0] += more;
  ExactPolynomial room = Multiply(radii, radii);
  for (int axis = 0; axis < 3; ++axis) {
    const ExactPolynomial d = {forward.p[axis] - backward.p[axis],
                               forward.v[axis] - backward.v[axis],
                               forward.h[axis] - backward.h[axis]};
    const ExactPolynomial square = Multiply(d, d);
    for (int i = 0; i < 5; ++i) room[i] -= square[i];
  }
  const Exact end = ExactSeconds(base, next.stamp);
  const Exact at_end = Evaluate(room, end);
  if (room[0] < 0 || at_end < 0) return true;
  if (std::all_of(room.begin(), room.end(), [](const Exact& c) { return c == 0; })) return false;
  return CountRoots(room, 0, end) > (at_end == 0 ? 1 : 0);
}

}  // namespace collision
