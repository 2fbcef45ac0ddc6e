// The cases of the faults suite.
#pragma once

#include <vector>

#include "tests/support/suite/case.h"

namespace collision::faults {

using suite::Case;
using suite::Outcome;
using suite::Setting;

std::vector<Case> NetworkCases();
std::vector<Case> ProgramCases();
std::vector<Case> StandbyCases();
std::vector<Case> ClockCases();
std::vector<Case> HostileCases();
std::vector<Case> AgentCases();
std::vector<Case> MemoryCases();

}  // namespace collision::faults
