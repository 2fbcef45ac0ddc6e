// What a process takes, as the kernel counts it.
#pragma once

#include <sys/types.h>

#include <vector>

namespace collision::soak {

struct ProcessUse {
  double resident_mb = 0;  ///< VmRSS.
  double descriptors = 0;
  double threads = 0;
};

/// All 0 if there is no such process.
ProcessUse UseOf(pid_t process);

/// One reading, at a part of the run.
struct UseAt {
  double part = 0;  ///< From 0 to 1.
  ProcessUse use;
};

/// The median of what was read in (from, to] of the run; 0 if nothing was.
double MedianOf(const std::vector<UseAt>& readings, double ProcessUse::*what, double from,
                double to);

}  // namespace collision::soak
