// When two balls touch, in long double as in true_motion.h.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/truth/piecewise_motion.h"

namespace collision {

/// A time during which two centres are nearer than a reach.
struct BallContact {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  double depth = 0;              ///< Greatest overlap [m].
  bool begins_in_motion = true;  ///< Not at the start of the query and not by a jump.
  bool ends_in_motion = true;    ///< Not at its end and not by a jump.
};

/// All contacts over [from_ns, to_ns], in order. The roots of the polynomials |Δ|² − reach² are
/// good to about 1e-9 s where the contact is not grazing.
std::vector<BallContact> BallContacts(const PiecewiseMotion& a, const PiecewiseMotion& b,
                                      double reach, std::int64_t from_ns, std::int64_t to_ns);

}  // namespace collision
