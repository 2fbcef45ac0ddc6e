// How long single queries take: warm and cold, one by one.
#pragma once

#include <vector>

#include "tests/bench/pairs/method.h"

namespace collision::bench {

struct TimingPlan {
  int passes = 3;          ///< Each contestant in turn, over all poses; the least of a pose counts.
  double patience = 2;     ///< A contestant whose pass took longer has no further one [s].
  std::size_t colds = 40;  ///< So many poses are asked with a cold cache as well.
};

struct MethodTimes {
  std::vector<double> warm;  ///< One for each pose [s].
  std::vector<double> cold;  ///< One for each of the first poses [s].
  std::vector<Reply> replies;
};

/// All methods on all poses. Warm: the same query again, at least 4 µs' worth of it, best of the
/// passes. Cold: once, after a walk over 64 MB.
std::vector<MethodTimes> TimeMethods(const PairMethods& methods,
                                     const std::vector<PlainPose>& poses, const TimingPlan& plan);

}  // namespace collision::bench
