// What must hold whatever the machine: counts of the experiments that may not exceed a bound.
#pragma once

#include <string>
#include <vector>

#include "idl/report.pb.h"

namespace collision::report {

struct PromiseLine {
  std::string words, experiment, figure;
  double at_most = 0;
  std::string measured;  ///< As a number, or why there is none.
  bool kept = false;
};

/// One line for each promise about an experiment that is in the results. A figure that was not
/// measured, or is not a number, keeps nothing.
std::vector<PromiseLine> PromisesOf(const v1::Results& results);

/// What is broken, a sentence each; experiments that failed as well.
std::vector<std::string> BrokenIn(const v1::Results& results);

}  // namespace collision::report
