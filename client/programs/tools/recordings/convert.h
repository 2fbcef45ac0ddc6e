// collisionctl convert and record: a world as MCAP files, from a recording or as it is heard.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "collision/monitor.h"

namespace collision::client {

struct ConvertOptions {
  std::string input;  ///< Of convert: recording, segment, or folder of segments.
  std::string from, until;
  std::string output;
  double rate_hz = 10;
  double seconds = 0;  ///< Of record; 0: until Ctrl-C.
  bool watch = true;   ///< Of record.
};

/// Add the subcommands. `options` outlives `app`.
CLI::App* AddConvertCommand(CLI::App* app, ConvertOptions* options);
CLI::App* AddRecordCommand(CLI::App* app, ConvertOptions* options);

/// Return the exit code; errors are printed on standard error.
int RunConvert(const ConvertOptions& options);
int RunRecord(const ConvertOptions& options, const MonitorOptions& place, double timeout_s);

}  // namespace collision::client
