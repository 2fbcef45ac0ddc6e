// What would narrow the answer about a pair.
#pragma once

#include <string>

#include "client/programs/tools/collisionctl/why/pair_report.h"

namespace collision::client {

/// One sentence without a full stop: what contributes most to the reach of both when they can meet,
/// and how to have less of it; or that nothing does.
std::string AdviceOn(const PairReport& report);

}  // namespace collision::client
