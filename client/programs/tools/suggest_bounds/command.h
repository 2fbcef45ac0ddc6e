// collisionctl suggest-bounds: which bounds a motion keeps, from rows, a recording or a live
// world.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "client/programs/tools/suggest_bounds/bounds_estimate.h"

namespace collision::client {

struct SuggestBoundsOptions {
  std::string file;
  bool live = false;
  double seconds = 10;    ///< Of a live world.
  double period_s = 0.1;  ///< Its simulators send states at least so often meanwhile.
  BoundsRequest request;
};

/// Adds the subcommand. `options` outlives `app`.
CLI::App* AddSuggestBoundsCommand(CLI::App* app, SuggestBoundsOptions* options);

/// Where a live world is, and how long to wait for its service.
struct LiveWorld {
  std::string world;
  std::uint32_t domain = 0;
  double timeout_s = 3;
  std::string credentials = {};  ///< Folder; empty: none.
};

/// Returns the exit code; errors are printed on standard error.
int RunSuggestBounds(const SuggestBoundsOptions& options, const LiveWorld& live, bool json);

}  // namespace collision::client
