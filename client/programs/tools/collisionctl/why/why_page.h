// The page `collisionctl why A B`.
#pragma once

#include <string>

#include "client/programs/tools/collisionctl/why/pair_report.h"

namespace collision::client {

/// Both agents side by side, and what follows for the pair. Ends with a newline.
std::string WhyPage(const PairReport& report, const WorldView& view);

/// The same as a document of kind "why", in one line without a newline.
std::string WhyJson(const PairReport& report, const WorldView& view);

}  // namespace collision::client
