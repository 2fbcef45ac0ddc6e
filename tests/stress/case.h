// The cases of the stress suite.
#pragma once

#include <vector>

#include "tests/support/suite/case.h"

namespace collision::stress {

using suite::Case;
using suite::Outcome;
using suite::Setting;
using suite::Show;

/// In the order of the report.
std::vector<Case> AllCases();

std::vector<Case> PairCases();
std::vector<Case> ContractCases();
std::vector<Case> BracketCases();
std::vector<Case> LongCases();
std::vector<Case> ShapeCases();
std::vector<Case> CrowdCases();
std::vector<Case> EdgeCases();
std::vector<Case> RestingCases();
std::vector<Case> SceneCases();
std::vector<Case> ViolentCases();

}  // namespace collision::stress
