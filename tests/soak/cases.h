// The cases of the soak: real processes over real DDS, for long.
#pragma once

#include <vector>

#include "tests/support/suite/case.h"

namespace collision::soak {

using suite::Case;
using suite::Outcome;
using suite::Setting;

std::vector<Case> WeekCases();
std::vector<Case> BesideCases();

}  // namespace collision::soak
