// All contacts of a run, from the agents' exact motion.
#pragma once

#include <vector>

#include "client/simulators/checker/motion_truth.h"

namespace collision::checker {

/// How exactly the checker knows its own times [ns]. Contacts that touch for less than twice this
/// may or may not be seen by it, so they are neither demanded nor forbidden.
inline constexpr long double kRootTolerance = 1;

/// Two balls at a distance of at most the sum of their radii, without a gap.
struct TrueContact {
  std::size_t a = 0;  ///< Indices of the motions, a < b.
  std::size_t b = 0;
  long double begin_ns = 0;
  long double end_ns = 0;
  bool from_start = false;  ///< In contact already when the later of the two appeared.
  bool to_end = false;      ///< Still in contact when the first of the two left.
};

/// In order of begin. Boxes swept over slabs of time leave only near pairs to the root finder.
std::vector<TrueContact> TrueContacts(const std::vector<AgentMotion>& motions);

}  // namespace collision::checker
