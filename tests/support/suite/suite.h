// The program of a suite: its options, its table, its JSON.
#pragma once

#include <string>
#include <vector>

#include "tests/support/suite/case.h"

namespace collision::suite {

struct Suite {
  std::string part;   ///< Of a report.
  std::string about;  ///< A sentence for --help.
  std::vector<Case> cases;
  /// Says why no case can run on this machine; empty: they can. Null: they always can.
  std::string (*obstacle)() = nullptr;
};

/// Runs the cases that the options choose, one after the other, and prints what is promised and
/// what was measured. Returns the exit status: 1 if a promise breaks, or if what was written does
/// not read back as what was measured, 2 on a wrong command line, 74 if it cannot be written, 77 if
/// no case can run here.
int RunSuite(const Suite& suite, int argc, char** argv);

}  // namespace collision::suite
