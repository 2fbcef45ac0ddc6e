// Suggested bounds as a table for people and as JSON.
#pragma once

#include <string>
#include <vector>

#include "client/programs/tools/suggest_bounds/bounds_estimate.h"

namespace collision::client {

/// What the bounds come from.
struct BoundsSource {
  std::string name;  ///< A file, or "world lab".
  std::string kind;  ///< "csv", "recording" or "live".
};

/// Four digits, rounded up: what is declared must not be less than what was found.
std::string RoundedUpText(double value);

/// One line for each agent and, of several, one with the greatest of each bound.
std::string BoundsPage(const BoundsSource& source, const std::vector<SuggestedBounds>& all,
                       const BoundsRequest& request);

/// One document of kind "bounds" (collisionctl/json/schema.json), and a newline.
std::string BoundsJson(const BoundsSource& source, const std::vector<SuggestedBounds>& all,
                       const BoundsRequest& request);

}  // namespace collision::client
