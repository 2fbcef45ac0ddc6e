// collisionctl plot: what a recording shows over time, as a picture.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace collision::client {

struct PlotOptions {
  std::string input;  ///< Recording, segment, or folder of segments.
  std::string from, until;
  std::string what;    ///< A word of kPlotWords.
  std::string output;  ///< SVG, or CSV where its name says so.
};

inline constexpr const char* kPlotWords[] = {"clearance", "brackets", "latency", "pairs"};

/// Adds the subcommand. `options` outlives `app`.
CLI::App* AddPlotCommand(CLI::App* app, PlotOptions* options);

/// Returns the exit code; errors are printed on standard error.
int RunPlot(const PlotOptions& options);

}  // namespace collision::client
