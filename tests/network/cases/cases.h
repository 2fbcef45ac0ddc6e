// The cases of the network suite.
#pragma once

#include <vector>

#include "tests/network/judge.h"
#include "tests/support/suite/case.h"

namespace collision::network {

using suite::Case;
using suite::Outcome;
using suite::Setting;

std::vector<Case> ConditionCases();
std::vector<Case> LinkCases();
std::vector<Case> ProgramCases();
std::vector<Case> TakeOverCases();

/// The flight of the same swarm over a network without faults; flown once for each length.
const Flown& Undisturbed(const TestbedOptions& options);

}  // namespace collision::network
